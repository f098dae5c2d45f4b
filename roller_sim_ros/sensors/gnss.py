# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Position by satellite with the error of real-time kinematics: a slow wander and a little noise."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from roller_sim_ros.parameters import ParameterGroup
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors.bias import GaussMarkov
from roller_sim_ros.sensors.geodesy import Geodetic, place_of
from roller_sim_ros.sensors.travelled import Stations
from roller_sim_ros.session.block import Block
from roller_sim_ros.site import Position
from roller_sim_ros.site.streams import stream

AXES = ("east", "north", "up")


@dataclass(frozen=True)
class GnssSheet(ParameterGroup):
    """A receiver with corrections (RTK, fixed), and where the lane lies.

    The errors are usual values of RTK: one to three centimetres, of which most wanders slowly; not verified.
    """

    group: ClassVar[str] = "gnss"

    rate_hz: float = parameter(10.0, "Hz", "fixes per second", minimum=0.1, maximum=50.0)
    latitude_deg: float = parameter(
        59.35, "deg", "latitude of chainage 0", minimum=-89.0, maximum=89.0
    )
    longitude_deg: float = parameter(
        18.07, "deg", "longitude of chainage 0", minimum=-180.0, maximum=180.0
    )
    altitude_m: float = parameter(
        30.0, "m", "height of the antenna above the ellipsoid", minimum=-500.0, maximum=9000.0
    )
    heading_deg: float = parameter(
        0.0,
        "deg",
        "direction of growing chainage, clockwise from north",
        minimum=-360.0,
        maximum=360.0,
    )
    wander_m: float = parameter(
        0.01,
        "m",
        "standard deviation of the wander of each horizontal axis, a Gauss-Markov process",
        minimum=0.0,
        maximum=10.0,
    )
    wander_time_s: float = parameter(
        60.0, "s", "correlation time of the wander", minimum=0.1, maximum=1e5
    )
    noise_m: float = parameter(
        0.003,
        "m",
        "standard deviation of the noise of each horizontal axis",
        minimum=0.0,
        maximum=10.0,
    )
    vertical_factor: float = parameter(
        2.0, "", "errors upwards over those of a horizontal axis", minimum=0.0, maximum=10.0
    )


class Fix(NamedTuple):
    """A fix.

    Attributes
    ----------
    time_s : float
        Since the start of the session.
    revolution : int
        The session's.
    place : Geodetic
        As the receiver has it.
    variances_m2 : tuple of float
        Of east, north and up.
    """

    time_s: float
    revolution: int
    place: Geodetic
    variances_m2: tuple[float, float, float]


class Gnss:
    """Fixes at a fixed rate.

    Parameters
    ----------
    sheet : GnssSheet
        The data sheet.
    seed : int
        Of the run.
    """

    def __init__(self, sheet: GnssSheet, seed: int = 0) -> None:
        self._sheet = sheet
        self._stations = Stations(sheet.rate_hz)
        self._origin = Geodetic(sheet.latitude_deg, sheet.longitude_deg, sheet.altitude_m)
        self._factors = (1.0, 1.0, sheet.vertical_factor)
        self._wander = [
            GaussMarkov(
                sheet.wander_m * factor,
                sheet.wander_time_s,
                stream(seed, f"sensors/gnss/{axis}/wander"),
            )
            for axis, factor in zip(AXES, self._factors, strict=True)
        ]
        self._noise = [stream(seed, f"sensors/gnss/{axis}/noise") for axis in AXES]

    def read(self, block: Block, position: Position) -> list[Fix]:
        """Return the fixes in a block.

        Parameters
        ----------
        block : Block
            The next one.
        position : Position
            Where its revolution began.
        """
        sheet = self._sheet
        heading = math.radians(sheet.heading_deg)
        variance = sheet.wander_m**2 + sheet.noise_m**2
        found = []
        for station in self._stations.take(block, position):
            error = [
                float(np.squeeze(wander.advance(1, 1.0 / sheet.rate_hz)))
                + sheet.noise_m * factor * noise.standard_normal()
                for wander, noise, factor in zip(
                    self._wander, self._noise, self._factors, strict=True
                )
            ]
            place = place_of(
                self._origin,
                station.chainage_m * math.sin(heading) + error[0],
                station.chainage_m * math.cos(heading) + error[1],
                error[2],
            )
            variances = tuple(variance * factor**2 for factor in self._factors)
            found.append(
                Fix(
                    station.time_s,
                    station.revolution,
                    place,
                    (variances[0], variances[1], variances[2]),
                )
            )
        return found
