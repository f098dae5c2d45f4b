# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's roller and grounds, and what the model makes of them: what statements and figures are made from.

What several of them need is computed once and kept for the process.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros import sweep
from roller_sim_ros.offline.run import Tail, run, step_whole_revolutions
from roller_sim_ros.parameters import Configuration, covarying_plastic_parameter
from roller_sim_ros.soil_mechanics import contact_half_width
from roller_sim_ros.sweep.plan import DEFAULT_REVOLUTIONS

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
Values = dict[str, NDArray[Any]]
Ground = tuple[float, float]
"""G in Pa, p in m."""

SOFT: Ground = (35e6, 0.8e-3)
"""The paper's softer ground (Figure 15, first diagram)."""

STIFF: Ground = (80e6, 0.5e-3)
"""The paper's stiffer ground (Figure 15, second diagram; Figures 16, 18 and 20)."""

FREQUENCIES_HZ = (15.0, 40.0)
AMPLITUDES_M = (0.1e-3, 2.5e-3)
"""The plane of Figures 16, 18 and 20; the paper's begins at 0 mm, where nothing vibrates."""

LOW_M, HIGH_M = 0.8e-3, 1.6e-3
"""The two amplitudes of Figure 19: 1.6 mm is the paper's nominal one; it does not name the lower."""

MODULI_PA = (15e6, 120e6)
"""Range of G over which meter values are looked at."""

EXAMPLES_PA = (10e6, 35e6, 50e6, 80e6)
"""Shear moduli of the examples of Figure 17, which the paper does not name; its force ratios begin at 2."""

LONG = 1000
"""Revolutions of single points: on the stiffer ground, 500 are too few to settle within 1 %."""

_SCANNED = 121
"""Amplitudes of a scan: every 0.02 mm."""

_FEWEST_MODULI = 61
"""Of Figure 19, where the dip of CMV is a few MPa wide."""

_POINTS_EACH = 64
"""Points that a thread computes at a time."""


@dataclass(frozen=True)
class Study:
    """What is asked: a roller on a kind of half space, and how finely.

    Attributes
    ----------
    base : Configuration
        Machine, exciter and half space; each question has its own ground.
    resolution : int
        Points along each axis of a map.
    revolutions : int
        Revolutions of each point of a map.
    workers : int or None
        Threads; one for each core when None. They change no number.
    """

    base: Configuration = field(default_factory=Configuration)
    resolution: int = 101
    revolutions: int = DEFAULT_REVOLUTIONS
    workers: int | None = None

    @classmethod
    def of(cls, half_space: str, **others: Any) -> Study:
        """Return the study of the paper's roller on a kind of half space, by its name."""
        return cls(Configuration().changed({"half_space.model": half_space}), **others)

    def on(self, ground: Ground, **exciter: Any) -> Configuration:
        """Return the roller on a ground, with other values of the exciter where given."""
        soil = replace(self.base.soil, shear_modulus_pa=ground[0], plastic_parameter_m=ground[1])
        return replace(self.base, soil=soil, exciter=replace(self.base.exciter, **exciter))


def covarying(shear_modulus_pa: float) -> Ground:
    """Return the ground of Figure 14 with a shear modulus; at the paper's two points, the paper's own p."""
    for ground in (SOFT, STIFF):
        if ground[0] == shear_modulus_pa:
            return ground
    return shear_modulus_pa, covarying_plastic_parameter(shear_modulus_pa)


def spaced(bounds: tuple[float, float], count: int) -> Array:
    """Return values from bound to bound, rounded to 12 digits as those of ``roller-sim sweep`` are."""
    return np.array([float(f"{value:.12g}") for value in np.linspace(*bounds, count)])


@lru_cache(maxsize=8)
def plane(study: Study) -> xarray.Dataset:
    """Return what the roller settles on over frequency and amplitude on the paper's stiffer ground."""
    axes = (
        sweep.Axis.of("exciter.frequency_hz", spaced(FREQUENCIES_HZ, study.resolution)),
        sweep.Axis.of("exciter.amplitude_m", spaced(AMPLITUDES_M, study.resolution)),
    )
    grid = sweep.Grid(axes, study.on(STIFF))
    return sweep.run(grid, revolutions=study.revolutions, workers=study.workers)


