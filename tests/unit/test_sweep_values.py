# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Values of a sweep from motions that are known, and the watch over what repeats."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.meters.summary import summarise
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session.block import AIR, LOADING
from roller_sim_ros.sweep.motion import UNKNOWN, Motion
from roller_sim_ros.sweep.repetition import (
    REPETITIONS,
    TOLERANCE,
    WATCH_ROWS,
    begin_watch,
    repeats,
)
from roller_sim_ros.sweep.values import VALUES

SAMPLES = 128
LOAD = Configuration().machine.static_load_n
BY_NAME = {value.name: value for value in VALUES}


def motion(
    force: NDArray[np.float64], vertical: NDArray[np.float64], *, synchronous: bool = True
) -> Motion:
    """Return one point's motion, shapes (revolutions, SAMPLES); in the air where there is no force."""
    return Motion(
        configurations=[Configuration()],
        synchronous=np.array([synchronous]),
        vertical=vertical[np.newaxis],
        soil_force=force[np.newaxis],
        drum_depth=np.zeros_like(force)[np.newaxis],
        contact_state=np.where(force > 0.0, LOADING, AIR)[np.newaxis],
    )


def blows(*peaks: float) -> NDArray[np.float64]:
    """Return the force of revolutions with a blow of each height around their middle, N."""
    force = np.zeros((len(peaks), SAMPLES))
    rise = np.sin(np.linspace(0.0, np.pi, 41))[1:-1]
    for row, peak in zip(force, peaks, strict=True):
        row[40:79] = peak * LOAD * rise
    return force


def waves(*amplitudes: float) -> NDArray[np.float64]:
    """Return revolutions of one cycle each, m/s²."""
    cycle = np.sin(2.0 * np.pi * np.arange(SAMPLES) / SAMPLES)
    return np.array([amplitude * cycle for amplitude in amplitudes])


def value(name: str, of: Motion) -> float:
    return float(BY_NAME[name].of(of)[0])


def test_the_mean_over_blows_takes_each_blow_of_a_period_once() -> None:
    heights = (2.0, 3.0, 2.0, 3.0)
    of = motion(blows(*heights), waves(*heights))
    assert value("period", of) == 2
    assert value("blows_per_period", of) == 2
    assert value("force_ratio_max", of) == pytest.approx(3.0)
    assert value("force_ratio_mean", of) == pytest.approx(2.5)


def test_a_blow_that_goes_over_the_end_of_the_window_is_one() -> None:
    heights = (2.0, 3.0, 2.0, 3.0)
    force = np.roll(blows(*heights).reshape(-1), 60).reshape(4, SAMPLES)
    of = motion(force, waves(*heights))
    assert value("force_ratio_mean", of) == pytest.approx(2.5)


def test_double_jump_has_one_blow_in_two_revolutions() -> None:
    heights = (5.0, 0.0, 5.0, 0.0)
    of = motion(blows(*heights), waves(4.0, 1.0, 4.0, 1.0))
    assert value("blows_per_period", of) == 1
    assert value("force_ratio_mean", of) == pytest.approx(5.0)


def test_without_a_period_only_whole_blows_count() -> None:
    heights = np.random.default_rng(1).uniform(2.0, 4.0, 16)
    force = np.roll(blows(*heights).reshape(-1), 60).reshape(16, SAMPLES)
    of = motion(force, waves(*heights))
    assert value("period", of) == 0
    # The first and the last blow are cut off by the ends of the window.
    landings = np.flatnonzero((force.reshape(-1)[:-1] == 0.0) & (force.reshape(-1)[1:] > 0.0))
    whole = heights[: len(landings) - 1]
    assert value("force_ratio_mean", of) == pytest.approx(whole.mean())


def test_without_flights_a_revolution_is_a_blow() -> None:
    force = LOAD * (1.0 + 0.5 * waves(1.0, 1.0))
    of = motion(force, waves(1.0, 1.0))
    assert value("force_ratio_mean", of) == pytest.approx(1.5)
    assert value("air_fraction", of) == 0.0


def test_all_values_are_those_of_a_summary() -> None:
    draw = np.random.default_rng(2)
    vertical = draw.normal(0.0, 10.0, (64, SAMPLES))
    force = np.maximum(draw.normal(1.0, 2.0, (64, SAMPLES)), 0.0) * LOAD
    of = motion(force, vertical)
    state = np.where(force > 0.0, LOADING, AIR).astype(np.uint8).reshape(-1)
    summary = summarise(vertical.reshape(-1), force.reshape(-1), state, LOAD)
    for name in (
        *("force_ratio_max", "cmv", "rmv", "acceleration_max_g", "acceleration_min_g"),
        *("air_fraction", "period", "blows_per_period", "mode"),
    ):
        assert value(name, of) == pytest.approx(float(getattr(summary, name)), rel=1e-12), name


def test_what_is_unknown_is_never_a_number() -> None:
    of = motion(blows(2.0, 2.0), waves(1.0, 1.0), synchronous=False)
    for name in ("period", "blows_per_period"):
        assert value(name, of) == UNKNOWN
    for name in ("cmv", "rmv", "omega", "e_vib", "k_s"):
        assert math.isnan(value(name, of)), name
    standing = motion(np.full((2, SAMPLES), LOAD), np.zeros((2, SAMPLES)))
    assert math.isnan(value("cmv", standing))
    short = motion(blows(2.0, 3.0), waves(2.0, 3.0))
    assert value("period", short) == UNKNOWN


def test_every_value_has_a_unit_and_says_what_it_is() -> None:
    assert len(BY_NAME) == len(VALUES)
    for item in VALUES:
        assert item.unit
        assert item.doc
    assert BY_NAME["mode"].labels[3] == "double jump"


def states(period: int, count: int, change: float, sinking: float) -> NDArray[np.float64]:
    """Return states that repeat after a period but for a change, of a drum that sinks evenly."""
    orbit = np.random.default_rng(3).uniform(0.5, 1.0, (period, at.STATE_SIZE))
    orbit[:, at.PHASE] = at.UNLOADING
    rows = orbit[np.arange(count) % period]
    rows[:, at.VELOCITY] += change * np.arange(count)
    rows[:, at.DATUM] = sinking * np.arange(count)
    rows[:, at.DEPTH] += rows[:, at.DATUM]
    return rows


def found_at(rows: NDArray[np.float64]) -> tuple[int, int]:
    """Return after how many ends of revolutions a period is found, and which."""
    watch = np.zeros((WATCH_ROWS, at.STATE_SIZE))
    begin_watch(np.ones(at.STATE_SIZE), watch)
    for seen, row in enumerate(rows, start=1):
        period = repeats(row, watch)
        if period:
            return seen, period
    return 0, 0


@pytest.mark.parametrize("period", [1, 2, 4, 8])
def test_a_state_that_repeats_over_eight_periods_is_noticed(period: int) -> None:
    seen, found = found_at(states(period, 100, 0.0, 0.125))
    assert (seen, found) == (period + REPETITIONS * period, period)


def test_what_still_changes_does_not_repeat() -> None:
    assert found_at(states(1, 100, 2.0 * TOLERANCE, 0.0)) == (0, 0)
    assert found_at(states(3, 100, 0.0, 0.0)) == (0, 0)
    rows = states(1, 100, 0.0, 0.0)
    rows[::5, at.PHASE] = at.AIR
    assert found_at(rows) == (0, 0)
    rows = states(1, 100, 0.0, 0.0)
    rows[:, at.DEPTH] += 0.125 * np.arange(100)
    assert found_at(rows) == (0, 0)
