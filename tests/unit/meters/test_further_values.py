# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The streaming meter's further values: those of its window, and unknown where the machine's facts are."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.meters import CompactionMeter, MeterValue, Status
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import FURTHER, ORDERS, evaluate, evaluate_drum
from roller_sim_ros.parameters import Exciter, Machine

N = 128
STEP = 2.0 * math.pi / N
DRUM = Drum.of(Machine(), Exciter())
AMPLITUDE, HZ = 1.6e-3, 28.0
NAMES = [meter.name for meter in FURTHER]
NEEDS_MACHINE = ("omega", "e_vib", "k_s")


def feed(
    samples: np.ndarray,
    meter: CompactionMeter,
    amplitudes: dict[int, float] | None = None,
    frequencies: dict[int, float] | None = None,
    phase: float = 0.0,
) -> list[MeterValue]:
    """Feed blocks of 16; amplitude and frequency as of the given revolutions."""
    values, amplitude, hz = [], AMPLITUDE, HZ
    for first in range(0, len(samples), 16):
        amplitude = (amplitudes or {}).get(first // N, amplitude)
        hz = (frequencies or {}).get(first // N, hz)
        values += meter.feed(
            first,
            samples[first : first + 16].astype(np.float32),
            1.0 / (hz * N),
            hz,
            (first * STEP + phase) % (2.0 * math.pi),
            STEP,
            amplitude,
        )
    return values


def on_spring(revolutions: int, phase: float) -> np.ndarray:
    """The acceleration of a drum that stays on a spring and a dashpot, with a second harmonic."""
    omega = 2.0 * math.pi * HZ
    force = 3200.0 * AMPLITUDE * omega**2
    response = force / (70e6 - 3200.0 * omega**2 + 1j * 2e5 * omega)
    turns = phase + STEP * np.arange(revolutions * N)
    return np.asarray(
        -(omega**2) * np.imag(response * np.exp(1j * turns)) + 3.0 * np.sin(2.0 * turns)
    )


@pytest.mark.parametrize("phase", [0.0, 1.0])
def test_values_are_those_of_the_window(phase: float) -> None:
    samples = on_spring(20, phase).astype(np.float32)
    found = feed(samples, CompactionMeter(4, drum=DRUM), phase=phase)[-1]
    window = samples[-4 * N :]
    motion = DrumMotion(window, DRUM, AMPLITUDE, HZ, phase_rad=phase)
    expected = evaluate(order_amplitudes(window, ORDERS)) | evaluate_drum(motion)
    assert list(found.further) == NAMES == ["ccv", "omega", "e_vib", "k_s"]
    for name, value in found.further.items():
        assert isinstance(value, float)
        assert value == pytest.approx(float(expected[name]), rel=1e-7), name
        assert value > 0.0
    assert found.further["k_s"] == pytest.approx(70e6, rel=1e-5)


def test_without_the_machine_only_ccv_is_known(drum: Callable[..., Any]) -> None:
    samples = drum(8, 2, 0.6).vertical
    machine = CompactionMeter(4, drum=DRUM)
    for found in (
        feed(samples, CompactionMeter(4))[-1],
        feed(samples, machine, amplitudes={0: math.nan})[-1],
    ):
        assert found.status is Status.NONE
        assert found.further["ccv"] > 0.0
        assert all(math.isnan(found.further[name]) for name in NEEDS_MACHINE)


@pytest.mark.parametrize("changed", ["amplitudes", "frequencies"])
def test_change_of_the_exciter_is_waited_for(drum: Callable[..., Any], changed: str) -> None:
    samples = drum(16, 1, 0.5).vertical
    value = {"amplitudes": 1.2e-3, "frequencies": 30.0}[changed]
    meter = CompactionMeter(4, drum=DRUM)
    found = feed(samples, meter, **{changed: {8: value}})
    for revolution, item in enumerate(found):
        known = revolution >= 3 and not 8 <= revolution < 11
        for name in ("omega", "k_s"):
            assert math.isfinite(item.further[name]) == known, (revolution, name)
        assert known or math.isnan(item.further["e_vib"])
        assert math.isfinite(item.further["ccv"]) == (revolution >= 3)
    assert found[-1].further["k_s"] != pytest.approx(found[7].further["k_s"], rel=0.01)


def test_no_value_of_any_kind_while_there_is_none() -> None:
    still = feed(np.zeros(8 * N), CompactionMeter(4, drum=DRUM))
    assert still[2].status is Status.WINDOW_FILLING
    assert still[-1].status is Status.BELOW_NOISE
    for item in still:
        assert list(item.further) == NAMES
        assert all(math.isnan(value) for value in item.further.values())
