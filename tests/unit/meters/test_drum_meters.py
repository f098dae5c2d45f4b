# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Force, travel and the values that need the machine, against motions that are known in closed form."""

from __future__ import annotations

import doctest
import math
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.meters import drum as drum_module
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.registry import (
    DRUM_METERS,
    FURTHER,
    METERS,
    column,
    evaluate_drum,
)
from roller_sim_ros.parameters import Exciter, Machine

N = 128
HZ, AMPLITUDE = 28.0, 1.6e-3
OMEGA = 2.0 * math.pi * HZ
DRUM = Drum.of(Machine(), Exciter())
FORCE = 3200.0 * AMPLITUDE * OMEGA**2


def phase(revolutions: int = 16, first: float = 0.0) -> np.ndarray:
    return first + 2.0 * np.pi * np.arange(revolutions * N) / N


def on_spring(stiffness: float, damping: float, first: float = 0.0) -> DrumMotion:
    """A drum that stays on a spring and a dashpot: m_d z'' + c z' + k z = F sin φ."""
    response = FORCE / (stiffness - 3200.0 * OMEGA**2 + 1j * damping * OMEGA)
    height = np.imag(response * np.exp(1j * phase(first=first)))
    return DrumMotion(-(OMEGA**2) * height, DRUM, AMPLITUDE, HZ, phase_rad=first)


@pytest.mark.parametrize(
    ("stiffness", "damping"), [(20e6, 0.0), (60e6, 2e5), (150e6, 6e5), (5e6, 1e5)]
)
@pytest.mark.parametrize("first", [0.0, 2.1])
def test_spring_and_dashpot_are_found(stiffness: float, damping: float, first: float) -> None:
    motion = on_spring(stiffness, damping, first)
    values = evaluate_drum(motion)
    assert values["k_s"] == pytest.approx(stiffness, rel=1e-9)
    # All that a dashpot takes in two revolutions: 2 π c ω z².
    response = FORCE / (stiffness - 3200.0 * OMEGA**2 + 1j * damping * OMEGA)
    taken = 2.0 * math.pi * damping * OMEGA * abs(response) ** 2
    assert values["omega"] == pytest.approx(taken, rel=1e-9, abs=1e-6)
    # The force is that of the spring and the dashpot, about the static load.
    turn = response * np.exp(1j * phase(first=first))
    expected = DRUM.static_load_n - stiffness * turn.imag - damping * OMEGA * turn.real
    assert motion.soil_force == pytest.approx(expected, abs=1e-5)
    assert motion.height == pytest.approx(turn.imag, abs=1e-12)


