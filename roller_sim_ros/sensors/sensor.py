# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What every accelerometer is: true motion of a block in, readings out."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.session.block import Block

Array = NDArray[np.float64]


class Kind(IntEnum):
    """What the readings mean; the values of the message field ``kind``."""

    COORDINATE_ACCELERATION = 0
    """Second derivative of the position, 0 at rest."""
    SPECIFIC_FORCE = 1
    """What an accelerometer feels: 9.81 m/s² upwards at rest."""

    @property
    def label(self) -> str:
        """The kind as parameters name it."""
        return self.name.lower()


_NO_COUNTS = np.zeros(0, dtype=np.int32)
_NONE_CLIPPED = np.zeros(0, dtype=np.uint8)


@dataclass(eq=False)
class Reading:
    """Samples that a sensor delivers together: equidistant, at one excitation frequency; x forward, z up.

    Attributes
    ----------
    kind : Kind
        What the readings mean.
    vertical, horizontal : ndarray of float32, shape (n,)
        m/s².
    first_sample : int
        Index of the first sample since the start, as the sensor counts.
    time_s : float
        When the first sample was taken, s since the start of the session.
    sample_period_s : float
        Time from sample to sample by the sensor's own clock.
    excitation_hz : float
        Of the revolution that the samples are of.
    eccentric_phase_rad : float
        Phase of the eccentric at the first sample, in [0, 2π).
    phase_increment_rad : float
        Phase from sample to sample.
    revolution : int
        The session's revolution, or stretch of 128 samples, that the samples are of.
    scale : float
        m/s² per count of the raw readings; 0 without raw readings.
    raw_vertical, raw_horizontal : ndarray of int32, shape (n,) or (0,)
        Counts of a digital sensor.
    clipped : ndarray of uint8, shape (n,) or (0,)
        Of each sample, how many of its two axes stand at the end of the sensor's range; empty: none.
    sensor_time_s : float
        Time of the first sample by the sensor's own clock, s since its start.
    """

    kind: Kind
    vertical: NDArray[np.float32]
    horizontal: NDArray[np.float32]
    first_sample: int
    time_s: float
    sample_period_s: float
    excitation_hz: float
    eccentric_phase_rad: float
    phase_increment_rad: float
    revolution: int
    scale: float = 0.0
    raw_vertical: NDArray[np.int32] = field(default_factory=lambda: _NO_COUNTS)
    raw_horizontal: NDArray[np.int32] = field(default_factory=lambda: _NO_COUNTS)
    clipped: NDArray[np.uint8] = field(default_factory=lambda: _NONE_CLIPPED)
    sensor_time_s: float = 0.0

    def __len__(self) -> int:
        """Return the number of samples."""
        return int(self.vertical.shape[0])

    def part(self, start: int, stop: int) -> Reading:
        """Return some of the samples, by their place in the reading, as a reading of their own."""
        before_s = start * self.sample_period_s
        turn = 2.0 * np.pi
        return Reading(
            kind=self.kind,
            vertical=self.vertical[start:stop],
            horizontal=self.horizontal[start:stop],
            first_sample=self.first_sample + start,
            time_s=self.time_s + before_s,
            sample_period_s=self.sample_period_s,
            excitation_hz=self.excitation_hz,
            eccentric_phase_rad=(self.eccentric_phase_rad + start * self.phase_increment_rad)
            % turn,
            phase_increment_rad=self.phase_increment_rad,
            revolution=self.revolution,
            scale=self.scale,
            raw_vertical=self.raw_vertical[start:stop],
            raw_horizontal=self.raw_horizontal[start:stop],
            clipped=self.clipped[start:stop],
            sensor_time_s=self.sensor_time_s + before_s,
        )


class Disturbance(Protocol):
    """What disturbs a sensor from outside: the faults that are active."""

    def signal(
        self, revolution: int, vertical: Array, horizontal: Array
    ) -> NDArray[np.uint8] | None:
        """Change the analogue signals in place, m/s², before they are clipped and converted.

        Called once for each sample, in order, whatever the size of the pieces.

        Parameters
        ----------
        revolution : int
            The session's revolution that the samples are of.
        vertical, horizontal : ndarray, shape (n,)
            The signals.

        Returns
        -------
        ndarray of uint8, shape (n,), or None
            Of each sample, on how many axes it was clipped, as the sensor itself would notice; None: nowhere.
        """
        ...

    def clock_skew_ppm(self, revolution: int) -> float:
        """Return how much faster than without faults the sensor's clock runs in a revolution."""
        ...


class Sensor(Protocol):
    """An accelerometer on the drum, made once a session and read block by block, in order."""

    @property
    def latency_s(self) -> float:
        """Time from a sample to its delivery."""
        ...

    def read(self, block: Block, disturbance: Disturbance | None = None) -> list[Reading]:
        """Return what the sensor has to deliver after a block; its readings are of one revolution each.

        Parameters
        ----------
        block : Block
            The true motion.
        disturbance : Disturbance, optional
            What disturbs the sensor.
        """
        ...


def specific_force(
    vertical: NDArray[np.floating], horizontal: NDArray[np.floating]
) -> tuple[Array, Array]:
    """Return (vertical, horizontal) specific force of coordinate accelerations, z up, m/s².

    An accelerometer at rest reads the support, +9.81 upwards (REP-145).
    """
    return (
        np.asarray(vertical, dtype=np.float64) + GRAVITY_M_S2,
        np.asarray(horizontal, dtype=np.float64),
    )
