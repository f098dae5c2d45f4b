# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ideal accelerometer: the truth in single precision."""

from __future__ import annotations

import numpy as np

from roller_sim_ros.sensors.clock import Clock
from roller_sim_ros.sensors.sensor import Disturbance, Kind, Reading, specific_force
from roller_sim_ros.session.block import Block

NONE_CLIPPED = np.zeros(0, dtype=np.uint8)


class IdealAccelerometer:
    """No range, noise, bandwidth or delay; only rounded to float32.

    Parameters
    ----------
    kind : Kind
        Coordinate acceleration or specific force.
    """

    latency_s = 0.0

    def __init__(self, kind: Kind = Kind.COORDINATE_ACCELERATION) -> None:
        self.kind = kind
        self._clock = Clock()

    def read(self, block: Block, disturbance: Disturbance | None = None) -> list[Reading]:
        """Return the readings of a block."""
        revolution, offset = divmod(block.first_sample, 128)
        sensor_time_s, clipped = block.time_s, None
        vertical, horizontal = block.acceleration_vertical, block.acceleration_horizontal
        if self.kind is Kind.SPECIFIC_FORCE:
            vertical, horizontal = specific_force(vertical, horizontal)
        if disturbance is not None:
            self._clock.begin(block, disturbance.clock_skew_ppm(revolution))
            sensor_time_s = self._clock.sensor_time_s(offset)
            vertical, horizontal = vertical.copy(), horizontal.copy()
            clipped = disturbance.signal(revolution, vertical, horizontal)
        return [
            Reading(
                kind=self.kind,
                vertical=vertical.astype(np.float32),
                horizontal=horizontal.astype(np.float32),
                first_sample=block.first_sample,
                time_s=block.time_s,
                sample_period_s=block.sample_period_s,
                excitation_hz=block.excitation_hz,
                eccentric_phase_rad=block.eccentric_phase_rad,
                phase_increment_rad=block.phase_increment_rad,
                revolution=revolution,
                clipped=NONE_CLIPPED if clipped is None else clipped,
                sensor_time_s=sensor_time_s,
            )
        ]
