# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""E_vib against loading branches made by Lundberg's relation itself."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.meters import lundberg
from roller_sim_ros.meters.e_vib import vibration_modulus

N = 128
LOAD, RADIUS, WIDTH = 54936.0, 0.75, 2.1
NU = 0.25


def blow(
    modulus: float,
    peak: float = 160e3,
    rise: int = 25,
    fall: int = 40,
    period: int = 1,
    lowest: float = 0.0,
    shift: int = 30,
) -> tuple[np.ndarray, np.ndarray]:
    """Force and height over `period` revolutions: a branch by Lundberg up, a stiffer one down, then flight."""
    samples = period * N
    force = np.full(samples, lowest)
    up = lowest + (peak - lowest) * np.sin(0.5 * np.pi * np.arange(1, rise + 1) / rise) ** 2
    down = lowest + (peak - lowest) * np.cos(0.5 * np.pi * np.arange(1, fall + 1) / fall) ** 2
    force[:rise], force[rise : rise + fall] = up, down
    depth = np.full(samples, np.nan)
    depth[:rise] = lundberg.approach(up, modulus, RADIUS, WIDTH, NU)
    bottom = depth[rise - 1]
    depth[rise : rise + fall] = bottom - 0.3 * (bottom - depth[0]) * (1.0 - down / peak)
    rest = samples - rise - fall
    depth[rise + fall :] = -2e-3 * np.sin(np.pi * np.arange(rest) / max(1, rest - 1))
    return np.roll(force, shift), np.roll(-depth, shift)


def found(force: np.ndarray, height: np.ndarray, revolutions: int = 4) -> float:
    times = revolutions * N // len(force)
    return float(
        vibration_modulus(np.tile(force, times), np.tile(height, times), LOAD, RADIUS, WIDTH)
    )


@pytest.mark.parametrize("modulus", [5e6, 30e6, 100e6, 400e6])
@pytest.mark.parametrize("peak", [80e3, 350e3])
@pytest.mark.parametrize("period", [1, 2, 4])
def test_lundbergs_relation_is_inverted_exactly(modulus: float, peak: float, period: int) -> None:
    assert found(*blow(modulus, peak, period=period)) == pytest.approx(modulus, rel=1e-9)


def outside_the_part_taken(force: np.ndarray, rise: int) -> np.ndarray:
    """Which samples of a blow that begins at the first sample rise, but below 40 or above 90 % of its peak."""
    share = force / force.max()
    return (np.arange(len(force)) < rise) & ((share < 0.4) | (share > 0.9))


@pytest.mark.parametrize("shift", [0, 60, 90, 100, 104, 107, 110, 113, 116, 120, 127])
@pytest.mark.parametrize("period", [1, 2, 4])
def test_it_does_not_matter_where_the_window_begins(shift: int, period: int) -> None:
    # With these shifts the window begins within the blow, even within its rise, whose other parts are bent.
    force, height = blow(60e6, shift=0, period=period)
    height[outside_the_part_taken(force, 25)] += 1e-4
    moved = np.roll(force, shift * period), np.roll(height, shift * period)
    assert found(*moved) == pytest.approx(60e6, rel=1e-9)


def test_continuous_contact_takes_the_branch_from_its_lowest_force() -> None:
    force, height = blow(60e6, peak=70e3, lowest=40e3, rise=60, fall=N - 60)
    assert force.min() > 0.4 * force.max()
    assert found(force, height) == pytest.approx(60e6, rel=1e-9)


def test_only_the_part_from_40_to_90_percent_counts() -> None:
    force, height = blow(60e6, shift=0, rise=50)
    share = force / force.max()
    outside = outside_the_part_taken(force, 50)
    inside = (np.arange(N) < 50) & (share > 0.5) & (share < 0.6)
    bent = height.copy()
    bent[outside] += 1e-4
    assert found(force, bent) == pytest.approx(60e6, rel=1e-9)
    bent = height.copy()
    bent[inside] += 1e-4
    assert found(force, bent) != pytest.approx(60e6, rel=1e-2)


def test_two_blows_of_different_strength_give_the_greater_ones() -> None:
    strong, weak = blow(80e6, peak=250e3), blow(20e6, peak=150e3)
    both = tuple(np.concatenate([one, other]) for one, other in zip(strong, weak, strict=True))
    assert found(*both) == pytest.approx(80e6, rel=1e-9)


def test_value_is_the_mean_of_those_that_there_are() -> None:
    first, second = blow(80e6, period=2), blow(40e6, period=2)
    none = np.zeros(2 * N), np.zeros(2 * N)
    window = [np.concatenate(parts) for parts in zip(first, second, none, none, strict=True)]
    assert found(window[0], window[1], 8) == pytest.approx(60e6, rel=1e-9)


def test_without_a_blow_or_a_slope_there_is_no_value() -> None:
    force, height = blow(60e6)
    assert math.isnan(found(0.3 * force, height))
    assert math.isnan(found(force, -height))
    assert math.isnan(found(force, np.zeros(N)))
    assert math.isnan(found(np.full(N, 2.0 * LOAD), height))
    # One sample from nothing to everything: the branch has no points.
    assert math.isnan(found(*blow(60e6, rise=1)))


def test_several_motions_with_machines_of_their_own() -> None:
    force, height = (np.tile(values, 2) for values in blow(60e6))
    wide = vibration_modulus(
        np.stack([force, force]),
        np.stack([height, height]),
        np.full(2, LOAD),
        np.array([0.75, 0.5]),
        np.array([2.1, 1.0]),
    )
    assert wide[0] == pytest.approx(60e6, rel=1e-9)
    assert wide[1] == vibration_modulus(force, height, LOAD, 0.5, 1.0)
    assert wide[1] > 1.5 * wide[0]


def test_lundberg_by_hand() -> None:
    # E 50 MPa, F/L 50 kN/m: b² = (16/π) 0.75 · 0.9375/50e6 · 50e3.
    width = math.sqrt(16.0 / math.pi * 0.75 * 0.9375 / 50e6 * 50e3)
    assert width == pytest.approx(0.0598, abs=1e-4)
    expected = 0.9375 / 50e6 * 50e3 * 2.0 / math.pi * (1.8864 + math.log(2.1 / width))
    assert lundberg.approach(105e3, 50e6, 0.75, 2.1, 0.25) == pytest.approx(expected, rel=1e-12)
    assert expected == pytest.approx(3.25e-3, abs=0.05e-3)


def test_slope_of_lundberg_at_a_force_gives_the_modulus_back() -> None:
    for modulus in (3e6, 40e6, 900e6):
        force = np.array([99.99e3, 100.01e3])
        depth = lundberg.approach(force, modulus, RADIUS, WIDTH, NU)
        slope = np.diff(depth) / np.diff(force)
        logarithm = np.diff(force * np.log(force)) / np.diff(force)
        assert lundberg.modulus(slope, logarithm, RADIUS, WIDTH, NU) == pytest.approx(modulus)
    assert np.isnan(lundberg.modulus(-1e-8, 12.5, RADIUS, WIDTH, NU))
    assert np.isnan(lundberg.modulus(0.0, 12.5, RADIUS, WIDTH, NU))
    # So soft that the contact would be wider than the drum is long.
    assert np.isnan(lundberg.modulus(1e-4, 12.5, RADIUS, WIDTH, NU))
