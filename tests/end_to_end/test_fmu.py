# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`roller-sim fmu`: an independent importer runs the unit, and it is the roller that the session is."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.validation import validate_fmu
from numpy.typing import NDArray

import roller_sim_ros
from roller_sim_ros import commands
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.fmu.stepped import INPUTS, SteppedRoller
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import Session

SOURCE = Path(roller_sim_ros.__file__).resolve().parents[1]
FREQUENCY_HZ = 28.0
PERIOD_S = 1.0 / (128 * FREQUENCY_HZ)
REVOLUTIONS = 60
CHANGE = 30
"""Revolution before which the inputs change."""

OUTPUTS = ("acceleration_vertical", "acceleration_horizontal", "soil_force", "cmv")

SOFT = {"soil.shear_modulus_pa": 35e6, "soil.plastic_parameter_m": 0.8e-3}
STIFF = {"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3}


@pytest.fixture(scope="module")
def unit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("fmu") / "roller.fmu"
    flags = ["--shear-modulus-mpa", "35", "--plastic-mm", "0.8", "--half-space", "two-pole"]
    assert commands.main(["fmu", str(path), *flags]) == 0
    return path


def configuration() -> Configuration:
    return Configuration().changed({"half_space.model": "two-pole", **SOFT})


def signals(change: dict[str, float]) -> NDArray[Any]:
    """Inputs over time as fmpy takes them: constant, and others from the change on."""
    flat = configuration().flat()
    kinds = [("time", float), *((name, float) for name in INPUTS)]
    change_s = (CHANGE - 0.5) / FREQUENCY_HZ
    before = tuple(float(flat[name]) for name in INPUTS)
    after = tuple(float(change.get(name, flat[name])) for name in INPUTS)
    rows = [(0.0, *before), (change_s, *before), (change_s, *after), (10.0, *after)]
    return np.array(rows, dtype=kinds)


def offline(change: dict[str, float]) -> dict[str, NDArray[np.float64]]:
    """The same run without the unit: samples and CMV of the emulator's meter."""
    emulator = Emulator(configuration(), start_ns=0)
    found: dict[str, list[Any]] = {name: [] for name in ("vertical", "horizontal", "force", "cmv")}
    for revolution in range(REVOLUTIONS):
        if revolution == CHANGE:
            emulator.change(change)
        emulator.advance(128)
        block, value = emulator.block, emulator.meter_value
        assert block is not None
        assert value is not None
        found["vertical"].append(block.acceleration_vertical)
        found["horizontal"].append(block.acceleration_horizontal)
        found["force"].append(block.soil_force)
        found["cmv"].append(np.nan_to_num(value.cmv))
    return {
        name: np.array(parts) if name == "cmv" else np.concatenate(parts)
        for name, parts in found.items()
    }


def test_unit_is_valid_and_says_what_it_needs(unit: Path) -> None:
    assert validate_fmu(str(unit)) == []
    description = read_model_description(str(unit))
    assert description.fmiVersion == "2.0"
    causality = {item.name: item.causality for item in description.modelVariables}
    assert [name for name, kind in causality.items() if kind == "input"] == list(INPUTS)
    outputs = [name for name, kind in causality.items() if kind == "output"]
    assert outputs == list(OUTPUTS)
    with zipfile.ZipFile(unit) as archive:
        names = archive.namelist()
    assert not [name for name in names if "__pycache__" in name or "/node/" in name]


def simulate(
    unit: Path, inputs: NDArray[Any], *, installed: bool = True, **options: float
) -> NDArray[Any]:
    """Run the unit by fmpy in a process of its own, which finds the package installed or only in the unit."""
    np.save(unit.with_name("inputs.npy"), inputs)
    program = (
        "import sys, numpy, fmpy\n"
        f"source = {str(SOURCE)!r}\n"
        f"if not {installed}: sys.path = [path for path in sys.path if path != source]\n"
        "folder = sys.argv[1]\n"
        "found = fmpy.simulate_fmu(folder + '/roller.fmu', input=numpy.load(folder + '/inputs.npy'),"
        f" output={list(OUTPUTS)}, debug_logging=True, **{options})\n"
        "import roller_sim_ros\n"
        f"assert roller_sim_ros.__file__.startswith(source) == {installed}\n"
        "numpy.save(folder + '/outputs.npy', found)\n"
    )
    subprocess.run(
        [sys.executable, "-c", program, str(unit.parent)],
        check=True,
        timeout=120,
        capture_output=True,
        text=True,
        cwd=unit.parent,
        env={**os.environ} if installed else {**os.environ, "ROLLER_SIM_NO_JIT": "1"},
    )
    outputs: NDArray[Any] = np.load(unit.with_name("outputs.npy"))
    return outputs


def test_an_independent_importer_gets_the_session_s_samples(unit: Path) -> None:
    found = simulate(
        unit,
        signals(STIFF),
        stop_time=REVOLUTIONS / FREQUENCY_HZ - PERIOD_S,
        step_size=PERIOD_S,
        output_interval=PERIOD_S,
    )
    expected = offline(STIFF)
    assert len(found) == REVOLUTIONS * 128
    np.testing.assert_array_equal(found["acceleration_vertical"], expected["vertical"])
    np.testing.assert_array_equal(found["acceleration_horizontal"], expected["horizontal"])
    np.testing.assert_array_equal(found["soil_force"], expected["force"])
    # CMV of a revolution shows from its last sample on.
    np.testing.assert_array_equal(found["cmv"][127::128], expected["cmv"])
    np.testing.assert_array_equal(found["cmv"][254::128], expected["cmv"][:-1])
    assert expected["cmv"][-1] != expected["cmv"][CHANGE - 1] != 0.0


def test_unit_runs_where_the_package_is_not_installed(unit: Path) -> None:
    found = simulate(
        unit,
        signals({}),
        installed=False,
        stop_time=2.0 / FREQUENCY_HZ - PERIOD_S,
        step_size=PERIOD_S,
        output_interval=PERIOD_S,
    )
    session = Session(configuration())
    expected = np.concatenate([session.advance(128).soil_force for _ in range(2)])
    np.testing.assert_allclose(found["soil_force"], expected, rtol=1e-9)


def test_other_communication_steps_see_the_sample_before_them() -> None:
    roller = SteppedRoller(configuration())
    session = Session(configuration())
    samples = np.concatenate([session.advance(128).acceleration_vertical for _ in range(3)])
    for time_s in np.linspace(0.0, 2.9 / FREQUENCY_HZ, 77):
        roller.advance_to(float(time_s))
        index = int(time_s / PERIOD_S + 0.01)
        assert roller.outputs.acceleration_vertical == samples[index]


def test_frequency_changes_at_the_next_revolution() -> None:
    roller = SteppedRoller(configuration())
    roller.advance_to(0.01)
    roller.inputs["exciter.frequency_hz"] = 30.0
    session = Session(configuration())
    session.advance(128)
    session.change({"exciter.frequency_hz": 30.0})
    block = session.advance(128)
    roller.advance_to(block.time_s + 64 * block.sample_period_s)
    assert roller.outputs.acceleration_vertical == block.acceleration_vertical[64]


def test_input_out_of_bounds_ends_the_run_with_the_reason(unit: Path) -> None:
    refused = signals({"soil.plastic_parameter_m": -1.0})
    with pytest.raises(subprocess.CalledProcessError) as error:
        simulate(unit, refused, stop_time=2.0, step_size=1.0 / FREQUENCY_HZ)
    assert "fmi2DoStep" in error.value.stderr
    assert "soil.plastic_parameter_m = -1.0" in error.value.stderr + error.value.stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(["roller.zip"], "has to end in .fmu"), (["missing/roller.fmu"], "cannot be written")],
)
def test_what_cannot_be_is_said_in_a_line(
    arguments: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "file" / arguments[0]
    path.parent.parent.mkdir(exist_ok=True)
    (tmp_path / "file").touch() if "missing" in arguments[0] else (tmp_path / "file").mkdir()
    assert commands.main(["fmu", str(path)]) == 1
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
