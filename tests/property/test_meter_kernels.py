# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The meters' compiled loops against the same definitions written for whole arrays."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.meters import lundberg
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.e_vib import HIGH, LOW, vibration_modulus
from roller_sim_ros.meters.flight import COARSE, FINE, GRAVITY_SHARE, FlightTest, lifts
from roller_sim_ros.parameters import GRAVITY_M_S2

N = 128
SEEDS = st.integers(0, 2**32 - 1)
LOAD, RADIUS, WIDTH = 54936.0, 0.75, 2.1


def _motion(seed: int, revolutions: int, orders: int = 12) -> np.ndarray:
    """Some harmonics and subharmonics, m/s², clipped from below now and then as in flight."""
    random = np.random.default_rng(seed)
    phase = 2.0 * np.pi * np.arange(revolutions * N) / N
    motion = 30.0 * np.sin(phase + random.uniform(0.0, 2.0 * np.pi))
    for order in range(1, orders):
        size = random.uniform(0.0, 20.0) / order
        motion += size * np.sin(0.5 * order * phase + random.uniform(0.0, 2.0 * np.pi))
    return motion


def _modulus(force: np.ndarray, height: np.ndarray) -> float:
    """E_vib of one motion, span by span."""
    found = []
    summit = (force >= np.roll(force, 1)) & (force >= np.roll(force, -1))
    for start in range(0, len(force), 2 * N):
        peak = start + int(np.where(summit, force, -np.inf)[start : start + 2 * N].argmax())
        rows = (peak + np.arange(-N, 1)) % len(force)
        rising, depth = force[rows], -height[rows]
        lowest, top = rising.min(), rising[-1]
        below = np.flatnonzero(rising < lowest + LOW * (top - lowest))
        first = below[-1] + 1 if len(below) else 0
        above = np.flatnonzero(rising[first:] > lowest + HIGH * (top - lowest))
        branch = slice(first, first + above[0])
        if top <= LOAD or above[0] < 2:
            continue
        x, y = rising[branch], depth[branch]
        logarithm = x * np.log(np.where(x > 0.0, x, 1.0))
        slope, log_slope = (np.polyfit(x - x.mean(), values, 1)[0] for values in (y, logarithm))
        found.append(float(lundberg.modulus(slope, log_slope, RADIUS, WIDTH, 0.25)))
    known = [value for value in found if math.isfinite(value)]
    return sum(known) / len(known) if known else math.nan


@settings(max_examples=60, deadline=None)
@given(seed=SEEDS)
def test_e_vib_is_that_of_the_branches(seed: int) -> None:
    drum = Drum(mass_kg=3200.0, static_load_n=LOAD, radius_m=RADIUS, width_m=WIDTH)
    motion = DrumMotion(_motion(seed, 4), drum, amplitude_m=1.6e-3, frequency_hz=28.0)
    force, height = np.maximum(motion.soil_force, 0.0), motion.height
    found = float(vibration_modulus(force, height, LOAD, RADIUS, WIDTH))
    assert found == pytest.approx(_modulus(force, height), rel=1e-6, nan_ok=True)


def _fall(motion: np.ndarray, test: FlightTest) -> np.ndarray:
    step = round(test.step * N)
    cosine = math.cos(2.0 * math.pi * test.step)
    around = np.roll(motion, step) + np.roll(motion, -step)
    return (around - 2.0 * cosine * motion) / (2.0 * (1.0 - cosine))


def _has_level(fall: np.ndarray, test: FlightTest) -> bool:
    length = round(test.length * N)
    rows = (np.arange(len(fall))[:, np.newaxis] + np.arange(length)) % len(fall)
    highest, lowest = fall[rows].max(axis=1), fall[rows].min(axis=1)
    level = highest - lowest <= -test.tolerance * highest
    return bool((level & (highest <= -GRAVITY_SHARE * GRAVITY_M_S2)).any())


@settings(max_examples=150, deadline=None)
@given(seed=SEEDS, flight=st.integers(0, 60), noise=st.sampled_from([0.0, 1e-4, 1e-2]))
def test_flights_are_found_as_defined(seed: int, flight: int, noise: float) -> None:
    random = np.random.default_rng(seed)
    phase = 2.0 * np.pi * np.arange(N) / N
    one = _motion(seed, 1)
    one[:flight] = 25.0 * np.sin(phase[:flight]) - random.uniform(9.0, 30.0)
    repetitions = np.tile(one, (4, 1)) + noise * random.standard_normal((4, N))
    motion = repetitions.mean(axis=0)
    motion -= motion.mean()
    coarse, fine = _fall(motion, COARSE), _fall(motion, FINE)
    change = np.abs(_fall(repetitions[-1] - repetitions[-2], FINE)).max()
    expected: bool | None = None
    if coarse.min() > -GRAVITY_SHARE * GRAVITY_M_S2:
        expected = False
    elif _has_level(coarse, COARSE) or _has_level(fine, FINE):
        expected = True
    elif change < FINE.tolerance * GRAVITY_M_S2:
        expected = False
    assert lifts(repetitions, N) is expected


@settings(max_examples=30, deadline=None)
@given(seed=SEEDS, first=st.floats(0.0, 6.28))
def test_force_and_fundamental_are_those_of_the_equation_of_motion(seed: int, first: float) -> None:
    vertical = np.stack([_motion(seed, 4), _motion(seed + 1, 4)])
    mass, load = np.array([3200.0, 7000.0]), np.array([LOAD, 2.0 * LOAD])
    drum = Drum(mass_kg=mass, static_load_n=load, radius_m=RADIUS, width_m=WIDTH)
    motion = DrumMotion(vertical, drum, 1.6e-3, 28.0, phase_rad=first)
    phase = first + 2.0 * np.pi * np.arange(4 * N) / N
    force = mass * 1.6e-3 * (2.0 * np.pi * 28.0) ** 2
    inertia = mass[:, np.newaxis] * (vertical - vertical.mean(axis=1, keepdims=True))
    expected = inertia + load[:, np.newaxis] - force[:, np.newaxis] * np.sin(phase)
    assert motion.soil_force == pytest.approx(expected, abs=1e-6)
    turned = (vertical * np.exp(-1j * phase)).mean(axis=1)
    assert motion.fundamental == pytest.approx(2.0 * turned, abs=1e-10)
