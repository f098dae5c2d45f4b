# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""G_max of Hardin and Richart: units, limits, monotonicity; mean stress from K_0 and depth."""

from __future__ import annotations

import itertools
import math

import pytest

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.soil_mechanics import GRAINS, mean_effective_stress, small_strain_modulus

PSI = 6894.757293168


@pytest.mark.parametrize(
    ("grains", "first", "second"), [("round", 2630, 2.17), ("angular", 1230, 2.97)]
)
def test_in_pounds_per_square_inch_it_is_the_classic_form(
    grains: str, first: float, second: float
) -> None:
    for void_ratio, stress_psi in ((0.4, 10.0), (0.65, 1.7), (0.9, 40.0)):
        classic = first * (second - void_ratio) ** 2 / (1.0 + void_ratio) * math.sqrt(stress_psi)
        modulus = small_strain_modulus(void_ratio, stress_psi * PSI, grains)
        assert modulus / PSI == pytest.approx(classic, rel=1e-9)


@pytest.mark.parametrize(
    ("grains", "second", "metric"), [("round", 2.17, 6906), ("angular", 2.97, 3230)]
)
def test_in_kilopascals_it_has_the_metric_constants(
    grains: str, second: float, metric: float
) -> None:
    # As the textbooks give it, rounded: G [kPa] = 6906 (2.17 − e)²/(1 + e) √(σ [kPa]), 3230 with 2.97.
    classic = metric * (second - 0.6) ** 2 / 1.6 * math.sqrt(100.0)
    assert small_strain_modulus(0.6, 100e3, grains) == pytest.approx(classic * 1e3, rel=1e-4)


def test_both_shapes_agree_where_their_ranges_meet() -> None:
    # The formulas were fitted to tests that overlap between 0.6 and 0.8.
    for void_ratio in (0.6, 0.7):
        round_, angular = (small_strain_modulus(void_ratio, 50e3, grains) for grains in GRAINS)
        assert angular == pytest.approx(round_, rel=0.15)
        assert angular > round_


@pytest.mark.parametrize("grains", list(GRAINS))
def test_denser_and_deeper_is_stiffer(grains: str) -> None:
    for denser, looser in itertools.pairwise([0.2 + 0.05 * step for step in range(20)]):
        assert small_strain_modulus(denser, 5e4, grains) > small_strain_modulus(looser, 5e4, grains)
    assert small_strain_modulus(0.5, 4e4, grains) == pytest.approx(
        2.0 * small_strain_modulus(0.5, 1e4, grains)
    )
    largest = GRAINS[grains].void_ratio
    assert small_strain_modulus(largest - 1e-6, 1e5, grains) < 1e-3


def test_mean_stress_from_lateral_pressure_and_depth() -> None:
    # All round pressure at K_0 = 1, a third of the vertical one without any.
    assert mean_effective_stress(20e3, 1.5, 1.0) == pytest.approx(30e3)
    assert mean_effective_stress(20e3, 1.5, 0.0) == pytest.approx(10e3)
    assert mean_effective_stress(18e3, 2.0, 0.5) == pytest.approx(24e3)


@pytest.mark.parametrize(
    ("void_ratio", "stress", "grains", "what"),
    [
        (0.0, 1e4, "round", "void_ratio = 0.0: must be between 0 and 2.17"),
        (2.2, 1e4, "round", "void_ratio = 2.2"),
        (3.0, 1e4, "angular", "between 0 and 2.97"),
        (math.nan, 1e4, "round", "void_ratio = nan"),
        (0.5, 0.0, "round", "mean_stress_pa = 0.0: must be positive"),
        (0.5, math.inf, "round", "mean_stress_pa = inf"),
        (0.5, 1e4, "flat", "grains = 'flat': must be one of round, angular"),
    ],
)
def test_what_has_no_stiffness_is_refused(
    void_ratio: float, stress: float, grains: str, what: str
) -> None:
    with pytest.raises(ParameterError, match=what):
        small_strain_modulus(void_ratio, stress, grains)
