# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Ground whose half space is the paper's two-pole one."""

from __future__ import annotations

from typing import Any

import numpy as np

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil import two_pole_kernel
from roller_sim_ros.drum_soil.finite_memory import BENDS_SHAPE
from roller_sim_ros.drum_soil.ground import NO_MODES, Array, Ground
from roller_sim_ros.drum_soil.two_pole import TwoPole, joint_force
from roller_sim_ros.exciter import Revolution
from roller_sim_ros.half_space.two_pole import two_pole_frequency
from roller_sim_ros.parameters import Soil

RESOLVED_RAD = 5.0
"""Radians a sample that drum and soil may swing on the plastic layer; from 8 on the step is unstable."""


class TwoPoleGround(Ground):
    """Drum on the two-pole half space: the surface's depth and rate are its whole history."""

    def _start(self) -> None:
        super()._start()
        self._bends = np.zeros(BENDS_SHAPE)
        self._two_pole = self._constants_on(self._soil)

    def _constants_on(self, soil: Soil) -> TwoPole:
        """Return ω0, Q, H0 on a soil."""
        omega = two_pole_frequency(
            soil.shear_modulus_pa,
            soil.density_kg_m3,
            self.strip.half_width_m,
            self.strip.half_length_m,
            self._half_space.frequency_factor,
        )
        return omega, self._half_space.quality_factor, self.strip.static_compliance

    def _plastic_compliance(self, soil: Soil, sample_period_s: float) -> float:
        # In loading the plastic layer is a spring between drum and soil. Stiffer than a few radians a sample it
        # cannot be followed, and need not be: with the defaults that is p below 0.05 mm.
        omega, _, compliance = self._constants_on(soil)
        inverse_masses = omega * omega * compliance + 1.0 / self._machine.drum_mass_kg
        least = inverse_masses * (sample_period_s / RESOLVED_RAD) ** 2
        return max(super()._plastic_compliance(soil, sample_period_s), least)

    def _change(self, soil: Soil, revolution: Revolution) -> None:
        constants, state = self._constants, self.state
        before, self._two_pole = self._two_pole, self._constants_on(soil)
        omega, quality, compliance = self._two_pole
        constants[at.NATURAL_FREQUENCY] = omega
        constants[at.QUALITY] = quality
        if soil == self._soil or state[at.PHASE] == at.AIR:
            return
        # In contact the force with which drum and surface move alike follows from the surface's state. So that it
        # stays, the surface takes the depth that goes with it on the new soil, and the datum makes up for that.
        thrust = revolution.start_acceleration * self._direction.vertical_sine * self._sine[0]
        mass, load = self._machine.drum_mass_kg, self._machine.static_load_n
        velocity = state[at.SURFACE_VELOCITY]
        force = joint_force(state[at.SURFACE], velocity, thrust, before, (mass, load, 0.0))
        sinking = (load - force) / mass - thrust
        surface = compliance * force - (sinking + omega / quality * velocity) / (omega * omega)
        state[at.DATUM] += state[at.SURFACE] - surface
        state[at.SURFACE] = surface

    @property
    def kernel_arguments(self) -> tuple[Any, ...]:
        """State, constants, angles, no modes, scratch."""
        return (
            self.state,
            self._constants,
            self._sine,
            self._cosine,
            NO_MODES,
            self._bends,
        )

    def advance(self, first: int, samples: int) -> Array:
        """Step over samples first … first + samples − 1 of the revolution."""
        out = np.empty((at.OUT_ROWS, samples))
        arguments: tuple[Any, ...] = (samples, first, *self.kernel_arguments, out)
        two_pole_kernel.advance(*arguments)
        return out
