# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Samples of any spacing on revolutions, pulses as a phase, windows that slide."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.estimate import EstimateError, Status, estimate
from roller_sim_ros.estimate.pulses import PulsePhase
from roller_sim_ros.estimate.sliding import SlidingWindow, Window, estimate_turns
from roller_sim_ros.estimate.turns import Turn, TurnCollector
from roller_sim_ros.parameters import Configuration

Array = NDArray[np.float64]
N = 128
HZ = 28.0


def wave(turns: Array) -> Array:
    return np.asarray(np.sin(2 * np.pi * turns) + 0.3 * np.cos(2 * np.pi * 7.0 * turns))


def collected(
    times: Array, phase_turns: Array, size: int, collector: TurnCollector | None = None
) -> list[Turn]:
    """Turns of the wave at some times, fed in blocks, their phases told modulo 1."""
    collector = collector or TurnCollector(N)
    found: list[Turn] = []
    for first in range(0, len(times), size):
        block = slice(first, first + size)
        turns = phase_turns[block] - math.floor(phase_turns[first])
        found += collector.feed(
            times[block], turns, wave(phase_turns[block]), excitation_hz=HZ, amplitude_m=1e-3
        )
    return found


@pytest.mark.parametrize("size", [1, 16, 100, 128, 1000])
def test_samples_on_the_grid_are_taken_as_they_are(size: int) -> None:
    turns = np.arange(5 * N) / N
    found = collected(turns / HZ, turns, size)
    assert len(found) == 5
    for number, turn in enumerate(found):
        np.testing.assert_array_equal(turn.vertical, wave(turns)[number * N : (number + 1) * N])
        assert turn.time_s == pytest.approx(number / HZ)
        assert turn.follows is (number > 0)


@pytest.mark.parametrize("per_turn", [103.7, 178.57, 317.3])
def test_samples_beside_the_grid_are_interpolated(per_turn: float) -> None:
    turns = 0.37 + np.arange(int(6 * per_turn)) / per_turn
    found = collected(turns / HZ, turns, 50)
    assert len(found) == 5
    for number, turn in enumerate(found):
        np.testing.assert_allclose(turn.vertical, wave(np.arange(N) / N), atol=5e-3)
        assert turn.time_s == pytest.approx((1 + number) / HZ, abs=1e-5)


def test_a_jump_of_the_phase_and_an_interruption_begin_anew() -> None:
    collector = TurnCollector(N)
    turns = np.arange(2 * N) / N
    assert len(collected(turns / HZ, turns, 16, collector)) == 2
    jumped = collected((turns + 5.0) / HZ, turns + 5.3, 16, collector)
    assert [turn.follows for turn in jumped] == [False]
    collector.interrupt()
    assert not collected(turns[:64] / HZ, turns[:64], 16, collector)


def test_frequency_is_found_from_the_times() -> None:
    turns = np.arange(4 * N) / N
    found = list(
        TurnCollector(N).feed(
            turns / 31.0, turns, wave(turns), excitation_hz=math.nan, amplitude_m=math.nan
        )
    )
    assert [turn.excitation_hz for turn in found] == pytest.approx([31.0] * 4, rel=1e-9)


def test_a_missing_pulse_is_counted() -> None:
    numbers = np.array([0, 1, 2, 3, 5, 6, 7])
    phase = PulsePhase(list(numbers / HZ), [0.5 * math.pi] * 7)
    times = np.linspace(0.01, 0.24, 50)
    np.testing.assert_allclose(phase.turns(times), times * HZ + 0.25, atol=1e-9)


def test_where_no_pulses_are_nothing_is_known() -> None:
    phase = PulsePhase([1.0, 1.03, 1.06, 5.0, 5.03], [0.0] * 5)
    known = np.isfinite(phase.turns(np.array([0.9, 1.01, 1.05, 3.0, 5.01, 6.0])))
    assert known.tolist() == [False, True, True, False, True, False]
    assert np.isnan(PulsePhase([], []).turns(np.array([1.0]))).all()


def turn(number: int, *, follows: bool = True, hz: float = HZ, amplitude: float = 1e-3) -> Turn:
    return Turn(number / HZ, hz, amplitude, wave(np.arange(N) / N), follows)


def test_windows_slide_and_begin_anew_after_a_gap() -> None:
    sliding = SlidingWindow(8, 4)
    found: list[Window] = []
    for number in range(40):
        found += sliding.push(turn(number, follows=number not in (0, 18, 21)))
    found += sliding.finish()
    starts = [round(item.turns[0].time_s * HZ) for item in found]
    assert starts == [0, 4, 8, 18, 21, 25, 29]
    assert [len(item.turns) for item in found] == [8, 8, 8, 3, 8, 8, 8]
    assert [item.whole for item in found] == [True, True, True, False, True, True, True]


@pytest.mark.parametrize("changed", ["hz", "amplitude"])
def test_a_changing_exciter_is_not_estimated(changed: str) -> None:
    values = {"hz": HZ * 1.01} if changed == "hz" else {"amplitude": 1.02e-3}
    turns = (*(turn(number) for number in range(8)), turn(8, **values))
    found, _ = estimate_turns(Window(turns, whole=True), Configuration())
    assert found.status is Status.CHANGING
    assert math.isnan(found.shear_modulus_pa)


@pytest.mark.parametrize(
    ("vertical", "options", "says"),
    [
        (np.zeros((16, 128)), {}, "shape"),
        (np.zeros(0), {}, "shape"),
        (np.zeros(100), {"phase_rad": np.zeros(100)}, "must rise"),
        (np.zeros(100), {"phase_rad": np.arange(99.0)}, "as long as"),
        (np.zeros(100), {"window_revolutions": 3}, "at least 4"),
        (np.zeros(100), {"step_revolutions": 17}, "1 to 16"),
        (np.zeros(100), {"step_revolutions": 0}, "1 to 16"),
    ],
)
def test_arrays_that_are_of_no_use(vertical: Array, options: dict[str, object], says: str) -> None:
    with pytest.raises(EstimateError, match=says):
        estimate(vertical, Configuration(), **options)  # type: ignore[arg-type]


def test_too_few_samples_say_so() -> None:
    (found,) = estimate(np.zeros(100), Configuration())
    assert found.status is Status.TOO_FEW
