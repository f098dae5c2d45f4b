# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements on the elastic half space: eqs (5) to (9), Figures 5 to 8."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize

from roller_sim_ros.half_space import (
    exact_compliance,
    influence_integral,
    normalised_compliance,
    radiated_energy,
    rational_compliance,
    rational_half_space,
    sung_functions,
    two_pole_compliance,
)
from roller_sim_ros.parameters import Configuration, Soil
from roller_sim_ros.soil_mechanics import contact_half_width
from roller_sim_ros.validation.statement import Finding, Statement, Verdict, percent
from roller_sim_ros.validation.study import SOFT, STIFF, Array, Study, aspect_ratio

Complex = npt.NDArray[np.complex128]

POISSON_RATIO = Soil().poisson_ratio

EFFECTIVE_RADII = {"parabolic": 0.75, "uniform": 1.0, "rigid": 4.0 / math.pi}
"""Radius of the uniform load with the same static displacement, over r_0; the paper: 0.75 and 1.273."""

FITTED_A0 = 3.0
"""Up to which the two-pole function is fitted to the square."""


def displacement(alpha: Array, formula: str) -> Array:
    """Return D of eq. (5), with the exact integral or the paper's formula."""
    integral = np.array([influence_integral(float(value), formula) for value in alpha])
    return 3.0 * integral / (4.0 * math.pi * alpha)


def over_square(alpha: float | Array) -> Array:
    """Return the displacement of a rectangle over that of the square of the same area, under the same load."""
    # δ ~ D/B, and B = √(area/4α).
    ratio = np.atleast_1d(np.asarray(alpha, dtype=np.float64))
    relation = displacement(ratio, "exact") * np.sqrt(ratio) / displacement(np.ones(1), "exact")
    return relation.reshape(np.shape(alpha))


def two_pole(a0: Array, quality: float, factor: float) -> Complex:
    """Return H/H0 of the paper's second-order half space over a0 = ω √(BL)/v_s."""
    s = 1j * a0 / factor
    return np.asarray(1.0 / (1.0 + s / quality + s * s))


@lru_cache(maxsize=8)
def fitted_two_pole(alpha: float) -> tuple[float, float]:
    """Return Q and ω0 √(BL)/v_s of the second-order function nearest to the exact one, by least squares."""
    a0 = np.linspace(0.0, FITTED_A0, 121)
    exact = normalised_compliance(a0, alpha, POISSON_RATIO)

    def off(x: Array) -> float:
        return float(np.sum(np.abs(two_pole(a0, x[0], x[1]) - exact) ** 2))

    start: npt.NDArray[np.float64] = np.array([0.6, 2.75])
    found = minimize(off, start, method="Nelder-Mead")
    return float(found.x[0]), float(found.x[1])


def compliance(configuration: Configuration, omega: Array) -> Complex:
    """Return H(iω) of the half space under the roller, m/N."""
    soil, chosen = configuration.soil, configuration.half_space
    half_width = chosen.area_factor * contact_half_width(
        soil.plastic_parameter_m, configuration.machine.drum_radius_m
    )
    strip = (
        soil.shear_modulus_pa,
        soil.density_kg_m3,
        soil.poisson_ratio,
        half_width,
        0.5 * configuration.machine.drum_width_m,
    )
    if chosen.model == "exact":
        return exact_compliance(omega, *strip)
    if chosen.model == "rational":
        return rational_compliance(omega, *strip, chosen.order)
    return two_pole_compliance(omega, *strip, chosen.quality_factor, chosen.frequency_factor)


def influence_formula(study: Study) -> Finding:  # noqa: ARG001
    """Eq. (6) against the exact integral."""
    alpha = np.linspace(2.0, 100.0, 981)
    error = float(np.abs(displacement(alpha, "paper") / displacement(alpha, "exact") - 1.0).max())
    square = influence_integral(1.0, "paper") / influence_integral(1.0) - 1.0
    return Finding.of(
        error < 0.01, f"within {percent(error)} for α from 2 to 100, {percent(square)} at 1"
    )


def falling_displacement(study: Study) -> Finding:  # noqa: ARG001
    """Shape of Figure 5."""
    alpha = np.geomspace(1.0, 100.0, 201)
    values = displacement(alpha, "exact")
    return Finding.of(
        bool(np.all(np.diff(values) < 0.0)),
        f"D falls from {values[0]:.3f} at α = 1 to {values[100]:.3f} at 10 and {values[-1]:.4f} at 100",
    )


def shape_counts(study: Study) -> Finding:
    """Shape of Figure 6, and the strip under the roller."""
    alpha = np.geomspace(1.0, 100.0, 201)
    falls = bool(np.all(np.diff(over_square(alpha)) < 0.0))
    strip = aspect_ratio(study.on(STIFF))
    ten, hundred = over_square(np.array([10.0, 100.0]))
    return Finding.of(
        falls,
        f"falls from 1 to {ten:.2f} at α = 10 and {hundred:.2f} at 100; {float(over_square(strip)):.2f} under the "
        f"roller at 80 MPa (α {strip:.1f} with k = {study.base.half_space.area_factor:g})",
    )


def lag(study: Study) -> Finding:
    """Amplitude and lag at the nominal frequency."""
    omega = np.array([0.0, 2.0 * math.pi * study.base.exciter.frequency_hz])
    texts, holds = [], True
    for ground in (SOFT, STIFF):
        still, moving = compliance(study.on(ground), omega)
        lagging = -math.degrees(float(np.angle(moving)))
        holds = holds and lagging > 0.0 and abs(moving) != abs(still)
        texts.append(
            f"|H| = {abs(moving / still):.2f} H0, {lagging:.0f}° late at {ground[0] / 1e6:.0f} MPa"
        )
    return Finding.of(holds, f"at {study.base.exciter.frequency_hz:g} Hz: {'; '.join(texts)}")


