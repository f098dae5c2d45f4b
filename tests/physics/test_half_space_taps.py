# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""FIR taps of the sampled half space under a piecewise-linear force."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.half_space import (
    HalfSpaceError,
    exact_compliance,
    static_compliance,
    step_response,
    taps,
)
from roller_sim_ros.half_space.transient import step_and_ramp

DENSITY = 2000.0
SAMPLES_PER_REVOLUTION = 128


def sampled(shear, poisson_ratio, plastic, frequency):
    """Taps of the paper's drum (radius 0.75 m, half width 1.05 m, k 4) and what they belong to."""
    b, length = 4.0 * math.sqrt(2.0 * 0.75 * plastic), 1.05
    h0 = static_compliance(shear, poisson_ratio, b, length)
    unit_time = math.sqrt(b * length * DENSITY / shear)
    period = 1.0 / (frequency * SAMPLES_PER_REVOLUTION)
    response = step_response(length / b, poisson_ratio)
    h, g = taps(response, h0, unit_time, period)
    return h, g, h0, unit_time, period, (b, length)


@given(
    st.floats(15e6, 120e6),
    st.floats(0.15, 0.45),
    st.floats(0.2e-3, 1.6e-3),
    st.floats(15.0, 40.0),
)
@settings(deadline=None, max_examples=40)
def test_frequency_response_is_the_exact_compliance(shear, poisson_ratio, plastic, frequency):
    h, _, _, _, period, (b, length) = sampled(shear, poisson_ratio, plastic, frequency)
    harmonic = np.arange(1, 6)
    omega = 2.0 * np.pi * frequency * harmonic
    found = np.exp(-1j * np.outer(omega * period, np.arange(h.size))) @ h
    exact = exact_compliance(omega, shear, DENSITY, poisson_ratio, b, length)
    error = np.abs(found - exact) / np.abs(exact)
    assert np.all(error[:3] <= 0.0025)
    assert error[4] <= 0.006
    # A force that is linear between samples has the spectrum sinc^2; the rest is aliasing.
    linear = exact * np.sinc(harmonic / SAMPLES_PER_REVOLUTION) ** 2
    assert np.all(np.abs(found - linear) <= 4e-4 * np.abs(exact))


@given(
    st.floats(2e6, 1e9),
    st.floats(0.0, 0.49),
    st.floats(2e-5, 2e-2),
    st.floats(15.0, 40.0),
)
@settings(deadline=None, max_examples=60)
def test_taps_sum_to_the_static_compliance_and_none_is_negative(
    shear, poisson_ratio, plastic, frequency
):
    h, g, h0, _, period, _ = sampled(shear, poisson_ratio, plastic, frequency)
    assert h.sum() == pytest.approx(h0, rel=1e-12)
    assert h.min() >= -1e-7 * h0
    assert abs(g.sum()) <= 1e-12 * h0 / period


def test_number_of_taps_for_the_papers_machine():
    counts = [
        sampled(shear, 0.25, plastic, frequency)[0].size
        for shear, plastic in ((15e6, 1.6e-3), (35e6, 0.8e-3), (80e6, 0.5e-3), (120e6, 0.4e-3))
        for frequency in (15.0, 28.0, 40.0)
    ]
    assert min(counts) >= 10
    assert max(counts) <= 85


def test_taps_give_the_displacement_under_a_force_of_straight_lines():
    h, g, h0, unit_time, period, (b, length) = sampled(35e6, 0.25, 0.8e-3, 28.0)
    rng = np.random.default_rng(3)
    force = np.concatenate([[0.0], rng.uniform(0.0, 1e5, 150)])  # at rest before the first sample
    slopes = np.diff(force) / period
    kinks = np.diff(slopes, prepend=0.0)  # each starts a ramp at its sample
    displacement = np.convolve(force, h)[: force.size]
    velocity = np.convolve(force, g)[: force.size]
    for n in (1, 2, 40, 150):
        tau = (n - np.arange(kinks.size)) * period / unit_time
        step, ramp = step_and_ramp(np.maximum(tau, 0.0), length / b, 0.25)
        expected = h0 * unit_time * np.sum(kinks[: n + 1] * ramp[: n + 1])
        assert displacement[n] == pytest.approx(expected, rel=2e-6)
        assert velocity[n] == pytest.approx(h0 * np.sum(kinks * step), rel=1e-3)


def test_first_velocity_tap_is_the_response_to_the_last_slope():
    _, g, h0, unit_time, period, (b, length) = sampled(35e6, 0.25, 0.8e-3, 28.0)
    first = step_and_ramp(np.array([period / unit_time]), length / b, 0.25)[0][0]
    assert g[0] == pytest.approx(h0 * first / period, rel=1e-6)


def test_bad_arguments_are_named():
    with pytest.raises(HalfSpaceError, match=r"sample_period_s = 0\.0"):
        taps(step_response(9.6, 0.25), 1e-8, 3e-3, 0.0)
