# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Travel speed and dead reckoning: a wheel's or radar's speed, and the way that it adds up to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from roller_sim_ros.parameters import ParameterGroup
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors.travelled import Stations
from roller_sim_ros.session.block import Block
from roller_sim_ros.site import Position
from roller_sim_ros.site.streams import stream


@dataclass(frozen=True)
class OdometrySheet(ParameterGroup):
    """A sensor of the travel speed; the errors are assumed, usual values."""

    group: ClassVar[str] = "odometry"

    rate_hz: float = parameter(20.0, "Hz", "measurements per second", minimum=0.1, maximum=100.0)
    scale_error: float = parameter(
        0.005, "", "relative error of the speed: slip, a worn tyre", minimum=-0.5, maximum=0.5
    )
    speed_noise_m_s: float = parameter(
        0.01,
        "m/s",
        "standard deviation of each measured speed; none while the roller stands",
        minimum=0.0,
        maximum=1.0,
    )


class Travelled(NamedTuple):
    """A measurement.

    Attributes
    ----------
    time_s : float
        Since the start of the session.
    revolution : int
        The session's.
    distance_m : float
        Way since the start, forward positive: the measured speeds added up.
    distance_deviation_m : float
        Standard deviation of it that the sensor states.
    speed_m_s : float
        Measured speed, forward positive.
    speed_deviation_m_s : float
        Standard deviation of it.
    """

    time_s: float
    revolution: int
    distance_m: float
    distance_deviation_m: float
    speed_m_s: float
    speed_deviation_m_s: float


class Odometry:
    """Measures at a fixed rate.

    Parameters
    ----------
    sheet : OdometrySheet
        The data sheet.
    seed : int
        Of the run.
    """

    def __init__(self, sheet: OdometrySheet, seed: int = 0) -> None:
        self._sheet = sheet
        self._random = stream(seed, "sensors/odometry")
        self._stations = Stations(sheet.rate_hz)
        self._distance_m = 0.0
        self._way_m = 0.0
        self._noise_variance = 0.0

    def read(self, block: Block, position: Position) -> list[Travelled]:
        """Return the measurements in a block.

        Parameters
        ----------
        block : Block
            The next one.
        position : Position
            Where its revolution began.
        """
        sheet = self._sheet
        found = []
        for station in self._stations.take(block, position):
            noise_m_s = sheet.speed_noise_m_s * self._random.standard_normal()
            deviation_m_s = sheet.speed_noise_m_s if station.speed_m_s else 0.0
            speed_m_s = station.speed_m_s * (1.0 + sheet.scale_error)
            speed_m_s += noise_m_s if station.speed_m_s else 0.0
            if station.number:
                self._distance_m += speed_m_s / sheet.rate_hz
                self._way_m += abs(speed_m_s) / sheet.rate_hz
                self._noise_variance += (deviation_m_s / sheet.rate_hz) ** 2
            spread = (sheet.scale_error * self._way_m) ** 2 + self._noise_variance
            found.append(
                Travelled(
                    station.time_s,
                    station.revolution,
                    self._distance_m,
                    spread**0.5,
                    speed_m_s,
                    ((sheet.scale_error * speed_m_s) ** 2 + deviation_m_s**2) ** 0.5,
                )
            )
        return found