def radiation(study: Study) -> Finding:  # noqa: ARG001
    """Where the radiated energy goes."""
    energy = radiated_energy(POISSON_RATIO)
    return Finding.of(
        energy.total > 0.0 and energy.rayleigh > 0.0,
        f"{percent(energy.rayleigh, 3)} along the surface as Rayleigh waves, {percent(energy.shear, 3)} as shear, "
        f"{percent(energy.compression, 2)} as compression waves (point load, ν {POISSON_RATIO:g})",
    )


def effective_radii(study: Study) -> Finding:  # noqa: ARG001
    """Effective radii of the circular loads, and how far the curves then lie apart."""
    uniform = float(sung_functions(0.0, POISSON_RATIO, "uniform").real)
    radii = {
        load: uniform / float(sung_functions(0.0, POISSON_RATIO, load).real)
        for load in EFFECTIVE_RADII
    }
    a0 = np.linspace(0.0, 1.0, 51)
    reference = sung_functions(a0, POISSON_RATIO, "uniform")
    apart = max(
        float(np.abs(sung_functions(a0 / radius, POISSON_RATIO, load) * radius - reference).max())
        / uniform
        for load, radius in radii.items()
    )
    right = abs(radii["rigid"] - 1.273) < 1e-3 and abs(radii["parabolic"] - 0.75) < 1e-3
    return Finding.of(
        right and apart < 0.1,
        f"from the static displacement {radii['rigid']:.3f} r₀ and {radii['parabolic']:.3f} r₀; with them the curves "
        f"are within {percent(apart)} of the static value of each other up to a₀ = 1",
    )


def quality_factor(study: Study) -> Finding:  # noqa: ARG001
    """The two-pole function nearest to the exact square."""
    quality, factor = fitted_two_pole(1.0)
    return Finding.of(
        abs(quality - 0.6) < 0.05,
        f"fitted to the exact square up to a₀ = {FITTED_A0:g}: Q {quality:.2f}, ω₀√(BL)/v_s {factor:.2f}",
    )


def more_poles(study: Study) -> Finding:  # noqa: ARG001
    """Errors of two and four poles on the square."""
    a0 = np.linspace(0.0, 2.0, 201)
    exact = normalised_compliance(a0, 1.0, POISSON_RATIO)
    two = float(np.abs(two_pole(a0, *fitted_two_pole(1.0)) - exact).max())
    four = float(
        np.abs(rational_half_space(1.0, POISSON_RATIO, 4, 2.0).compliance(a0) - exact).max()
    )
    return Finding.of(
        four < two,
        f"on the square up to a₀ = 2: 2 poles within {two:.2g} H0, 4 within {four:.2g} H0",
    )


def reshaping(study: Study) -> Finding:
    """What taking the strip for a square of the same area costs."""
    alpha = aspect_ratio(study.on(STIFF))
    a0 = np.linspace(0.0, 1.0, 101)
    exact = normalised_compliance(a0, alpha, POISSON_RATIO)
    apart = np.abs(two_pole(a0, *fitted_two_pole(1.0)) - exact)
    worst = float(apart.max())
    damped = float(np.abs(two_pole(a0, 0.4, 2.75) - exact).max())
    return Finding.of(
        worst < 0.05,
        f"at α {alpha:.1f} the square's function is off by up to {worst:.2f} H0 below a₀ = 1, with Q 0.4 by "
        f"{damped:.2f} H0: the lower Q also makes up for the shape",
        otherwise=Verdict.PARTLY,
    )


STATEMENTS = (
    Statement(
        "influence_formula",
        "Eq. (6)",
        "the integral is very closely approximated by 0.66 ln(7.9 α)",
        influence_formula,
        "figures 5",
        half_space=False,
    ),
    Statement(
        "falling_displacement",
        "Figure 5",
        "shape: D falls with the length/width ratio",
        falling_displacement,
        "figures 5",
        half_space=False,
    ),
    Statement(
        "shape_counts",
        "Figure 6",
        "shape: at one area and load, a rectangle sinks less than a square",
        shape_counts,
        "figures 6",
        half_space=False,
    ),
    Statement(
        "lag",
        "Dynamic load",
        "under a load that varies the amplitude relation changes and the deformation lags behind",
        lag,
    ),
    Statement(
        "radiation",
        "Dynamic load",
        "energy flows away as elastic waves into the medium and along the surface",
        radiation,
        half_space=False,
    ),
    Statement(
        "effective_radii",
        "Figure 7",
        "the curves of the circular loads collapse with effective radii 1.273 r₀ (rigid) and 0.75 r₀ (parabolic)",
        effective_radii,
        "figures 7",
        half_space=False,
    ),
    Statement(
        "more_poles",
        "Eq. (9), Figure 8",
        "the accuracy depends on the number of poles and zeros",
        more_poles,
        "figures 8",
        half_space=False,
    ),
    Statement(
        "quality_factor",
        "Elastic transfer function",
        "the two-pole function of a rectangular area has Q 0.6",
        quality_factor,
        "figures 8",
        half_space=False,
    ),
    Statement(
        "reshaping",
        "Elastic transfer function",
        "the frequency scale of the strip is that of an area of the same size reshaped to the ratio of the data",
        reshaping,
        "figures 8",
        half_space=False,
    ),
)
