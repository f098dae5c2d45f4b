# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""roller-sim sweep as a user runs it: the file, going on after an interruption, any number of workers."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray

from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.sweep import VALUES, read
from roller_sim_ros.sweep.task import DONE

COMMAND = (sys.executable, "-m", "roller_sim_ros.commands", "sweep")
SMALL = ("--half-space", "two-pole", "--revolutions", "120")
MAP = (*SMALL, "--frequency-hz", "20:35:4", "--amplitude-mm", "0.5,1.6,2.4")


def sweep(*arguments: str | Path, code: int = 0) -> subprocess.CompletedProcess[str]:
    result = subprocess.run(
        [*COMMAND, *map(str, arguments)], capture_output=True, text=True, timeout=240
    )
    assert result.returncode == code, result.stderr
    return result


def assert_equal(one: Path, other: Path) -> None:
    """Same numbers to the last bit, also those that are not there."""
    here, there = read(one), read(other)
    assert here.plan == there.plan
    for name, array in here.arrays.items():
        np.testing.assert_array_equal(array, there.arrays[name], err_msg=name)


def test_the_file_is_labelled_and_complete(tmp_path: Path) -> None:
    path = tmp_path / "map.nc"
    result = sweep(*MAP, "--out", path, "--quality-factor", "0.5")
    assert result.stderr == ""
    assert result.stdout.startswith(f"{path}: 12 points, 4 frequency_hz × 3 amplitude_m, ")
    assert "partial uplift" in result.stdout
    with xarray.open_dataset(path) as data:
        assert data.sizes == {"frequency_hz": 4, "amplitude_m": 3}
        np.testing.assert_array_equal(data.frequency_hz, [20.0, 25.0, 30.0, 35.0])
        np.testing.assert_array_equal(data.amplitude_m, [0.5e-3, 1.6e-3, 2.4e-3])
        assert data.amplitude_m.units == "m"
        assert data.amplitude_m.parameter == "exciter.amplitude_m"
        for value in VALUES:
            variable = data[value.name]
            assert (variable.dims, variable.units) == (("frequency_hz", "amplitude_m"), value.unit)
            assert variable.long_name
            assert not np.any(np.isnan(variable)), value.name
        labels = data.mode.flag_meanings.split()
        modes = {labels[int(mode)] for mode in np.unique(data.mode)}
        assert {"partial_uplift", "double_jump"} <= modes
        axes = {"exciter.frequency_hz", "exciter.amplitude_m"}
        assert set(PARAMETERS) - axes <= set(data.attrs)
        assert data.attrs["half_space.quality_factor"] == 0.5
        assert data.attrs["half_space.model"] == "two-pole"
        assert '"machine.drum_mass_kg": "kg"' in data.attrs["parameter_units"]
        # The motion of Figure 15's kind, not only numbers of the right shape.
        assert float(data.sel(frequency_hz=35.0, amplitude_m=2.4e-3).force_ratio_max) > 2.0


def test_any_number_of_workers_gives_the_same_numbers(tmp_path: Path) -> None:
    # More points than lanes and than a task has, so that they are shared out differently.
    several = (*SMALL, "--frequency-hz", "20:35:20", "--amplitude-mm", "0.5:2.4:15")
    for workers in ("1", "2", "5"):
        sweep(*several, "--workers", workers, "--out", tmp_path / f"{workers}.nc")
    assert_equal(tmp_path / "1.nc", tmp_path / "2.nc")
    assert_equal(tmp_path / "1.nc", tmp_path / "5.nc")


