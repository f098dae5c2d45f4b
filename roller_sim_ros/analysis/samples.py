# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Pieces of the drum's acceleration as a bag holds them, whatever the message."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import BagError

ACCELERATION_TYPE = "roller_sim_ros/msg/DrumAcceleration"
METER_TYPE = "roller_sim_ros/msg/CompactionMeter"
TRUTH_TYPE = "roller_sim_ros/msg/DrumSoilState"
EXCITER_TYPE = "roller_sim_ros/msg/ExciterState"
FACTS_TYPE = "diagnostic_msgs/msg/DiagnosticStatus"
IMU_TYPE = "sensor_msgs/msg/Imu"
NUMBER_TYPE = "std_msgs/msg/Float64"

SPECIFIC_FORCE = 1
"""Value of DrumAcceleration.kind."""

NANOSECONDS = 1_000_000_000


@dataclass(frozen=True)
class Piece:
    """Samples in a row with constant timing.

    Attributes
    ----------
    first_sample : int
        Index of the first sample.
    stamp_ns : int
        Time of the first sample, ns.
    sample_period_s, excitation_hz, phase_rad, phase_increment_rad : float
        As in DrumAcceleration.
    vertical, horizontal : ndarray of float32, shape (n,)
        m/s².
    specific_force : bool
        Whether the vertical acceleration contains gravity.
    clipped : int
        How many readings, both axes together, the sensor clipped; 0 where a bag does not say.
    """

    first_sample: int
    stamp_ns: int
    sample_period_s: float
    excitation_hz: float
    phase_rad: float
    phase_increment_rad: float
    vertical: NDArray[np.float32]
    horizontal: NDArray[np.float32]
    specific_force: bool
    clipped: int = 0

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.vertical)

    def stamp_of(self, sample: int) -> int:
        """Return the time of a sample by its index, ns."""
        seconds = (sample - self.first_sample) * self.sample_period_s
        return self.stamp_ns + round(seconds * NANOSECONDS)


def stamp_ns(message: Any) -> int:
    """Return the header's time stamp of a message, ns."""
    stamp = message.header.stamp
    return int(stamp.sec) * NANOSECONDS + int(stamp.nanosec)


class AccelerationReader:
    """Turns DrumAcceleration messages into pieces, one each."""

    def read(self, message: Any) -> Iterator[Piece]:
        """Yield the piece of a message, none of an empty one.

        Raises
        ------
        BagError
            If the message lacks a field: it is of another version.
        """
        try:
            piece = Piece(
                first_sample=int(message.sequence),
                stamp_ns=stamp_ns(message),
                sample_period_s=float(message.sample_period),
                excitation_hz=float(message.excitation_frequency),
                phase_rad=float(message.eccentric_phase),
                phase_increment_rad=float(message.phase_increment),
                vertical=np.asarray(message.vertical, dtype=np.float32),
                horizontal=np.asarray(message.horizontal, dtype=np.float32),
                specific_force=message.kind == SPECIFIC_FORCE,
                clipped=int(message.clipped),
            )
        except AttributeError as error:
            raise BagError(
                f"{ACCELERATION_TYPE} of this bag is of another version: {error}"
            ) from None
        if len(piece):
            yield piece
