# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Ground and roller from flags: presets, states, and which of several flags has the last word."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from roller_sim_ros.commands.run import main
from roller_sim_ros.parameters import Machine, ParameterError
from roller_sim_ros.soil_mechanics import GranularSoil, machine_preset, soil_preset


@pytest.fixture
def parameters(capsys: pytest.CaptureFixture[str]) -> Any:
    def run(*flags: str) -> dict[str, Any]:
        assert main([*flags, "--revolutions", "2", "--json", "-"]) == 0
        found: dict[str, Any] = json.loads(capsys.readouterr().out)["parameters"]
        return found

    return run


def test_without_flags_nothing_changes(parameters: Any) -> None:
    found = parameters()
    assert found["soil.shear_modulus_pa"] == 50e6
    assert found["machine.drum_mass_kg"] == 3200.0


def test_presets_of_ground_and_roller(parameters: Any) -> None:
    found = parameters("--machine", "ca250", "--soil", "dense-gravel")
    roller = machine_preset("ca250")
    ground = soil_preset("dense-gravel").soil(roller.machine)
    assert found["machine.drum_mass_kg"] == roller.machine.drum_mass_kg
    assert found["exciter.frequency_hz"] == 33.0
    assert found["exciter.amplitude_m"] == 1.7e-3
    assert found["soil.shear_modulus_pa"] == ground.shear_modulus_pa
    assert found["soil.plastic_parameter_m"] == ground.plastic_parameter_m
    assert found["soil.density_kg_m3"] == ground.density_kg_m3


def test_the_parameters_own_flags_have_the_last_word(parameters: Any) -> None:
    found = parameters(
        *("--machine", "ca250", "--drum-radius-m", "0.5", "--amplitude-mm", "0.9"),
        *("--soil", "sand", "--shear-modulus-mpa", "44", "--poisson-ratio", "0.3"),
    )
    machine = Machine(
        **{
            name.partition(".")[2]: value
            for name, value in found.items()
            if name.startswith("machine.")
        }
    )
    assert machine.drum_radius_m == 0.5
    assert found["exciter.amplitude_m"] == 0.9e-3
    assert found["soil.shear_modulus_pa"] == 44e6
    assert found["soil.poisson_ratio"] == 0.3
    # p is that under the drum as changed.
    plastic = soil_preset("sand").soil(machine).plastic_parameter_m
    assert found["soil.plastic_parameter_m"] == plastic
    assert plastic > 1.4 * soil_preset("sand").soil(Machine()).plastic_parameter_m


def test_state_changes_the_named_ground_else_medium_gravel(parameters: Any) -> None:
    found = parameters(
        *("--void-ratio", "0.5", "--friction-angle-deg", "42", "--unit-weight-kn-m3", "19"),
        *("--k0", "0.7", "--depth-m", "1.5", "--grains", "angular", "--n-gamma", "meyerhof"),
    )
    state = GranularSoil(
        void_ratio=0.5,
        friction_angle_rad=math.radians(42.0),
        unit_weight_n_m3=19e3,
        earth_pressure_coefficient=0.7,
        depth_m=1.5,
        grains="angular",
        n_gamma="meyerhof",
    )
    assert found["soil.shear_modulus_pa"] == state.soil(Machine()).shear_modulus_pa
    assert found["soil.plastic_parameter_m"] == pytest.approx(
        state.soil(Machine()).plastic_parameter_m, rel=1e-12
    )
    only_angle = parameters("--friction-angle-deg", "46")
    medium = soil_preset("medium-gravel").soil(Machine())
    assert only_angle["soil.shear_modulus_pa"] == medium.shear_modulus_pa
    assert only_angle["soil.plastic_parameter_m"] < medium.plastic_parameter_m
    loose = parameters("--soil", "loose-gravel", "--friction-angle-deg", "46")
    assert loose["soil.shear_modulus_pa"] < medium.shear_modulus_pa


def test_presets_win_over_the_file(parameters: Any, tmp_path: Path) -> None:
    file = tmp_path / "file.yaml"
    file.write_text("soil: {shear_modulus_pa: 20.0e+6}\nmachine: {drum_radius_m: 0.6}\n")
    found = parameters("--params", str(file), "--soil", "paper-stiff")
    assert found["soil.shear_modulus_pa"] == 80e6
    assert found["machine.drum_radius_m"] == 0.6
    assert found["soil.plastic_parameter_m"] == pytest.approx(0.5e-3 * 0.75 / 0.6)
    assert parameters("--params", str(file))["soil.shear_modulus_pa"] == 20e6


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (("--soil", "dense-gravle"), "soil = 'dense-gravle': .*did you mean dense-gravel"),
        (("--machine", "d9"), "machine = 'd9': there is no such preset; there are paper-10t"),
        (("--void-ratio", "3"), r"--void-ratio = 3\.0: must be 0\.15 … 1\.5"),
        (("--friction-angle-deg", "80"), r"--friction-angle-deg = 80\.0: must be 20 … 60 deg"),
        (("--grains", "flat"), "--grains = 'flat': must be one of round, angular"),
        (("--soil", "paper-soft", "--k0", "1"), "'paper-soft': .*G and p alone.*--k0"),
        (("--friction-angle-deg", "25"), r"soil\.plastic_parameter_m = 0\.042.*at most 0\.02 m"),
    ],
)
def test_what_is_refused_is_named(flags: tuple[str, ...], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        main([*flags, "--revolutions", "2"])