def settled(
    configurations: Sequence[Configuration], revolutions: int = LONG, workers: int | None = None
) -> Values:
    """Return the values that some points settle on from rest, {name: ndarray, shape (points,)}."""
    parts = [
        configurations[first : first + _POINTS_EACH]
        for first in range(0, len(configurations), _POINTS_EACH)
    ]
    with ThreadPoolExecutor(workers or len(os.sched_getaffinity(0))) as threads:
        found = list(threads.map(lambda part: sweep.values_at(part, revolutions), parts))
    return {name: np.concatenate([part[name] for part in found]) for name in found[0]}


@lru_cache(maxsize=64)
def point(configuration: Configuration) -> dict[str, float]:
    """Return the values that one point settles on from rest, after `LONG` revolutions."""
    values = sweep.values_at([configuration], LONG)
    return {name: float(array[0]) for name, array in values.items()}


@lru_cache(maxsize=64)
def motion(configuration: Configuration) -> Tail:
    """Return the last revolutions of one point's `LONG`, sample by sample."""
    step = step_whole_revolutions(configuration, run_up=False)
    return run(step, LONG, configuration.sampling.samples_per_revolution, lambda _: None)


@lru_cache(maxsize=8)
def stiffness_map(
    study: Study, moduli_pa: tuple[float, ...], amplitudes_m: tuple[float, ...]
) -> Values:
    """Return settled values over amplitude and G, p going with G as in Figure 14.

    Returns
    -------
    dict
        {name: ndarray, shape (amplitudes, moduli)}.
    """
    configurations = [
        study.on(covarying(modulus), amplitude_m=amplitude)
        for amplitude in amplitudes_m
        for modulus in moduli_pa
    ]
    values = settled(configurations, study.revolutions, study.workers)
    shape = (len(amplitudes_m), len(moduli_pa))
    return {name: array.reshape(shape) for name, array in values.items()}


@lru_cache(maxsize=8)
def amplitude_scan(study: Study) -> tuple[Array, NDArray[Any]]:
    """Return amplitudes, m, and the periods on the stiffer ground at the nominal frequency; where it lifts off."""
    amplitudes = spaced(AMPLITUDES_M, _SCANNED)
    values = settled(
        [study.on(STIFF, amplitude_m=float(amplitude)) for amplitude in amplitudes],
        study.revolutions,
        study.workers,
    )
    lifts = values["air_fraction"] > 0.0
    return amplitudes[lifts], values["period"][lifts]


def cmv_curves(study: Study) -> tuple[Array, Values]:
    """Return the shear moduli of Figure 19, Pa, and the values at its two amplitudes, shape (2, moduli)."""
    moduli = spaced(MODULI_PA, max(study.resolution, _FEWEST_MODULI))
    return moduli, stiffness_map(study, tuple(map(float, moduli)), (LOW_M, HIGH_M))


def aspect_ratio(configuration: Configuration) -> float:
    """Return α = L/B of the strip that loads the half space."""
    width = contact_half_width(
        configuration.soil.plastic_parameter_m, configuration.machine.drum_radius_m
    )
    return 0.5 * configuration.machine.drum_width_m / (configuration.half_space.area_factor * width)


def flattened(found: xarray.Dataset, headings: Mapping[str, str]) -> Values:
    """Return variables of a plane as columns: one row a point.

    Parameters
    ----------
    found : xarray.Dataset
        Over frequency and amplitude.
    headings : dict
        {variable: heading}.
    """
    frequency, amplitude = np.meshgrid(
        found.frequency_hz.values, found.amplitude_m.values * 1e3, indexing="ij"
    )
    columns = {"frequency_Hz": frequency.ravel(), "amplitude_mm": amplitude.ravel()}
    return columns | {heading: found[name].values.ravel() for name, heading in headings.items()}