def test_free_drum_has_no_soil() -> None:
    motion = DrumMotion(AMPLITUDE * OMEGA**2 * np.sin(phase()), DRUM, AMPLITUDE, HZ)
    assert motion.soil_force == pytest.approx(np.full(16 * N, DRUM.static_load_n), abs=1e-6)
    assert float(motion.height.max()) == pytest.approx(AMPLITUDE)
    assert float(motion.height[N // 4]) == pytest.approx(-AMPLITUDE)
    assert evaluate_drum(motion)["k_s"] == pytest.approx(0.0, abs=1e-3)
    assert evaluate_drum(motion)["omega"] == pytest.approx(0.0, abs=1e-9)


def test_travel_of_every_order_is_integrated_twice() -> None:
    turns = phase(4)
    vertical, height = np.zeros(4 * N), np.zeros(4 * N)
    for order, size, lag in ((0.25, 2.0, 0.3), (0.5, 9.0, 1.0), (1.0, 40.0, 0.0), (7.0, 5.0, 2.0)):
        wave = size * np.sin(order * turns + lag)
        vertical += wave
        height -= wave / (order * OMEGA) ** 2
    motion = DrumMotion(vertical, DRUM, AMPLITUDE, HZ)
    assert motion.height == pytest.approx(height, abs=1e-13)


def test_gravity_and_bias_change_nothing() -> None:
    motion = on_spring(40e6, 2e5)
    biased = DrumMotion(motion.vertical + 9.81 + 0.3, DRUM, AMPLITUDE, HZ)
    assert biased.soil_force == pytest.approx(motion.soil_force, abs=1e-6)
    assert biased.height == pytest.approx(motion.height, abs=1e-14)
    assert biased.soil_force.mean() == pytest.approx(DRUM.static_load_n)
    for name, value in evaluate_drum(motion).items():
        assert evaluate_drum(biased)[name] == pytest.approx(value, rel=1e-9)


def test_energy_is_that_of_the_loop() -> None:
    rng = np.random.default_rng(3)
    turns = phase(2)
    vertical = sum(
        rng.normal() * 20.0 * np.sin(order * turns + rng.uniform(0, 6))
        for order in (0.5, 1, 1.5, 2, 3)
    )
    motion = DrumMotion(np.asarray(vertical), DRUM, AMPLITUDE, HZ)
    # Resampled densely, the polygon of the loop has the loop's area.
    fine = 64 * 2 * N
    force, height = (
        np.fft.irfft(np.fft.rfft(values), fine) * fine / (2 * N)
        for values in (motion.soil_force, motion.height)
    )
    steps = np.diff(height, append=height[0])
    loop = -float(np.sum(0.5 * (force + np.roll(force, -1)) * steps))
    assert evaluate_drum(motion)["omega"] == pytest.approx(loop, rel=1e-5)


def test_directed_exciter_counts_with_its_vertical_share() -> None:
    tilted = Drum.of(Machine(), Exciter(kind="directed", tilt_rad=math.radians(60.0)))
    upright = Drum.of(Machine(), Exciter(kind="directed", tilt_rad=0.0))
    motion = on_spring(40e6, 2e5)
    halved = DrumMotion(motion.vertical / 2.0, tilted, AMPLITUDE, HZ)
    assert halved.force_amplitude == pytest.approx(FORCE / 2.0)
    assert evaluate_drum(halved)["k_s"] == pytest.approx(40e6, rel=1e-9)
    assert upright.vertical_share == DRUM.vertical_share == 1.0


def test_several_motions_at_once_give_what_each_gives() -> None:
    stiffness = np.array([10e6, 30e6, 90e6])
    motions = [on_spring(item, 3e5) for item in stiffness]
    together = DrumMotion(
        np.stack([motion.vertical for motion in motions]),
        Drum(np.full(3, 3200.0), np.full(3, DRUM.static_load_n), np.full(3, 0.75), 2.1),
        np.full(3, AMPLITUDE),
        HZ,
    )
    values = evaluate_drum(together)
    assert set(values) == {"omega", "e_vib", "k_s"}
    for name, found in values.items():
        assert found.shape == (3,)
        single = [float(evaluate_drum(motion)[name]) for motion in motions]
        assert found == pytest.approx(single, rel=1e-12)
        assert len(set(single)) == 3


def test_drum_that_does_not_vibrate_has_no_stiffness() -> None:
    still = DrumMotion(np.zeros(2 * N), DRUM, 0.0, HZ)
    values = evaluate_drum(still)
    assert math.isnan(values["k_s"])
    assert math.isnan(values["e_vib"])
    assert values["omega"] == 0.0


@pytest.mark.parametrize("samples", [0, N, 3 * N, 2 * N - 1])
def test_windows_that_halves_do_not_fit_are_refused(samples: int) -> None:
    with pytest.raises(ValueError, match=f"{samples} samples are no even number of revolutions"):
        DrumMotion(np.zeros(samples), DRUM, AMPLITUDE, HZ)


def test_every_further_meter_states_unit_and_source() -> None:
    assert [meter.name for meter in FURTHER] == ["ccv", "omega", "e_vib", "k_s"]
    assert [meter.unit for meter in FURTHER] == ["", "J", "Pa", "N/m"]
    assert [column(meter) for meter in FURTHER] == ["ccv", "omega_j", "e_vib_pa", "k_s_n_m"]
    names = [meter.name for meter in (*METERS, *DRUM_METERS)]
    assert len(set(names)) == len(names)
    for meter in (*METERS, *DRUM_METERS):
        assert len(meter.source) > 20
        assert meter.verified is False


def test_example_in_the_documentation_runs() -> None:
    result: Any = doctest.testmod(drum_module)
    assert result.attempted > 3
    assert result.failed == 0
