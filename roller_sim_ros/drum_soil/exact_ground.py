# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Ground whose half space is the exact one."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from roller_sim_ros.drum_soil import exact_kernel
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.finite_memory import BENDS_SHAPE
from roller_sim_ros.drum_soil.ground import NO_MODES, Array, Ground
from roller_sim_ros.exciter import Revolution
from roller_sim_ros.half_space.transient import memory, step_and_ramp
from roller_sim_ros.parameters import Soil


class ExactGround(Ground):
    """Drum on the exact half space: history as the free motion that the surface would go on with."""

    def _start(self) -> None:
        super()._start()
        self._free = np.zeros(0)
        self._free_rate = np.zeros(0)
        self._bends = np.zeros(BENDS_SHAPE)
        self._answers: tuple[Array, ...] = ()
        # The free motion at the last change, for resampling: its step, its length, and the time for which
        # waves of an earlier soil are still under way.
        self._memory = 0
        self._old_step_s = 0.0
        self._old_compliance = self.strip.static_compliance
        self._own_memory_s = 0.0
        self._old_waves_s = 0.0

    @property
    def memory_samples(self) -> int:
        """Samples for which the surface still answers to a force."""
        return self._memory

    def begin(self, revolution: Revolution, soil: Soil) -> None:
        """Take over the plan and the soil of the next revolution."""
        self._old_waves_s = max(0.0, self._old_waves_s - self._samples * self._old_step_s)
        super().begin(revolution, soil)

    def _change(self, soil: Soil, revolution: Revolution) -> None:
        h = revolution.sample_period_s
        unit = self.strip.time_unit_s
        alpha, nu = self.strip.aspect_ratio, soil.poisson_ratio
        own_memory_s = memory(alpha, nu) * unit
        if self._soil != soil:
            self._old_waves_s = max(self._old_waves_s, self._own_memory_s)
        self._own_memory_s = own_memory_s
        free_s = max(own_memory_s, self._old_waves_s)
        count = math.ceil(free_s / h) + 1
        compliance = self.strip.static_compliance
        self._answers = tuple(
            compliance * answer for answer in _answers(alpha, nu, unit, h, count + 1)
        )
        self._resample(h, count)
        self._old_step_s = h
        self._old_compliance = compliance
        self._memory = count

    def _resample(self, h: float, count: int) -> None:
        """Lay the free motion on the new sample times, about the new soil's rest under the present force.

        The waves under way go on as they were. The difference of the rests goes into the datum, so that neither the
        drum nor the force notices that the surface it rests on is another one.
        """
        state = self.state
        force = state[at.FORCE]
        rest = self.strip.static_compliance * force
        old_rest = self._old_compliance * force
        length = count + 1 + self._samples
        free, free_rate = np.full(length, rest), np.zeros(length)
        if self._old_step_s:
            times = h * np.arange(count + 1, dtype=np.float64)
            old = slice(0, self._memory + 1)
            waves, rate = _hermite(
                times, self._old_step_s, self._free[old] - old_rest, self._free_rate[old]
            )
            free[: count + 1] += waves
            free_rate[: count + 1] += rate
        state[at.SURFACE] += rest - old_rest
        state[at.DATUM] -= rest - old_rest
        self._free, self._free_rate = free, free_rate

    @property
    def kernel_arguments(self) -> tuple[Any, ...]:
        """State, constants, angles, the half space's answers, its free motion, no modes, scratch."""
        return (
            self.state,
            self._constants,
            self._sine,
            self._cosine,
            *self._answers,
            self._free,
            self._free_rate,
            NO_MODES,
            self._bends,
        )

    def advance(self, first: int, samples: int) -> Array:
        """Step over samples first … first + samples − 1 of the revolution."""
        out = np.empty((at.OUT_ROWS, samples))
        arguments: tuple[Any, ...] = (samples, first, *self.kernel_arguments, out)
        exact_kernel.advance(*arguments)
        return out


@lru_cache(maxsize=256)
def _answers(alpha: float, nu: float, unit: float, h: float, count: int) -> tuple[Array, ...]:
    """Return, for H0 = 1, the arrays of the kernel from `middle` to `bulge_rate`.

    Parameters
    ----------
    alpha, nu
        Of the loaded strip and the soil.
    unit
        √(BL)/v_s, s.
    h
        Sample period, s.
    count
        Number of samples k h, memory + 1.
    """
    spacing = h / unit
    times = spacing * np.append(np.arange(count, dtype=np.float64), 0.5)
    step, ramp = step_and_ramp(times, alpha, nu)
    step_middle, ramp_middle = step[-1], unit * ramp[-1]
    step, ramp = step[:-1], unit * ramp[:-1]
    # The integral of the cubics through R and s.
    growth = 0.5 * h * (ramp[1:] + ramp[:-1]) - h * h / 12.0 * np.diff(step)
    ramp_2 = np.concatenate(([0.0], np.cumsum(growth)))
    ramp_2_middle = 0.25 * h * ramp_middle - h * h / 48.0 * step_middle
    return (
        np.array([ramp_2_middle, ramp_middle, step_middle]),
        ramp_2,
        ramp,
        step,
        np.diff(ramp) / h,
        np.diff(step) / h,
        h * (step[1:] + step[:-1]) - 2.0 * np.diff(ramp),
    )


def _hermite(times: Array, h: float, values: Array, rates: Array) -> tuple[Array, Array]:
    """Return value and rate, at `times`, of the cubics through values and rates at k h; 0 beyond the last."""
    position = times / h
    last = values.shape[0] - 1
    index = np.minimum(position.astype(np.int64), last - 1)
    u = position - index
    v = 1.0 - u
    f_0, f_1, r_0, r_1 = values[index], values[index + 1], rates[index], rates[index + 1]
    value = (1.0 + 2.0 * u) * v * v * f_0 + u * u * (3.0 - 2.0 * u) * f_1
    value += u * v * v * h * r_0 - u * u * v * h * r_1
    rate = 6.0 * u * v * (f_1 - f_0) / h + v * (1.0 - 3.0 * u) * r_0 + u * (3.0 * u - 2.0) * r_1
    inside = position <= last
    return np.where(inside, value, 0.0), np.where(inside, rate, 0.0)
