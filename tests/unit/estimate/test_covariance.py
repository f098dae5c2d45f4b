# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Spreads from what a fit leaves."""

from __future__ import annotations

import numpy as np
import pytest

from roller_sim_ros.estimate.refine import CORRELATED, covariance

N = 512


def jacobian() -> np.ndarray:
    turns = np.arange(N) / N * 2.0 * np.pi
    return np.column_stack([np.sin(turns), np.cos(3.0 * turns) + 0.2 * np.sin(turns)])


def test_white_noise_gives_the_textbook_spread() -> None:
    draw = np.random.default_rng(1)
    J = jacobian()
    many = np.mean([covariance(J, 0.3 * draw.standard_normal(N)) for _ in range(200)], axis=0)
    np.testing.assert_allclose(many, 0.09 * np.linalg.inv(J.T @ J), rtol=0.15, atol=2e-5)


def test_what_is_alike_from_sample_to_sample_counts_as_less() -> None:
    draw = np.random.default_rng(2)
    J = jacobian()
    white = draw.standard_normal(N)
    alike = np.repeat(draw.standard_normal(N // 8), 8)
    ratio = np.diag(covariance(J, alike)) / np.diag(covariance(J, white))
    # Eight samples in a row count as one, shortened by the taper over CORRELATED samples.
    assert np.all(ratio > 0.5 * 8.0 * (1.0 - 8.0 / CORRELATED))


def test_what_does_not_matter_has_an_infinite_spread() -> None:
    J = jacobian()
    J[:, 1] = 0.0
    assert np.isinf(covariance(J, np.ones(N))).all()


@pytest.mark.parametrize("scale", [1.0, 1e-3])
def test_units_do_not_matter(scale: float) -> None:
    draw = np.random.default_rng(3)
    left, J = draw.standard_normal(N), jacobian()
    np.testing.assert_allclose(covariance(scale * J, scale * left), covariance(J, left), rtol=1e-9)
