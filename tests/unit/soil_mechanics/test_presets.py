# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Grounds and rollers by name: complete, within bounds, as the sources have them."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from roller_sim_ros.parameters import Configuration, Machine, ParameterError
from roller_sim_ros.soil_mechanics import (
    MACHINES,
    SOILS,
    GranularSoil,
    line_load,
    machine_preset,
    mean_effective_stress,
    n_gamma_meyerhof,
    plastic_parameter,
    scaled_plastic_parameter,
    small_strain_modulus,
    soil_preset,
)

GRAVEL = ("loose-gravel", "medium-gravel", "dense-gravel")


def test_all_that_were_asked_for_are_there_with_a_source() -> None:
    assert {*GRAVEL, "sand"} <= set(SOILS)
    assert {"paper-10t", "multibody", "sd-150", "cs-563e", "ca250"} == set(MACHINES)
    for name, preset in {**SOILS, **MACHINES}.items():
        assert preset.name == name
        assert len(preset.source) > 20
        assert preset.doc
    assert {name for name, item in MACHINES.items() if item.verified} == {"paper-10t"}
    assert {name for name, item in SOILS.items() if item.verified} == {"paper-soft", "paper-stiff"}


@pytest.mark.parametrize("machine", list(MACHINES))
@pytest.mark.parametrize("soil", list(SOILS))
def test_every_ground_under_every_roller_is_within_the_models_bounds(
    soil: str, machine: str
) -> None:
    preset = machine_preset(machine)
    configuration = Configuration().changed(preset.values())
    assert configuration.machine == preset.machine
    assert configuration.exciter.frequency_hz == preset.frequency_hz
    assert configuration.exciter.amplitude_m == preset.amplitude_m
    ground = soil_preset(soil).soil(preset.machine)
    assert replace(configuration, soil=ground).soil == ground


def test_gravel_becomes_stiffer_and_stronger_as_it_is_compacted() -> None:
    grounds = [soil_preset(name).soil(Machine()) for name in GRAVEL]
    moduli = [ground.shear_modulus_pa for ground in grounds]
    plastic = [ground.plastic_parameter_m for ground in grounds]
    densities = [ground.density_kg_m3 for ground in grounds]
    assert moduli == sorted(moduli)
    assert plastic == sorted(plastic, reverse=True)
    assert densities == sorted(densities)
    assert 30e6 < moduli[0] < moduli[2] < 80e6
    # The dense one lies at the paper's (80 MPa, 0.5 mm).
    assert plastic[2] == pytest.approx(0.57e-3, abs=0.01e-3)


def test_granular_state_gives_g_and_p_of_the_equations() -> None:
    state = GranularSoil(
        void_ratio=0.5,
        friction_angle_rad=math.radians(42.0),
        unit_weight_n_m3=19.62e3,
        earth_pressure_coefficient=0.5,
        depth_m=2.0,
        grains="angular",
        n_gamma="meyerhof",
        poisson_ratio=0.3,
    )
    machine = Machine(drum_radius_m=0.6, drum_width_m=1.7)
    soil = state.soil(machine)
    stress = mean_effective_stress(19.62e3, 2.0, 0.5)
    assert soil.shear_modulus_pa == small_strain_modulus(0.5, stress, "angular")
    factor = n_gamma_meyerhof(math.radians(42.0))
    assert soil.plastic_parameter_m == plastic_parameter(19.62e3, factor, line_load(machine), 0.6)
    assert soil.density_kg_m3 == pytest.approx(2000.0)
    assert soil.poisson_ratio == 0.3


def test_defaults_of_a_granular_soil_are_medium_gravel() -> None:
    assert soil_preset("medium-gravel").ground == GranularSoil()


def test_friction_angles_of_the_presets_are_boltons() -> None:
    # φ − φ_cv = 5° I_R, I_R = I_D (10 − ln p') − 1, p' 150 kPa; loose: 0.3 · 4.989 − 1 = 0.497.
    for name, degrees in (
        ("loose-gravel", 37.5),
        ("medium-gravel", 45.0),
        ("dense-gravel", 50.0),
        ("sand", 40.5),
    ):
        ground = soil_preset(name).ground
        assert isinstance(ground, GranularSoil)
        assert math.degrees(ground.friction_angle_rad) == pytest.approx(degrees, abs=0.05)


def test_ground_that_is_too_weak_for_the_roller_is_refused_with_what_came_out() -> None:
    state = GranularSoil(friction_angle_rad=math.radians(25.0))
    with pytest.raises(ParameterError, match=r"soil\.plastic_parameter_m = 0\.04.*at most 0\.02 m"):
        state.soil(Machine())


def test_the_papers_grounds_are_scaled_to_the_roller() -> None:
    assert soil_preset("paper-soft").soil(Machine()).plastic_parameter_m == 0.8e-3
    heavy = machine_preset("multibody").machine
    stiff = soil_preset("paper-stiff").soil(heavy)
    assert stiff.shear_modulus_pa == 80e6
    assert stiff.plastic_parameter_m == scaled_plastic_parameter(0.5e-3, Machine(), heavy)
    assert stiff.plastic_parameter_m == pytest.approx(0.5e-3 * 34295.17 / 26160 * 0.75 / 0.759)


def test_drum_masses_follow_from_the_catalogues() -> None:
    # F_e = m_d A ω², both settings of the Caterpillar.
    for name, amplitude, hz, force in (
        ("cs-563e", 1.7e-3, 31.9, 266e3),
        ("cs-563e", 0.85e-3, 31.9, 133e3),
        ("ca250", 1.7e-3, 33.0, 246e3),
    ):
        mass = machine_preset(name).machine.drum_mass_kg
        assert mass * amplitude * (2.0 * math.pi * hz) ** 2 == pytest.approx(force, rel=3e-4)
    assert line_load(machine_preset("ca250").machine) == pytest.approx(26160.0, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "frame", "drum", "moment"),
    [("multibody", 3159.0, 4183.0, 7.31), ("sd-150", 2534.0, 4466.0, 4.25)],
)
def test_masses_and_eccentric_moment_of_the_others(
    name: str, frame: float, drum: float, moment: float
) -> None:
    preset = machine_preset(name)
    assert preset.machine.frame_mass_kg == frame
    assert preset.machine.drum_mass_kg == pytest.approx(drum, abs=1.0)
    assert preset.amplitude_m * preset.machine.drum_mass_kg == pytest.approx(moment)


def test_unknown_names_are_refused_with_the_nearest_and_the_list() -> None:
    with pytest.raises(
        ParameterError, match=r"soil = 'dens-gravel': .*did you mean dense-gravel\?"
    ) as got:
        soil_preset("dens-gravel")
    assert all(name in str(got.value) for name in SOILS)
    with pytest.raises(ParameterError, match=r"machine = 'D9': there is no such preset; there are"):
        machine_preset("D9")
