# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Rational half space for grounds near each other: one fit serves them all."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from roller_sim_ros.drum_soil.modes import POLE, ROWS, WEIGHT, Modes
from roller_sim_ros.drum_soil.rational_ground import RationalGround
from roller_sim_ros.half_space.rational import rational_half_space
from roller_sim_ros.parameters import Soil

STEP = 0.02
"""Of ln α from fit to fit: the fit used is off by at most 1 % in α, that is 2 % in p; H0 and the times are not."""


class FrozenFitGround(RationalGround):
    """Drum on a rational half space that keeps the shape of its first fit while the soil changes.

    A fit takes a hundred times as long as the motion on it, and its shape hardly changes with α. Fits are made at
    rounded α, so that the next window on much the same ground finds its fit made.
    """

    def __init__(self, *arguments: Any) -> None:
        self._fitted_at = 0.0
        super().__init__(*arguments)

    def _modes_on(self, soil: Soil) -> Modes:
        if not self._fitted_at:
            self._fitted_at = math.exp(round(math.log(self.strip.aspect_ratio) / STEP) * STEP)
        fit = rational_half_space(self._fitted_at, soil.poisson_ratio, self._half_space.order)
        modes = np.zeros((ROWS, fit.poles.shape[0]), dtype=np.complex128)
        modes[POLE] = fit.poles / self.strip.time_unit_s
        modes[WEIGHT] = self.strip.static_compliance * fit.residues / self.strip.time_unit_s
        return modes
