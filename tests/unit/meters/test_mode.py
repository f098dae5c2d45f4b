# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Modes: from the contact states, and as far as an acceleration alone tells them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.meters.flight import lifts
from roller_sim_ros.meters.mode import Mode, metered_mode, true_mode

N = 128


def test_values_are_those_of_the_messages() -> None:
    assert [(mode.name, int(mode)) for mode in Mode] == [
        ("UNKNOWN", 0),
        ("CONTINUOUS_CONTACT", 1),
        ("PARTIAL_UPLIFT", 2),
        ("DOUBLE_JUMP", 3),
        ("QUAD_JUMP", 4),
        ("CHAOTIC", 5),
    ]
    assert Mode.DOUBLE_JUMP.label == "double jump"


@pytest.mark.parametrize(
    ("period", "in_the_air", "on_the_ground"),
    [
        (1, Mode.PARTIAL_UPLIFT, Mode.CONTINUOUS_CONTACT),
        (2, Mode.DOUBLE_JUMP, Mode.CONTINUOUS_CONTACT),
        (4, Mode.QUAD_JUMP, Mode.CONTINUOUS_CONTACT),
        (8, Mode.CHAOTIC, Mode.CONTINUOUS_CONTACT),
        (0, Mode.CHAOTIC, Mode.CONTINUOUS_CONTACT),
    ],
)
def test_labels(period: int, in_the_air: Mode, on_the_ground: Mode) -> None:
    assert true_mode(0.3, period) is in_the_air
    assert true_mode(0.0, period) is on_the_ground
    assert metered_mode(True, period) is in_the_air
    assert metered_mode(False, period) is on_the_ground


def test_unknown_stays_unknown() -> None:
    assert true_mode(math.nan, 1) is Mode.UNKNOWN
    assert true_mode(0.3, None) is Mode.UNKNOWN
    assert metered_mode(True, None) is Mode.UNKNOWN
    assert metered_mode(None, 1) is Mode.UNKNOWN
    assert metered_mode(None, 2) is Mode.DOUBLE_JUMP


def repeated(motion: np.ndarray, times: int = 4) -> np.ndarray:
    """Repetitions of a motion as they are published."""
    return np.tile(motion.astype(np.float32).astype(np.float64), (times, 1))


@settings(max_examples=80, deadline=None)
@given(
    air=st.floats(0.09, 0.85),
    exciter=st.floats(5.0, 150.0),
    weight=st.floats(9.81, 40.0),
    period=st.sampled_from([1, 2, 4]),
    gravity=st.sampled_from([0.0, 9.81]),
)
def test_flights_of_a_tenth_of_a_revolution_are_seen_on_any_machine(
    drum: Callable[..., Any], air: float, exciter: float, weight: float, period: int, gravity: float
) -> None:
    motion = drum(period, period, air, exciter, weight).vertical + gravity
    assert lifts(repeated(motion), N) is True


@settings(max_examples=150, deadline=None)
@given(
    exciter=st.floats(1.0, 150.0),
    weight=st.floats(9.81, 40.0),
    harmonics=st.lists(
        st.tuples(st.floats(0.0, 1.0), st.floats(-math.pi, math.pi)), min_size=1, max_size=5
    ),
    least=st.floats(0.02, 0.9),
)
def test_contact_is_never_taken_for_flight(
    exciter: float, weight: float, harmonics: list[tuple[float, float]], least: float
) -> None:
    phase = 2.0 * np.pi * np.arange(N) / N
    ripple = np.zeros(N)
    for order, (amplitude, angle) in enumerate(harmonics, start=1):
        ripple += amplitude * np.sin(order * phase + angle)
    # A soil force that reaches down to `least` of the weight and never leaves the drum.
    force = weight * (1.0 + (1.0 - least) * ripple / max(1e-3, -ripple.min()))
    motion = exciter * np.sin(phase) + force - weight
    assert lifts(repeated(motion), N) is False


def test_noise_makes_contact_unknown_but_not_a_long_flight(drum: Callable[..., Any]) -> None:
    rng = np.random.default_rng(5)
    phase = 2.0 * np.pi * np.arange(N) / N
    contact = 50.0 * np.sin(phase) + 9.0 * np.sin(2.0 * phase)
    noisy = contact + rng.normal(scale=0.02, size=(16, N))
    assert lifts(repeated(contact), N) is False
    assert lifts(noisy, N) is None
    flight = drum(1, 1, 0.45).vertical + rng.normal(scale=0.004, size=(16, N))
    assert lifts(flight, N) is True


def test_weak_vibration_is_contact_however_noisy() -> None:
    # Nowhere does anything fall with g.
    noisy = 2.0 * np.sin(2.0 * np.pi * np.arange(N) / N) + np.zeros((16, 1))
    noisy += np.random.default_rng(6).normal(scale=0.01, size=noisy.shape)
    assert lifts(noisy, N) is False


def test_other_numbers_of_samples_per_revolution(drum: Callable[..., Any]) -> None:
    for count in (64, 256, 512):
        motion = drum(1, 1, 0.5, count=count).vertical
        assert lifts(repeated(motion), count) is True
        phase = 2.0 * np.pi * np.arange(count) / count
        contact = 50.0 * np.sin(phase) + 9.0 * np.sin(2.0 * phase)
        assert lifts(repeated(contact), count) is False
