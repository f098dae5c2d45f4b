# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What each kind of half space answers to a periodic force, at many shear moduli at once.

A new half space is one function and one line in `SURFACES`.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import loaded_strip
from roller_sim_ros.half_space.transient import memory, step_and_ramp
from roller_sim_ros.half_space.two_pole import two_pole_frequency
from roller_sim_ros.parameters import PARAMETERS, Configuration

Array = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
Surface = Callable[[Array, float, Configuration, int, int], ComplexArray]
"""Of moduli G, shape (g,), Pa; p, m; what is known; samples in a period; revolutions in it: H at the period's orders,
shape (g, samples/2 + 1), m/N."""

NODES = 600
"""Of the table of the ramp response from 0 to the memory; cubic between them, so that e is good to 1e-4."""


G_NAME, P_NAME = "soil.shear_modulus_pa", "soil.plastic_parameter_m"
LEAST = np.array([PARAMETERS[name][0].minimum for name in (G_NAME, P_NAME)], dtype=np.float64)
MOST = np.array([PARAMETERS[name][0].maximum for name in (G_NAME, P_NAME)], dtype=np.float64)
"""Bounds of G, Pa, and p, m."""


def on(known: Configuration, shear_modulus_pa: float, plastic_parameter_m: float) -> Configuration:
    """Return what is known with a ground, kept within the bounds."""
    modulus, plastic = np.clip([shear_modulus_pa, plastic_parameter_m], LEAST, MOST)
    return known.changed({G_NAME: float(modulus), P_NAME: float(plastic)})


def _exact(
    moduli: Array, plastic: float, known: Configuration, count: int, period: int
) -> ComplexArray:
    """The answer to a force that is linear between the samples, in the time domain: its memory is finite."""
    base = on(known, float(moduli[0]), plastic)
    strip = loaded_strip(base.machine, base.soil, base.half_space)
    times_stiffer = moduli / moduli[0]
    compliance = strip.static_compliance / times_stiffer
    unit = strip.time_unit_s / np.sqrt(times_stiffer)
    step_s = period / (count * known.exciter.frequency_hz)
    alpha, nu = strip.aspect_ratio, base.soil.poisson_ratio
    taps = math.ceil(memory(alpha, nu) * float(unit.max()) / step_s) + 1
    times = np.arange(-1, taps + 1) * step_s / unit[:, np.newaxis]
    ramps = _ramp(times, alpha, nu)
    answers = (compliance * unit / step_s)[:, np.newaxis] * np.diff(ramps, 2, axis=1)
    # A period shorter than the memory hears its own echo.
    periods = -(-answers.shape[1] // count)
    folded = np.zeros((len(moduli), periods * count))
    folded[:, : answers.shape[1]] = answers
    return np.asarray(np.fft.rfft(folded.reshape(len(moduli), periods, count).sum(axis=1), axis=1))


def _ramp(times: Array, alpha: float, nu: float) -> Array:
    """Return R at dimensionless times, 0 before 0."""
    table = _ramp_table(alpha, nu)
    spacing, step, ramp = table
    end = spacing * (NODES - 1)
    position = np.clip(times / spacing, 0.0, NODES - 1.0)
    index = np.minimum(position.astype(np.int64), NODES - 2)
    u = position - index
    v = 1.0 - u
    value = (1.0 + 2.0 * u) * v * v * ramp[index] + u * u * (3.0 - 2.0 * u) * ramp[index + 1]
    value += spacing * u * v * (v * step[index] - u * step[index + 1])
    return np.asarray(value + np.maximum(times - end, 0.0))


@functools.lru_cache(maxsize=256)
def _ramp_table(alpha: float, nu: float) -> tuple[float, Array, Array]:
    """Return spacing, s and R."""
    times = np.linspace(0.0, memory(alpha, nu), NODES)
    step, ramp = step_and_ramp(times, alpha, nu)
    return float(times[1]), step, ramp


def _two_pole(
    moduli: Array, plastic: float, known: Configuration, count: int, period: int
) -> ComplexArray:
    base = on(known, float(moduli[0]), plastic)
    strip = loaded_strip(base.machine, base.soil, base.half_space)
    times_stiffer = (moduli / moduli[0])[:, np.newaxis]
    natural = two_pole_frequency(
        base.soil.shear_modulus_pa,
        base.soil.density_kg_m3,
        strip.half_width_m,
        strip.half_length_m,
        base.half_space.frequency_factor,
    )
    omega = 2.0 * math.pi * known.exciter.frequency_hz / period * np.arange(count // 2 + 1)
    s = 1j * omega / (natural * np.sqrt(times_stiffer))
    answer = 1.0 + s / base.half_space.quality_factor + s * s
    return np.asarray(strip.static_compliance / times_stiffer / answer)


SURFACES: dict[str, Surface] = {
    "exact": _exact,
    # It is a fit to the exact one, and this is a start.
    "rational": _exact,
    "two-pole": _two_pole,
}
