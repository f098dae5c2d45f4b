# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The accelerometer's noise and drift are those of the data sheet: statistically, within derived bounds.

All bounds are five standard deviations of the estimate, so that one test in two million fails by chance; the seeds
are fixed, so that none does.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import welch

from roller_sim_ros.sensors import Accelerometer, AccelerometerSheet
from roller_sim_ros.sensors.bias import GaussMarkov
from roller_sim_ros.sensors.second_order import variance
from tests.motions import blocks

Array = NDArray[np.float64]
HZ = 28.0
RATE_HZ = HZ * 128
DENSITY = 0.02
REVOLUTIONS = 1200


def noise_of(seed: int = 11, revolutions: int = REVOLUTIONS, **values: float) -> Array:
    """Return what a sensor at rest reads beside gravity, on both axes."""
    sensor = Accelerometer(AccelerometerSheet(**values), seed)  # type: ignore[arg-type]
    readings = [item for block in blocks(revolutions, hz=HZ) for item in sensor.read(block)]
    return np.stack(
        [
            np.concatenate([item.vertical for item in readings]).astype(float) - 9.81,
            np.concatenate([item.horizontal for item in readings]).astype(float),
        ]
    )


@pytest.fixture(scope="module")
def white() -> Array:
    return noise_of(noise_density=DENSITY)


@pytest.fixture(scope="module")
def shaped() -> Array:
    return noise_of(noise_density=DENSITY, bandwidth_hz=500.0)


def test_white_noise_has_the_variance_of_its_density_up_to_half_the_rate(white: Array) -> None:
    deviation = DENSITY * math.sqrt(RATE_HZ / 2.0)
    count = white.shape[1]
    for axis in white:
        # The mean of n independent numbers is off by σ/√n, their variance by σ² √(2/n).
        assert abs(axis.mean()) < 5.0 * deviation / math.sqrt(count)
        assert np.var(axis) == pytest.approx(deviation**2, rel=5.0 * math.sqrt(2.0 / count))
    # The axes have nothing to do with one another: their correlation is off 0 by 1/√n.
    assert abs(np.corrcoef(white)[0, 1]) < 5.0 / math.sqrt(count)
    # And it is normal: the fourth moment is 3 within √(24/n).
    kurtosis = np.mean(white[0] ** 4) / np.var(white[0]) ** 2
    assert kurtosis == pytest.approx(3.0, abs=5.0 * math.sqrt(24.0 / count))


def test_shaped_noise_has_the_variance_of_the_noise_bandwidth(shaped: Array) -> None:
    expected = DENSITY**2 * variance(500.0)
    # The squares of correlated numbers: Var(s²) = 2 σ⁴/n Σ ρ_k², with ρ of a Butterworth of second order,
    # e^(−x) (cos x + sin x), x = ω t/√2.
    turn = 2.0 * math.pi * 500.0 / RATE_HZ / math.sqrt(2.0) * np.arange(1, 200)
    rho = np.exp(-turn) * (np.cos(turn) + np.sin(turn))
    count = shaped.shape[1]
    relative = math.sqrt(2.0 / count * (1.0 + 2.0 * (rho**2).sum()))
    for axis in shaped:
        assert np.var(axis) == pytest.approx(expected, rel=5.0 * relative)
        found = np.mean(axis[1:] * axis[:-1]) / np.var(axis)
        assert found == pytest.approx(rho[0], abs=5.0 / math.sqrt(count))


@pytest.mark.parametrize("bandwidth_hz", [0.0, 500.0])
def test_the_spectrum_is_the_sheet_s_density_with_what_sampling_folds_back(
    bandwidth_hz: float, white: Array, shaped: Array
) -> None:
    noise = shaped if bandwidth_hz else white
    segment = 1024
    frequency_hz, found = welch(noise[0], RATE_HZ, window="hann", nperseg=segment)
    folded = np.ones_like(frequency_hz)
    if bandwidth_hz:
        images = np.concatenate(
            [[frequency_hz + k * RATE_HZ, (k + 1) * RATE_HZ - frequency_hz] for k in range(50)]
        )
        folded = (1.0 / (1.0 + (images / bandwidth_hz) ** 4)).sum(axis=0)
    bands = [(0.05, 0.2), (0.2, 0.4), (0.4, 0.7), (0.7, 0.95)]
    for low, high in bands:
        band = (frequency_hz > low * RATE_HZ / 2) & (frequency_hz < high * RATE_HZ / 2)
        ratio = np.mean(found[band] / (DENSITY**2 * folded[band]))
        # Half-overlapping Hann segments are worth 0.95 of their number K = 2 n/segment as independent ones, each
        # of its lines is off by 100 %, and neighbouring lines are correlated over 1.5 (the window's bandwidth).
        independent = 0.5 * 0.95 * (2.0 * noise.shape[1] / segment) * band.sum() / 1.5
        assert ratio == pytest.approx(1.0, abs=5.0 / math.sqrt(independent))


