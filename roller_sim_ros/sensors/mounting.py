# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How the sensor sits on its carrier: a lean and a share of the other axis."""

from __future__ import annotations

import math

from roller_sim_ros.sensors.sheet import AccelerometerSheet
from roller_sim_ros.sensors.stage import Signals


class Mounting:
    """Turns the true axes by the mounting angle and mixes them by the cross-axis sensitivity.

    Leaning forward by α the vertical axis reads z cos α + x sin α, the horizontal one x cos α − z sin α.

    Parameters
    ----------
    sheet : AccelerometerSheet
        The data sheet.
    """

    def __init__(self, sheet: AccelerometerSheet) -> None:
        self._cosine = math.cos(sheet.mounting_angle_rad)
        self._sine = math.sin(sheet.mounting_angle_rad)
        self._cross = sheet.cross_axis

    def apply(self, signals: Signals) -> Signals:
        """Return what the sensor's own axes feel."""
        z = signals.vertical * self._cosine + signals.horizontal * self._sine
        x = signals.horizontal * self._cosine - signals.vertical * self._sine
        return Signals(z + self._cross * x, x + self._cross * z, signals.period_s)
