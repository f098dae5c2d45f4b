"""The ideal accelerometer: the truth in single precision."""

from __future__ import annotations

import numpy as np

from roller_sim_ros.sensors.sensor import Kind, Reading, specific_force
from roller_sim_ros.session.block import Block


class IdealAccelerometer:
    """No range, noise, bandwidth or delay; only rounded to float32.

    Parameters
    ----------
    kind : Kind
        Coordinate acceleration or specific force.
    """

    def __init__(self, kind: Kind = Kind.COORDINATE_ACCELERATION) -> None:
        self.kind = kind

    def read(self, block: Block) -> Reading:
        """Return the readings of a block."""
        vertical, horizontal = block.acceleration_vertical, block.acceleration_horizontal
        if self.kind is Kind.SPECIFIC_FORCE:
            vertical, horizontal = specific_force(vertical, horizontal)
        return Reading(
            kind=self.kind,
            vertical=vertical.astype(np.float32),
            horizontal=horizontal.astype(np.float32),
            sensor_time_s=block.time_s,
        )
