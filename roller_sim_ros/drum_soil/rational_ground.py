# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Ground whose half space is a rational function fitted to the exact one."""

from __future__ import annotations

from typing import Any

import numpy as np

from roller_sim_ros.drum_soil import rational_kernel
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.finite_memory import BENDS_SHAPE
from roller_sim_ros.drum_soil.ground import NO_MODES, Array, Ground
from roller_sim_ros.drum_soil.modes import DISTANCE, POLE, ROWS, WEIGHT, Modes, prepare
from roller_sim_ros.exciter import Revolution
from roller_sim_ros.half_space.rational import rational_half_space
from roller_sim_ros.parameters import Soil


class RationalGround(Ground):
    """Drum on a half space whose modes are its whole history."""

    def _start(self) -> None:
        super()._start()
        self._bends = np.zeros(BENDS_SHAPE)
        self._modes = NO_MODES
        self._modes = self._modes_on(self._soil)

    def _modes_on(self, soil: Soil) -> Modes:
        """Return the modes on a soil, at rest."""
        fit = rational_half_space(
            self.strip.aspect_ratio, soil.poisson_ratio, self._half_space.order
        )
        modes = np.zeros((ROWS, fit.poles.shape[0]), dtype=np.complex128)
        modes[POLE] = fit.poles / self.strip.time_unit_s
        modes[WEIGHT] = self.strip.static_compliance * fit.residues / self.strip.time_unit_s
        return modes

    def _change(self, soil: Soil, revolution: Revolution) -> None:
        if soil != self._soil:
            self._move_to(soil)
        prepare(revolution.sample_period_s, self._modes)

    def _move_to(self, soil: Soil) -> None:
        # The surface keeps its distance from rest and its velocity; the difference of the rests goes into the datum,
        # so that neither the drum nor the force notices that the surface is another one.
        state, old = self.state, self._modes
        distance = float((old[WEIGHT] * old[DISTANCE]).real.sum())
        rest = self.strip.static_compliance * state[at.FORCE]
        state[at.DATUM] += state[at.SURFACE] - (rest + distance)
        state[at.SURFACE] = rest + distance
        self._modes = self._modes_on(soil)
        self._modes[DISTANCE] = _moved(old, self._modes, distance, state[at.SURFACE_VELOCITY])

    @property
    def kernel_arguments(self) -> tuple[Any, ...]:
        """State, constants, angles, modes, scratch."""
        return (
            self.state,
            self._constants,
            self._sine,
            self._cosine,
            self._modes,
            self._bends,
        )

    def advance(self, first: int, samples: int) -> Array:
        """Step over samples first … first + samples − 1 of the revolution."""
        out = np.empty((at.OUT_ROWS, samples))
        arguments: tuple[Any, ...] = (samples, first, *self.kernel_arguments, out)
        rational_kernel.advance(*arguments)
        return out


def _moved(old: Modes, new: Modes, distance: float, velocity: float) -> Modes:
    """Return distances from rest of the new modes that give the surface's distance and velocity.

    Nearest, in the sense of each mode's share of the surface's distance, to the old modes' shares; where the kinds of
    modes differ, to none.
    """
    shares = np.zeros(new.shape[1], dtype=np.complex128)
    if np.array_equal(old[POLE].imag > 0.0, new[POLE].imag > 0.0):
        shares = old[WEIGHT] * old[DISTANCE]
    pair = new[POLE].imag > 0.0
    # Real unknowns: real parts of all shares, imaginary parts of those of pairs.
    rows = np.array(
        [
            np.concatenate([np.ones(pair.size), np.zeros(pair.sum())]),
            np.concatenate([new[POLE].real, -new[POLE].imag[pair]]),
        ]
    )
    unknowns = np.concatenate([shares.real, shares.imag[pair]])
    missing = np.array([distance, velocity]) - rows @ unknowns
    unknowns = unknowns + np.linalg.lstsq(rows, missing, rcond=None)[0]
    result = unknowns[: pair.size].astype(np.complex128)
    result[pair] += 1j * unknowns[pair.size :]
    return np.asarray(result / new[WEIGHT])