def test_what_is_done_survives_an_interruption(tmp_path: Path) -> None:
    path, whole = tmp_path / "map.nc", tmp_path / "whole.nc"
    arguments = (
        *("--half-space", "two-pole", "--revolutions", "300", "--all-revolutions"),
        *("--frequency-hz", "20:35:40", "--amplitude-mm", "0.5:2.4:30"),
    )
    command = [*COMMAND, *arguments, "--workers", "1", "--progress", "--out", str(path)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, bufsize=1) as process:
        assert process.stderr is not None
        shown = ""
        while not re.search(r" [1-9]\d*/1200 ", shown):
            shown += process.stderr.read(1)
        process.send_signal(signal.SIGINT)
        said = process.stderr.read()
    # The bar tells how long it still takes.
    assert re.search(r"\d+/1200 \[\d+:\d+<\d+:\d+, .*point", shown + said)
    assert process.returncode == 130
    assert "Traceback" not in said
    done = read(path).points_done
    assert 0 < done < 1200
    assert f"{done} of 1200 points are in {path}; go on with --resume" in said

    result = sweep(*arguments, "--resume", "--out", path)
    assert "1200 points" in result.stdout
    sweep(*arguments, "--out", whole)
    assert_equal(path, whole)


def test_what_is_done_survives_being_killed(tmp_path: Path) -> None:
    # Nothing is left of a file that was being written; saved results stay whole.
    path = tmp_path / "map.nc"
    sweep(*MAP, "--out", path)
    before = path.read_bytes()
    much = ("--frequency-hz", "20:35:300", "--revolutions", "20000", "--all-revolutions")
    command = [*COMMAND, *much, "--progress", "--force", "--out", str(path)]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, bufsize=1) as process:
        assert process.stderr is not None
        shown = ""
        while not re.search(r" [1-9]\d*/300 ", shown):
            shown += process.stderr.read(1)
        process.kill()
    assert path.read_bytes() == before


def test_resuming_what_is_complete_or_not_begun(tmp_path: Path) -> None:
    path = tmp_path / "map.nc"
    sweep(*MAP, "--resume", "--out", path)
    before = read(path)
    sweep(*MAP, "--resume", "--out", path)
    np.testing.assert_array_equal(read(path).arrays["cmv"], before.arrays["cmv"])


def test_only_missing_points_are_computed(tmp_path: Path) -> None:
    path = tmp_path / "map.nc"
    sweep(*MAP, "--out", path)
    with netCDF4.Dataset(path, "a") as file:
        file.set_auto_mask(False)
        file["cmv"][:] = 1.0
        file[DONE][2, 1] = 0
    sweep(*MAP, "--resume", "--out", path)
    cmv = read(path).arrays["cmv"]
    assert np.count_nonzero(cmv != 1.0) == 1
    assert cmv[2, 1] > 2.0


def test_continuing_up_and_down_an_axis(tmp_path: Path) -> None:
    line = (
        *("--half-space", "two-pole", "--shear-modulus-mpa", "80", "--plastic-mm", "0.5"),
        *("--amplitude-mm", "0.4:2.4:21", "--revolutions", "200"),
    )
    for direction in ("up", "down"):
        sweep(*line, "--continue", direction, "--out", tmp_path / f"{direction}.nc")
    up, down = read(tmp_path / "up.nc"), read(tmp_path / "down.nc")
    assert up.plan.continuation is not None
    assert up.plan.continuation.axis == "exciter.amplitude_m"
    assert np.any(np.abs(up.arrays["cmv"] - down.arrays["cmv"]) > 1.0)
    sweep(
        *line,
        *("--frequency-hz", "27,28", "--continue", "up", "--along", "amplitude-mm"),
        *("--out", tmp_path / "both.nc"),
    )
    both = read(tmp_path / "both.nc")
    assert both.points_done == 42
    np.testing.assert_allclose(both.arrays["cmv"][1], up.arrays["cmv"], rtol=1e-9)


def test_help_names_every_axis_with_its_unit() -> None:
    text = sweep("--help").stdout
    for flag in ("--frequency-hz HZ", "--amplitude-mm MM", "--shear-modulus-mpa MPA"):
        assert f"{flag}[,…|:…:N]" in text
    assert "--drum-mass-kg" in text
    assert "roller-sim sweep --frequency-hz 15:40:101" in text


@pytest.mark.parametrize("model", ["exact", "rational"])
def test_the_other_half_spaces(model: str, tmp_path: Path) -> None:
    path = tmp_path / "map.nc"
    sweep("--half-space", model, "--frequency-hz", "28,30", "--revolutions", "100", "--out", path)
    assert read(path).points_done == 2
