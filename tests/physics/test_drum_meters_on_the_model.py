# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the meters that know their machine make of the simulated drum, beside the truth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.half_space import exact_compliance, static_compliance
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.e_vib import vibration_modulus
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import ORDERS, evaluate, evaluate_drum
from roller_sim_ros.parameters import Exciter, HalfSpace, covarying_plastic_parameter
from tests.physics.rollers import MACHINE, Point, settled

N = 128
HZ = 28.0


@dataclass(frozen=True)
class Case:
    """A settled motion as published, and the truth behind it."""

    motion: DrumMotion
    force: np.ndarray
    height: np.ndarray
    air: np.ndarray

    @property
    def sinking_m(self) -> float:
        """How much deeper the drum gets in a revolution."""
        apart = len(self.height) // N - 4
        return float(self.height[0] - self.height[apart * N]) / apart


@cache
def case(modulus_mpa: float, amplitude_mm: float, model: str = "exact") -> Case:
    modulus = modulus_mpa * 1e6
    point = Point(HZ, amplitude_mm * 1e-3, modulus, covarying_plastic_parameter(modulus))
    samples = settled(point, HalfSpace(model=model), revolutions=1000).samples
    return Case(
        motion=DrumMotion(
            samples[at.OUT_VERTICAL].astype(np.float32),
            Drum.of(MACHINE, Exciter()),
            amplitude_mm * 1e-3,
            HZ,
        ),
        force=samples[at.OUT_FORCE],
        height=-samples[at.OUT_DEPTH],
        air=samples[at.OUT_PHASE] == 2,
    )


def values(found: Case) -> dict[str, float]:
    harmonics = order_amplitudes(found.motion.vertical, ORDERS)
    return evaluate(harmonics) | {
        name: float(value) for name, value in evaluate_drum(found.motion).items()
    }


def energy_of_the_truth(found: Case) -> float:
    """−∮ F dz over two revolutions, the mean over all, J."""
    steps = np.diff(found.height)
    pairs = len(steps) / (2 * N)
    return -float(np.sum(0.5 * (found.force[1:] + found.force[:-1]) * steps)) / pairs


@pytest.mark.parametrize("model", ["exact", "two-pole"])
@pytest.mark.parametrize(
    ("modulus", "amplitude"), [(35, 1.6), (80, 0.8), (80, 1.6), (120, 0.8), (120, 1.6)]
)
def test_omega_is_the_energy_that_the_soil_gets(
    modulus: float, amplitude: float, model: str
) -> None:
    found = case(modulus, amplitude, model)
    assert found.sinking_m < 1e-5
    assert values(found)["omega"] == pytest.approx(energy_of_the_truth(found), rel=0.01)


@pytest.mark.parametrize(("modulus", "amplitude"), [(15, 0.8), (15, 1.6), (25, 1.6), (45, 0.8)])
def test_work_of_a_sinking_drums_weight_is_what_omega_lacks(
    modulus: float, amplitude: float
) -> None:
    found = case(modulus, amplitude)
    assert found.sinking_m > 5e-4
    weight = 2.0 * found.sinking_m * MACHINE.static_load_n
    truth = energy_of_the_truth(found)
    assert values(found)["omega"] == pytest.approx(truth - weight, rel=0.01)
    assert values(found)["omega"] < 0.95 * truth


@pytest.mark.parametrize("amplitude", [0.8, 1.6])
@pytest.mark.parametrize("modulus", [35, 80, 120])
def test_force_and_travel_are_those_of_the_truth(modulus: float, amplitude: float) -> None:
    found = case(modulus, amplitude)
    # Rounding to single precision, and a mean that is not quite zero over the window.
    assert found.motion.soil_force == pytest.approx(found.force, abs=2e-4 * found.force.max())
    assert float(np.abs(found.motion.soil_force[found.air]).max()) < 1e-4 * found.force.max()
    level = found.height + found.sinking_m * np.arange(len(found.height)) / N
    travel = float(np.ptp(level))
    assert found.motion.height == pytest.approx(level - level.mean(), abs=0.005 * travel)


@pytest.mark.parametrize(("modulus", "amplitude"), [(35, 1.6), (80, 0.8), (80, 1.6), (120, 1.6)])
def test_e_vib_from_the_acceleration_is_that_of_the_true_force_and_height(
    modulus: float, amplitude: float
) -> None:
    found = case(modulus, amplitude)
    true = vibration_modulus(
        found.force,
        found.height,
        MACHINE.static_load_n,
        MACHINE.drum_radius_m,
        MACHINE.drum_width_m,
    )
    assert values(found)["e_vib"] == pytest.approx(float(true), rel=0.005)


@pytest.mark.parametrize("modulus", [20e6, 80e6])
def test_k_s_is_the_elastic_stiffness_under_a_slow_load_on_a_bonded_drum(modulus: float) -> None:
    half_width, half_length = 0.125, 1.05
    area = (half_width, half_length)
    drum = Drum.of(MACHINE, Exciter())
    turns = 2.0 * np.pi * np.arange(16 * N) / N
    found = []
    for hz in (0.5, 5.0, 28.0):
        omega = 2.0 * math.pi * hz
        compliance = complex(exact_compliance(omega, modulus, 2000.0, 0.25, *area))
        force = MACHINE.drum_mass_kg * 1e-3 * omega**2
        response = force / (1.0 / compliance - MACHINE.drum_mass_kg * omega**2)
        vertical = -(omega**2) * np.imag(response * np.exp(1j * turns))
        stiffness = float(evaluate_drum(DrumMotion(vertical, drum, 1e-3, hz))["k_s"])
        assert stiffness == pytest.approx((1.0 / compliance).real, rel=1e-6)
        found.append(stiffness)
    static = 1.0 / static_compliance(modulus, 0.25, *area)
    assert found[0] == pytest.approx(static, rel=0.001)
    # At the working frequency what radiates is in the dashpot still: a0 is 0.6 and less.
    assert found == pytest.approx([static] * 3, rel=0.025)


def test_double_jump_misleads_cmv_and_k_s_but_hardly_e_vib() -> None:
    stable, jumping = values(case(45, 1.6)), values(case(55, 1.6))
    assert jumping["rmv"] > 100.0 > stable["rmv"]
    assert jumping["cmv"] < 0.75 * stable["cmv"]
    assert jumping["k_s"] < 0.5 * stable["k_s"]
    assert jumping["ccv"] > 1.5 * stable["ccv"]
    assert jumping["e_vib"] > 1.1 * stable["e_vib"]
    # No value but E_vib is the same for the same ground at half the amplitude.
    gentle, rough = values(case(80, 0.8)), values(case(80, 1.6))
    assert rough["e_vib"] == pytest.approx(gentle["e_vib"], rel=0.15)
    for name in ("cmv", "ccv", "k_s", "omega"):
        assert rough[name] != pytest.approx(gentle[name], rel=0.15), name


def test_at_low_amplitude_all_values_rise_with_the_stiffness_of_the_ground() -> None:
    moduli = (15, 25, 35, 45, 55, 80, 120)
    series = [values(case(modulus, 0.8)) for modulus in moduli]
    for name in ("cmv", "ccv", "e_vib", "k_s", "omega"):
        found = [item[name] for item in series]
        assert found == sorted(found), name