def allan_variance(values: Array, length: int) -> float:
    """Return the Allan variance of neighbouring means over a number of samples."""
    means = values[: len(values) // length * length].reshape(-1, length).mean(axis=1)
    return float(0.5 * np.mean(np.diff(means) ** 2))


@pytest.mark.parametrize("length", [16, 128, 1024])
def test_the_allan_deviation_of_white_noise_falls_with_the_root_of_time(
    length: int, white: Array
) -> None:
    # σ²(τ) = N²/(2 τ) for the one-sided density N. Of m means the estimate is off by √(3/m).
    expected = DENSITY**2 / (2.0 * length / RATE_HZ)
    means = white.shape[1] // length
    found = allan_variance(white[1], length)
    assert found == pytest.approx(expected, rel=5.0 * math.sqrt(3.0 / means))


def test_the_drift_is_a_gauss_markov_process() -> None:
    deviation, time_s, period_s, count = 0.3, 0.5, 1.0 / 128.0, 400_000
    drift = GaussMarkov(deviation, time_s, np.random.default_rng(2))
    values = drift.advance(count, period_s)
    # Independent numbers in a process of correlation time τ: n T/(2 τ) for means, n T/τ for squares.
    independent = count * period_s / time_s
    assert abs(values.mean()) < 5.0 * deviation * math.sqrt(2.0 / independent)
    assert np.var(values) == pytest.approx(deviation**2, rel=5.0 * math.sqrt(2.0 / independent))
    for steps in (16, 64, 128):
        rho = math.exp(-steps * period_s / time_s)
        found = np.mean(values[steps:] * values[:-steps]) / np.var(values)
        assert found == pytest.approx(rho, abs=5.0 * math.sqrt(2.0 / independent))
    # Allan variance (IEEE Std 952, annex C): 2 σ² τ/t (1 − τ/(2 t) (3 − 4 e^(−t/τ) + e^(−2 t/τ))).
    for length in (16, 64, 256):
        x = length * period_s / time_s
        expected = (
            2.0
            * deviation**2
            / x
            * (1.0 - (3.0 - 4.0 * math.exp(-x) + math.exp(-2.0 * x)) / (2.0 * x))
        )
        bound = 5.0 * math.sqrt(3.0 / (count / length))
        assert allan_variance(values, length) == pytest.approx(expected, rel=bound)


def test_the_drift_does_not_depend_on_the_sample_period() -> None:
    # One step over 2 T has the factor and the added variance of two steps over T.
    for period_s in (1e-4, 1e-2):
        one, two = math.exp(-period_s / 0.3), math.exp(-2.0 * period_s / 0.3)
        assert two == pytest.approx(one**2)
        twice = (1.0 - one**2) * one**2 + (1.0 - one**2)
        assert 1.0 - two**2 == pytest.approx(twice)
    changing = GaussMarkov(1.0, 0.2, np.random.default_rng(4))
    periods_s = np.tile([1e-3, 5e-3, 2e-3], 3000)
    values = np.concatenate([changing.advance(10, float(period)) for period in periods_s])
    independent = 10.0 * periods_s.sum() / 0.2
    assert np.var(values) == pytest.approx(1.0, rel=5.0 * math.sqrt(2.0 / independent))


def test_one_error_changes_the_numbers_of_no_other() -> None:
    quiet = noise_of(revolutions=4, noise_density=DENSITY)
    drifting = noise_of(revolutions=4, noise_density=DENSITY, drift_m_s2=0.5, drift_time_s=1e6)
    off = drifting - quiet
    # A drift of a million seconds stands still: what is left is one constant, the noise is the same.
    assert np.ptp(off, axis=1) == pytest.approx([0.0, 0.0], abs=2e-3)
    assert np.all(np.abs(off).mean(axis=1) > 1e-3)
    assert not np.array_equal(quiet, noise_of(seed=12, revolutions=4, noise_density=DENSITY))
