"""What every sensor is: true motion of a block in, readings out."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.session.block import Block


class Kind(IntEnum):
    """What the readings mean; the values of the message field ``kind``."""

    COORDINATE_ACCELERATION = 0
    """Second derivative of the position, 0 at rest."""
    SPECIFIC_FORCE = 1
    """What an accelerometer feels: 9.81 m/s² upwards at rest."""


def _empty() -> NDArray[np.int32]:
    return np.zeros(0, dtype=np.int32)


@dataclass(frozen=True)
class Reading:
    """What a sensor delivers for one block; x forward, z up.

    Attributes
    ----------
    kind : Kind
        What the readings mean.
    vertical, horizontal : ndarray of float32, shape (n,)
        m/s².
    scale : float
        m/s² per count of the raw readings; 0 without raw readings.
    raw_vertical, raw_horizontal : ndarray of int32, shape (n,) or (0,)
        Counts of a digital sensor.
    clipped : int
        Readings in the block that stand at the end of the sensor's range.
    sensor_time_s : float
        Time of the first sample by the sensor's own clock, s since the start.
    """

    kind: Kind
    vertical: NDArray[np.float32]
    horizontal: NDArray[np.float32]
    scale: float = 0.0
    raw_vertical: NDArray[np.int32] = field(default_factory=_empty)
    raw_horizontal: NDArray[np.int32] = field(default_factory=_empty)
    clipped: int = 0
    sensor_time_s: float = 0.0


class Sensor(Protocol):
    """A sensor, made once a session and read block by block, in order."""

    def __init__(self, kind: Kind = Kind.COORDINATE_ACCELERATION) -> None: ...

    def read(self, block: Block) -> Reading:
        """Return the readings of a block."""
        ...


def specific_force(
    vertical: NDArray[np.floating], horizontal: NDArray[np.floating]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return (vertical, horizontal) specific force of coordinate accelerations, z up, m/s².

    An accelerometer at rest reads the support, +9.81 upwards (REP-145).
    """
    return (
        np.asarray(vertical, dtype=np.float64) + GRAVITY_M_S2,
        np.asarray(horizontal, dtype=np.float64),
    )
