# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Front of the kernels: what the half-space kinds have in common, and the interface they fill."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.modes import ROWS
from roller_sim_ros.exciter import DIRECTIONS, Direction, Revolution
from roller_sim_ros.half_space.static import static_compliance
from roller_sim_ros.parameters import Exciter, HalfSpace, Machine, Soil

Array = NDArray[np.float64]

NO_MODES = np.zeros((ROWS, 0), dtype=np.complex128)
"""For kernels whose half space has no modes."""


@dataclass(frozen=True)
class LoadedStrip:
    """The strip that loads the half space (paper, eqs 5 to 8).

    Attributes
    ----------
    half_width_m, half_length_m : float
        B = k √(2 r p) and L = W/2.
    static_compliance : float
        H0, m/N.
    shear_wave_speed : float
        v_s = √(G/ρ), m/s.
    """

    half_width_m: float
    half_length_m: float
    static_compliance: float
    shear_wave_speed: float

    @property
    def aspect_ratio(self) -> float:
        """α = L/B."""
        return self.half_length_m / self.half_width_m

    @property
    def time_unit_s(self) -> float:
        """√(BL)/v_s, in which the half space's own times are measured."""
        return math.sqrt(self.half_width_m * self.half_length_m) / self.shear_wave_speed


def loaded_strip(machine: Machine, soil: Soil, half_space: HalfSpace) -> LoadedStrip:
    """Return the strip under a machine on a soil."""
    half_width = half_space.area_factor * math.sqrt(
        2.0 * machine.drum_radius_m * soil.plastic_parameter_m
    )
    half_length = 0.5 * machine.drum_width_m
    return LoadedStrip(
        half_width_m=half_width,
        half_length_m=half_length,
        static_compliance=static_compliance(
            soil.shear_modulus_pa,
            soil.poisson_ratio,
            half_width,
            half_length,
            half_space.static_formula,
        ),
        shear_wave_speed=math.sqrt(soil.shear_modulus_pa / soil.density_kg_m3),
    )


class Ground(ABC):
    """Drum on plastic layer and elastic half space, stepped by a kernel.

    Starts in static equilibrium: F_s = F_stat, drum at rest.

    Parameters
    ----------
    machine, soil, half_space, exciter
        What is simulated. The soil may change from revolution to revolution.
    samples_per_revolution : int
        Samples per `Revolution`.

    Attributes
    ----------
    state : ndarray, shape (STATE_SIZE,)
        Physical state at the next sample, see `roller_sim_ros.drum_soil.state`.
    """

    def __init__(
        self,
        machine: Machine,
        soil: Soil,
        half_space: HalfSpace,
        exciter: Exciter,
        samples_per_revolution: int,
    ) -> None:
        self._machine = machine
        self._half_space = half_space
        self._samples = samples_per_revolution
        self._direction: Direction = DIRECTIONS[exciter.kind](exciter.tilt_rad)
        self._soil: Soil = soil
        self._revolution: Revolution | None = None
        self.strip = loaded_strip(machine, soil, half_space)
        self.state = np.zeros(at.STATE_SIZE)
        self._constants = np.zeros(at.CONSTANTS_SIZE)
        self._angle = np.zeros(samples_per_revolution + 1)
        self._sine = np.zeros(samples_per_revolution + 1)
        self._cosine = np.zeros(samples_per_revolution + 1)
        self._start()

    @property
    def unsettled_steps(self) -> int:
        """Steps whose phase changes did not settle; 0 in all sound runs."""
        return int(self.state[at.UNSETTLED_STEPS])

    def _start(self) -> None:
        load = self._machine.static_load_n
        self.state[at.FORCE] = load
        self.state[at.SURFACE] = self.strip.static_compliance * load
        self.state[at.PLASTIC] = self._soil.plastic_parameter_m
        self.state[at.DEPTH] = self.state[at.SURFACE] + self.state[at.PLASTIC]
        self.state[at.PHASE] = at.UNLOADING

    def begin(self, revolution: Revolution, soil: Soil) -> None:
        """Take over the plan and the soil of the next revolution; force and acceleration do not step."""
        if revolution is self._revolution and soil is self._soil:
            return
        self._revolution = revolution
        direction = self._direction
        constants = self._constants
        mass = self._machine.drum_mass_kg
        load = self._machine.static_load_n
        if soil != self._soil:
            self.strip = loaded_strip(self._machine, soil, self._half_space)
        changed = soil != self._soil or revolution.sample_period_s != constants[at.STEP]
        self._set_angles(revolution)
        constants[at.STEP] = revolution.sample_period_s
        constants[at.OMEGA] = revolution.omega
        constants[at.MASS] = mass
        constants[at.STATIC_LOAD] = load
        constants[at.PLASTIC_COMPLIANCE] = self._plastic_compliance(
            soil, revolution.sample_period_s
        )
        constants[at.STATIC_COMPLIANCE] = self.strip.static_compliance
        start, end = revolution.start_acceleration, revolution.end_acceleration
        constants[at.START_ACCELERATION] = start
        constants[at.ACCELERATION_RATE] = (end - start) / (
            self._samples * revolution.sample_period_s
        )
        constants[at.VERTICAL_SINE] = direction.vertical_sine
        constants[at.HORIZONTAL_SINE] = direction.horizontal_sine
        constants[at.HORIZONTAL_COSINE] = direction.horizontal_cosine
        if changed:
            self._change(soil, revolution)
        self._soil = soil

    def _plastic_compliance(self, soil: Soil, sample_period_s: float) -> float:
        """Return p/F_stat, m/N, as the kernel is to take it."""
        del sample_period_s
        return soil.plastic_parameter_m / self._machine.static_load_n

    def _set_angles(self, revolution: Revolution) -> None:
        angle = (
            revolution.phase_rad
            + np.arange(self._samples + 1, dtype=np.float64) * revolution.phase_increment_rad
        )
        if np.array_equal(angle, self._angle):
            return
        self._angle = angle
        self._sine = np.sin(angle)
        self._cosine = np.cos(angle)

    @abstractmethod
    def _change(self, soil: Soil, revolution: Revolution) -> None:
        """Take over another sample period or soil; `strip` and the constants are already the new ones."""

    @property
    @abstractmethod
    def kernel_arguments(self) -> tuple[Any, ...]:
        """What the kernel takes between the samples and the output; valid until the next `begin`."""

    @abstractmethod
    def advance(self, first: int, samples: int) -> Array:
        """Step over samples first … first + samples − 1 of the revolution.

        Returns
        -------
        ndarray, shape (OUT_ROWS, samples)
            The samples, rows as in `roller_sim_ros.drum_soil.state`.
        """
