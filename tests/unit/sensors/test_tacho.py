# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The tacho: a pulse per revolution, at its phase, in any block; not while the eccentric stands."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sensors.tacho import Pulse, Tacho, TachoSheet
from roller_sim_ros.session import Session
from tests.motions import blocks


def pulses(sheet: TachoSheet, revolutions: int = 100, size: int = 128) -> list[Pulse]:
    tacho = Tacho(sheet, 4)
    return [item for block in blocks(revolutions, size=size) for item in tacho.read(block)]


@pytest.mark.parametrize("phase", [0.0, 1.0, 6.28])
@pytest.mark.parametrize("size", [1, 32, 128])
def test_pulses_come_at_their_phase(phase: float, size: int) -> None:
    found = pulses(TachoSheet(phase_rad=phase), 20, size)
    assert [pulse.sequence for pulse in found] == list(range(1, 21))
    expected = [(turn + phase / (2.0 * math.pi)) / 28.0 for turn in range(20)]
    assert [pulse.time_s for pulse in found] == pytest.approx(expected, abs=1e-12)
    assert math.isnan(found[0].interval_s)
    assert [pulse.interval_s for pulse in found[1:]] == pytest.approx([1.0 / 28.0] * 19)


@pytest.mark.parametrize("phase", [0.0, 3.0])
def test_a_run_up_through_the_floor_and_down_again_misses_and_doubles_none(phase: float) -> None:
    session = Session(Configuration().changed({"half_space.model": "two-pole"}), run_up=True)
    tacho = Tacho(TachoSheet(phase_rad=phase))
    turns, expected, found = 0.0, 0, []
    for step in range(220):
        if step == 100:
            session.command_exciter(vibrate=False, frequency_hz=28.0, amplitude_m=1.6e-3)
        block = session.advance(128)
        found += tacho.read(block)
        turns += 128 * block.phase_increment_rad / (2.0 * math.pi)
        expected = math.ceil(turns - phase / (2.0 * math.pi) - 1e-6)
    assert session.exciter_status().frequency_hz == 0.0
    assert abs(len(found) - expected) <= 1
    intervals = np.array([pulse.interval_s for pulse in found[1:]])
    assert intervals.min() > 0.9 / 28.0


def test_jitter_is_of_the_time_alone() -> None:
    found = pulses(TachoSheet(jitter_s=2e-5), 2000)
    off = np.array([pulse.time_s for pulse in found]) - np.arange(2000) / 28.0
    # Five standard deviations of the estimates of 2000 independent numbers.
    assert np.std(off) == pytest.approx(2e-5, rel=5.0 / math.sqrt(2.0 * 2000))
    assert abs(off.mean()) < 5.0 * 2e-5 / math.sqrt(2000)


def test_a_missing_tooth_is_not_counted() -> None:
    found = pulses(TachoSheet(missing_probability=0.25), 1000)
    assert abs(len(found) - 750) < 69  # five times √(1000 · 3/16)
    assert [pulse.sequence for pulse in found] == list(range(1, len(found) + 1))
    turns = np.array([pulse.interval_s for pulse in found[1:]]) * 28.0
    assert turns == pytest.approx(np.rint(turns))
    assert turns.max() >= 2.0
