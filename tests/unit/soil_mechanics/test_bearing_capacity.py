# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bearing capacity factors against the tables of textbooks, their limits, and each other."""

from __future__ import annotations

import itertools
import math

import pytest

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.soil_mechanics import (
    N_GAMMA,
    bearing_capacity,
    n_c,
    n_gamma_meyerhof,
    n_gamma_vesic,
    n_q,
)


# φ in degrees, N_c, N_q, N_γ of Vesić, N_γ of Meyerhof (Vesić 1973; Bowles, Foundation Analysis and Design).
@pytest.mark.parametrize(
    ("degrees", "cohesion", "surcharge", "vesic", "meyerhof"),
    [
        (0, 5.14, 1.00, 0.0, 0.0),
        (5, 6.49, 1.57, 0.45, 0.07),
        (10, 8.34, 2.47, 1.22, 0.37),
        (20, 14.83, 6.40, 5.39, 2.87),
        (30, 30.14, 18.40, 22.40, 15.67),
        (36, 50.59, 37.75, 56.31, 44.43),
        (40, 75.31, 64.20, 109.41, 93.69),
        (45, 133.88, 134.88, 271.76, 262.74),
    ],
)
def test_factors_are_those_of_the_tables(
    degrees: float, cohesion: float, surcharge: float, vesic: float, meyerhof: float
) -> None:
    angle = math.radians(degrees)
    last_digit = 0.006
    assert n_c(angle) == pytest.approx(cohesion, rel=1e-4, abs=last_digit)
    assert n_q(angle) == pytest.approx(surcharge, rel=1e-4, abs=last_digit)
    assert n_gamma_vesic(angle) == pytest.approx(vesic, rel=1e-4, abs=last_digit)
    assert n_gamma_meyerhof(angle) == pytest.approx(meyerhof, rel=1e-4, abs=last_digit)


def test_cohesion_factor_goes_to_prandtls_value_without_a_step() -> None:
    prandtl = 2.0 + math.pi
    assert n_c(0.0) == prandtl
    # The next term of the series is (1 + π/2)² φ + …, so the difference goes with φ.
    for angle in (1e-3, 1e-6, 1e-9, 1e-12):
        assert n_c(angle) == pytest.approx(prandtl, rel=4.0 * angle + 1e-15)
        assert n_c(angle) > prandtl - 1e-14


def test_factors_grow_with_the_friction_angle() -> None:
    angles = [math.radians(degrees) for degrees in range(1, 61)]
    for factor in (n_q, n_c, *N_GAMMA.values()):
        for low, high in itertools.pairwise(angles):
            assert factor(low) < factor(high)


def test_authors_part_ways_at_loose_and_dense_ground() -> None:
    # Meyerhof's is the smaller one up to 47°, then tan 1.4 φ takes over.
    for degrees in range(5, 46):
        assert n_gamma_meyerhof(math.radians(degrees)) < n_gamma_vesic(math.radians(degrees))
    assert n_gamma_meyerhof(math.radians(50)) > n_gamma_vesic(math.radians(50))


def test_capacity_is_the_sum_of_three_parts() -> None:
    angle, half_width, weight = math.radians(30.0), 0.5, 18e3
    only_weight = bearing_capacity(angle, half_width, weight)
    assert only_weight == pytest.approx(0.5 * 18e3 * 22.402, rel=1e-4)
    # The usual form: half the full width.
    assert only_weight == pytest.approx(0.5 * (2.0 * half_width) * weight * n_gamma_vesic(angle))
    with_both = bearing_capacity(angle, half_width, weight, cohesion_pa=10e3, surcharge_pa=5e3)
    assert with_both - only_weight == pytest.approx(10e3 * 30.140 + 5e3 * 18.401, rel=1e-4)
    meyerhof = bearing_capacity(angle, half_width, weight, n_gamma="meyerhof")
    assert meyerhof == pytest.approx(only_weight * 15.668 / 22.402, rel=1e-4)


@pytest.mark.parametrize("angle", [-0.01, math.radians(61), math.nan, math.inf])
def test_angles_that_no_ground_has_are_refused(angle: float) -> None:
    for factor in (n_q, n_c, *N_GAMMA.values()):
        with pytest.raises(ParameterError, match="friction_angle_rad.*60°"):
            factor(angle)


def test_unknown_author_is_refused_by_name() -> None:
    with pytest.raises(
        ParameterError, match="n_gamma = 'terzaghi': must be one of vesic, meyerhof"
    ):
        bearing_capacity(0.5, 0.1, 18e3, n_gamma="terzaghi")
