# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Order amplitudes: exact, without leakage, the same bits from a stream as from a batch."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.meters.harmonics import HarmonicsWindow, order_amplitudes

N = 128


def signal(revolutions: int, parts: dict[float, tuple[float, float]]) -> np.ndarray:
    """Σ A sin(q φ + θ) of {q: (A, θ)}."""
    phase = 2.0 * np.pi * np.arange(revolutions * N) / N
    total = np.zeros(len(phase))
    for order, (amplitude, angle) in parts.items():
        total += amplitude * np.sin(order * phase + angle)
    return total


def test_each_order_gives_its_own_amplitude_and_phase_and_nothing_of_the_others() -> None:
    parts = {
        0.5: (7.0, 0.3),
        1.0: (50.0, -0.4),
        1.5: (20.0, 1.0),
        2.0: (11.0, 2.0),
        2.5: (9.0, 0.1),
    }
    found = order_amplitudes(signal(16, parts) + 9.81, orders=(0.5, 1.0, 2.0, 3.0))
    for order in (0.5, 1.0, 2.0):
        assert found.amplitude(order) == pytest.approx(parts[order][0], abs=1e-12)
        assert found.phase(order) == pytest.approx(parts[order][1], abs=1e-12)
    assert found.amplitude(3.0) < 1e-12


@pytest.mark.parametrize("revolutions", [2, 16, 64])
def test_amplitudes_are_the_bins_of_the_fft(revolutions: int) -> None:
    samples = np.random.default_rng(1).normal(size=revolutions * N)
    bins = 2.0 * np.fft.rfft(samples) / len(samples)
    found = order_amplitudes(samples, orders=(0.5, 1.0, 1.5, 2.0, 63.5))
    for order, amplitude in zip(found.orders, found.amplitudes, strict=True):
        assert amplitude == pytest.approx(bins[round(order * revolutions)], abs=1e-13)


def test_quarter_orders_need_a_multiple_of_four_revolutions() -> None:
    found = order_amplitudes(signal(8, {0.25: (3.0, 0.0), 1.0: (10.0, 0.0)}), orders=(0.25, 1.0))
    assert found.amplitude(0.25) == pytest.approx(3.0, abs=1e-12)
    with pytest.raises(ValueError, match="whole number of cycles"):
        HarmonicsWindow(6, orders=(0.25,))


@pytest.mark.parametrize("order", [0.0, -1.0, 64.0, 65.0])
def test_orders_without_meaning_are_refused(order: float) -> None:
    with pytest.raises(ValueError, match="must lie above 0 and below 64"):
        HarmonicsWindow(16, orders=(order,))


def test_odd_windows_have_no_half_order() -> None:
    with pytest.raises(ValueError, match=r"order 0\.5"):
        HarmonicsWindow(15)


def test_window_that_is_not_full_is_unknown_also_after_clear() -> None:
    window = HarmonicsWindow(4)
    revolution = signal(1, {1.0: (1.0, 0.0)})
    for index in range(3):
        window.push(revolution, index)
        assert math.isnan(window.harmonics().amplitude(1.0))
    window.push(revolution, 3)
    assert window.harmonics().amplitude(1.0) == pytest.approx(1.0)
    window.clear()
    assert not window.full
    assert math.isnan(window.harmonics().amplitude(1.0))


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    window=st.sampled_from([2, 4, 16, 30]),
    start=st.integers(0, 10**9),
)
def test_stream_equals_batch_bit_for_bit_wherever_it_begins(
    seed: int, window: int, start: int
) -> None:
    start *= 2
    samples = np.random.default_rng(seed).normal(size=(window + 5) * N) * 50.0
    stream = HarmonicsWindow(window)
    for index in range(window + 5):
        stream.push(samples[index * N : (index + 1) * N], start + index)
        if index + 1 < window:
            continue
        first = index + 1 - window
        batch = order_amplitudes(samples[first * N : (index + 1) * N])
        found = stream.harmonics()
        for order in found.orders:
            assert found.amplitude(order) == batch.amplitude(order)
        if first % 2 == 0:
            assert found.phase(0.5) == batch.phase(0.5)
        assert found.phase(1.0) == batch.phase(1.0)


def test_phase_at_the_start_of_the_revolutions_is_taken_into_account() -> None:
    parts = {0.5: (7.0, 0.3), 1.0: (50.0, -0.4), 2.0: (11.0, 2.0)}
    shift = 37
    samples = signal(17, parts)[shift : shift + 16 * N]
    window = HarmonicsWindow(16)
    for index in range(16):
        window.push(samples[index * N : (index + 1) * N], index, 2.0 * np.pi * shift / N)
    found = window.harmonics()
    for order, (amplitude, angle) in parts.items():
        assert found.amplitude(order) == pytest.approx(amplitude, abs=1e-12)
        assert found.phase(order) == pytest.approx(angle, abs=1e-12)
