"""Ground whose half space is the paper's two-pole one."""

from __future__ import annotations

import numpy as np

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil import two_pole_kernel
from roller_sim_ros.drum_soil.finite_memory import BENDS_SHAPE
from roller_sim_ros.drum_soil.ground import Array, Ground
from roller_sim_ros.exciter import Revolution
from roller_sim_ros.half_space.two_pole import two_pole_frequency
from roller_sim_ros.parameters import Soil


class TwoPoleGround(Ground):
    """Drum on the two-pole half space: the surface's depth and rate are its whole history."""

    def _start(self) -> None:
        super()._start()
        self._bends = np.zeros(BENDS_SHAPE)

    def _change(self, soil: Soil, revolution: Revolution) -> None:
        constants, state = self._constants, self.state
        omega = two_pole_frequency(
            soil.shear_modulus_pa,
            soil.density_kg_m3,
            self.strip.half_width_m,
            self.strip.half_length_m,
            self._half_space.frequency_factor,
        )
        constants[at.NATURAL_FREQUENCY] = omega
        constants[at.QUALITY] = self._half_space.quality_factor
        if state[at.PHASE] != at.UNLOADING:
            return
        # In unloading the force follows from the surface's state. So that it stays, the surface takes the depth
        # that goes with it on the new soil, and the datum makes up for the difference.
        thrust = revolution.start_acceleration * self._direction.vertical_sine * self._sine[0]
        mass, load = self._machine.drum_mass_kg, self._machine.static_load_n
        sinking = (load - state[at.FORCE]) / mass - thrust
        damping = omega / self._half_space.quality_factor
        surface = self.strip.static_compliance * state[at.FORCE] - (
            sinking + damping * state[at.SURFACE_VELOCITY]
        ) / (omega * omega)
        state[at.DATUM] += state[at.SURFACE] - surface
        state[at.SURFACE] = surface

    def advance(self, first: int, samples: int) -> Array:
        """Step over samples first … first + samples − 1 of the revolution."""
        out = np.empty((at.OUT_ROWS, samples))
        two_pole_kernel.advance(
            samples,
            first,
            self.state,
            self._constants,
            self._sine,
            self._cosine,
            self._angle,
            self._bends,
            out,
        )
        return out
