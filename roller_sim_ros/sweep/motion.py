# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The settled motion of some points, side by side: what every value of a sweep is made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.harmonics import Harmonics
from roller_sim_ros.meters.period import CANDIDATES, NO_PERIOD, TOLERANCE
from roller_sim_ros.meters.registry import ORDERS
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session.block import AIR

Array = NDArray[np.float64]

UNKNOWN = -1
"""Period of a motion that is no whole revolutions, or too few to tell."""


@dataclass(frozen=True)
class Motion:
    """The last revolutions of some points' runs; the arrays have the shape (points, revolutions, samples).

    Of a motion that repeats to rounding these are two periods: means and extremes over them are those over all of
    the run's last revolutions.

    Attributes
    ----------
    configurations : sequence of Configuration
        All parameters of each point.
    synchronous : ndarray of bool, shape (points,)
        Whether every revolution of samples is one of the eccentric, all at one frequency.
    vertical : ndarray
        Vertical acceleration of the drum, m/s².
    soil_force : ndarray
        F_s, N.
    drum_depth : ndarray
        Depth of the drum below the untouched surface, m, positive down.
    contact_state : ndarray
        LOADING, UNLOADING or AIR.
    """

    configurations: Sequence[Configuration]
    synchronous: NDArray[np.bool_]
    vertical: Array
    soil_force: Array
    drum_depth: Array
    contact_state: NDArray[np.generic]

    @property
    def points(self) -> int:
        """Number of points."""
        return int(self.vertical.shape[0])

    @property
    def samples_per_revolution(self) -> int:
        """Samples in one revolution."""
        return int(self.vertical.shape[2])

    @cached_property
    def drum_motion(self) -> DrumMotion:
        """What a meter that knows its machine evaluates, all points at once."""
        machines = [item.machine for item in self.configurations]
        exciters = [item.exciter for item in self.configurations]
        drums = [
            Drum.of(machine, exciter) for machine, exciter in zip(machines, exciters, strict=True)
        ]
        return DrumMotion(
            vertical=self.vertical.reshape(self.points, -1),
            drum=Drum(
                mass_kg=np.array([item.mass_kg for item in drums]),
                static_load_n=self.static_load_n,
                radius_m=np.array([item.radius_m for item in drums]),
                width_m=np.array([item.width_m for item in drums]),
                vertical_share=np.array([item.vertical_share for item in drums]),
            ),
            amplitude_m=np.array([item.amplitude_m for item in exciters]),
            frequency_hz=np.array([item.frequency_hz for item in exciters]),
            samples_per_revolution=self.samples_per_revolution,
        )

    @cached_property
    def static_load_n(self) -> Array:
        """F_stat, N, shape (points,)."""
        return np.array([item.machine.static_load_n for item in self.configurations])

    @cached_property
    def air(self) -> NDArray[np.bool_]:
        """Whether the drum is in the air, shape (points, revolutions × samples)."""
        in_air: NDArray[np.bool_] = self.contact_state == AIR
        return in_air.reshape(self.points, -1)

    @cached_property
    def period(self) -> NDArray[np.int8]:
        """Revolutions after which the motion repeats, as `roller_sim_ros.meters.period`; `UNKNOWN` for None."""
        vertical = self.vertical.reshape(self.points, -1)
        bound = TOLERANCE * np.abs(vertical).max(axis=1)
        period = np.full(self.points, NO_PERIOD, dtype=np.int8)
        for candidate in reversed(CANDIDATES):
            if 2 * candidate > self.vertical.shape[1]:
                # What is longer than half the window is unknown, unless a shorter period is found.
                period[:] = UNKNOWN
                continue
            shift = candidate * self.samples_per_revolution
            change = np.abs(vertical[:, shift:] - vertical[:, :-shift]).max(axis=1)
            period[change <= bound] = candidate
        period[~self.synchronous] = UNKNOWN
        return period

    @cached_property
    def harmonics(self) -> Harmonics:
        """Amplitudes of the vertical acceleration at all orders that the meters need; each an array of the points."""
        points, revolutions, samples = self.vertical.shape
        # Orders are multiples of a half: two revolutions tell all of them.
        folded = self.vertical.reshape(points, revolutions // 2, 2 * samples).sum(axis=1)
        amplitudes = np.empty((len(ORDERS), points), dtype=np.complex128)
        for place, order in enumerate(ORDERS):
            turns = (order * np.arange(2 * samples) / samples) % 1.0
            wave = np.exp(-2j * np.pi * turns)
            amplitudes[place].real = (folded * wave.real).sum(axis=1)
            amplitudes[place].imag = (folded * wave.imag).sum(axis=1)
        amplitudes *= 2.0 / (revolutions * samples)
        return _HarmonicsOfMany(ORDERS, amplitudes)


class _HarmonicsOfMany(Harmonics):
    """Harmonics of many motions, for the formulas of the meters, which hold for arrays as for numbers."""

    def amplitude(self, order: float) -> Any:
        value = self.amplitudes[self.orders.index(order)]
        return np.hypot(value.real, value.imag)
