# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Static stiffness of the strip (paper, eqs 5 to 7) against independent values and a quadrature."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from roller_sim_ros.half_space import HalfSpaceError, influence_integral, static_compliance

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "reference" / "compliance.json").read_text(encoding="utf-8")
)


@pytest.mark.parametrize("row", REFERENCE["static"], ids=lambda row: f"{row['aspect_ratio']}")
def test_influence_integral_matches_independent_values(row):
    alpha = float(row["aspect_ratio"])
    assert influence_integral(alpha) == pytest.approx(row["I_exact"], abs=1e-8)
    assert influence_integral(alpha, "paper") == pytest.approx(row["I_paper"], abs=1e-8)


@pytest.mark.parametrize("alpha", [0.4, 1.0, 9.6, 60.0])
def test_influence_integral_is_the_boussinesq_integral(alpha):
    # I = int over one quadrant of (1 - x^2) / sqrt(x^2 + y^2), lengths in B. The inner integral over y
    # is asinh(alpha / x); its logarithm at x = 0 is removed by x = z^3.
    nodes, weights = np.polynomial.legendre.leggauss(80)
    z, w = 0.5 * (nodes + 1.0), 0.5 * weights
    x = z**3
    expected = np.sum(w * 3.0 * z**2 * (1.0 - x**2) * np.arcsinh(alpha / x))
    assert influence_integral(alpha) == pytest.approx(expected, rel=1e-9)


def test_paper_formula_is_within_its_stated_error():
    for alpha in np.geomspace(2.0, 100.0, 50):
        ratio = influence_integral(alpha, "paper") / influence_integral(alpha)
        assert abs(ratio - 1.0) <= 0.004
    assert influence_integral(1.0, "paper") / influence_integral(1.0) - 1.0 == pytest.approx(
        -0.0116, abs=1e-4
    )


def test_compliance_scales_as_eq_5():
    h0 = static_compliance(50e6, 0.25, 0.2, 1.0)
    displacement = 3.0 * 2.42527048 / (4.0 * math.pi * 5.0)  # D, eq. (5), at alpha = 5
    assert h0 == pytest.approx(displacement * 0.75 / (50e6 * 0.2), rel=1e-8)
    assert static_compliance(100e6, 0.25, 0.2, 1.0) == pytest.approx(h0 / 2.0)
    assert static_compliance(50e6, 0.25, 0.4, 2.0) == pytest.approx(h0 / 2.0)
    assert static_compliance(50e6, 0.4, 0.2, 1.0) == pytest.approx(h0 * 0.6 / 0.75)
    paper = static_compliance(50e6, 0.25, 0.2, 1.0, formula="paper")
    assert paper / h0 == pytest.approx(2.42635844 / 2.42527048, rel=1e-8)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((0.0, 0.25, 0.1, 1.0), "shear_modulus_pa = 0.0"),
        ((50e6, 0.5, 0.1, 1.0), "poisson_ratio = 0.5"),
        ((50e6, -0.1, 0.1, 1.0), "poisson_ratio = -0.1"),
        ((50e6, 0.25, math.nan, 1.0), "half_width_m = nan"),
        ((50e6, 0.25, 0.1, math.inf), "half_length_m = inf"),
    ],
)
def test_bad_arguments_are_named(arguments, named):
    with pytest.raises(HalfSpaceError, match=named):
        static_compliance(*arguments)


def test_formula_must_be_known_and_applicable():
    with pytest.raises(HalfSpaceError, match="'approximate'"):
        influence_integral(10.0, "approximate")
    with pytest.raises(HalfSpaceError, match=r"1/7\.9"):
        influence_integral(0.1, "paper")
