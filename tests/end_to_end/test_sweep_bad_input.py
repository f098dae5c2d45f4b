# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What roller-sim sweep refuses: one clear line, a code that is not 0, and nothing overwritten."""

from __future__ import annotations

from pathlib import Path

import netCDF4
import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.sweep import Axis, Grid, Plan, Results, write
from roller_sim_ros.sweep.results import FORMAT_ATTRIBUTE, PLAN_ATTRIBUTE

AXIS = ("--frequency-hz", "28,30")
QUICK = ("--half-space", "two-pole", "--revolutions", "20")


def refused(capsys: pytest.CaptureFixture[str], *arguments: str | Path, code: int = 1) -> str:
    """Return the one line that is said."""
    try:
        found = commands.main(["sweep", *map(str, arguments)])
    except SystemExit as left:
        found = int(left.code or 0)
    output = capsys.readouterr()
    assert found == code
    assert output.out == ""
    assert output.err.count("\n") == 1, output.err
    assert output.err.startswith("roller-sim sweep: error: ")
    return output.err.removeprefix("roller-sim sweep: error: ").strip()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "the grid has no axis"),
        (
            ("--frequency-hz", "15:40:0"),
            "--frequency-hz 15:40:0: a grid with 0 values has no points",
        ),
        (("--frequency-hz", "15:40"), "a range is first:last:count"),
        (("--frequency-hz", "28kHz,30"), "'28kHz' is no number of Hz"),
        (("--frequency-hz", "28000,30000"), "--frequency-hz = 28000.0: must be 0 … 80 Hz"),
        (("--amplitude-mm", "0.1:2.5:3", "--frequency-hz", "28,28"), "28.0 twice"),
        ((*AXIS, "--along", "frequency-hz"), "say --continue up or --continue down too"),
        ((*AXIS, "--continue", "up", "--along", "speed"), "--along speed: there is no such axis"),
        (
            (*AXIS, "--amplitude-mm", "1,2", "--continue", "up"),
            "say along which axis, as in --along NAME; there are frequency-hz, amplitude-mm",
        ),
        (
            ("--drum-mass-kg", "3000,3200", "--continue", "up"),
            "cannot change while the roller runs",
        ),
        (("--drum-mass-kg", "3000,3200", "--soil", "dense-gravel"), "another p under each machine"),
        ((*AXIS, "--revolutions", "1"), "1 revolutions: must be at least 2"),
        ((*AXIS, "--params", "nowhere.yaml"), "nowhere.yaml: cannot be read"),
        ((*AXIS, "--soil", "porridge"), "porridge"),
    ],
)
def test_what_cannot_be_swept(
    arguments: tuple[str, ...], says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "map.nc"
    assert says in refused(capsys, *arguments, "--out", path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (("--frequency-khz", "15:40:3"), "unrecognized arguments: --frequency-khz"),
        (("--frequency", "15:40:3"), "unrecognized arguments: --frequency"),
        ((*AXIS, "--continue", "left"), "invalid choice: 'left'"),
        ((*AXIS, "--half-space", "soft,hard"), "must be one of"),
        ((*AXIS, "--workers", "0"), "0 is less than 1"),
        ((*AXIS, "--resume", "--force"), "not allowed with argument"),
        ((*AXIS, "--record", "trace.mcap"), "unrecognized arguments: --record"),
    ],
)
def test_what_is_no_command_line(
    arguments: tuple[str, ...], says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "map.nc"
    code = 1 if "--half-space" in arguments else 2
    assert says in refused(capsys, *arguments, "--out", path, code=code)
    assert not path.exists()


def test_a_sweep_needs_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    assert "required: --out" in refused(capsys, *AXIS, code=2)


def a_sweep(path: Path, *values: float) -> bytes:
    """Write an empty sweep file and return its bytes."""
    write(Results.none_of(Plan(Grid((Axis("exciter.frequency_hz", values),)))), path)
    return path.read_bytes()


def test_a_file_is_not_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "map.nc"
    before = a_sweep(path, 20.0, 21.0)
    said = refused(capsys, *AXIS, *QUICK, "--out", path)
    assert said == f"{path}: exists; go on with it by --resume or replace it by --force"
    assert path.read_bytes() == before
    assert commands.main(["sweep", *AXIS, *QUICK, "--force", "--out", str(path)]) == 0
    assert path.read_bytes() != before


def test_another_sweep_is_not_gone_on_with(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "map.nc"
    before = a_sweep(path, 20.0, 21.0)
    said = refused(capsys, *AXIS, "--resume", "--out", path)
    assert said == (
        f"{path}: is another sweep, which --resume cannot go on with: axis exciter.frequency_hz: "
        "2 values, 20.0 … 21.0, asked for 2 values, 28.0 … 30.0"
    )
    assert path.read_bytes() == before


def test_files_of_another_kind_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = tmp_path / "text.nc"
    text.write_text("not netCDF at all")
    assert "cannot be read as netCDF" in refused(capsys, *AXIS, "--resume", "--out", text)
    foreign = tmp_path / "foreign.nc"
    with netCDF4.Dataset(foreign, "w") as file:
        file.createDimension("x", 3)
    assert refused(capsys, *AXIS, "--resume", "--out", foreign).endswith(
        "is no file of roller-sim sweep"
    )
    cut = tmp_path / "cut.nc"
    whole = a_sweep(cut, 28.0, 30.0)
    cut.write_bytes(whole[: len(whole) // 2])
    assert "cannot be read as netCDF" in refused(capsys, *AXIS, "--resume", "--out", cut)
    assert text.read_text() == "not netCDF at all"
    assert cut.read_bytes() == whole[: len(whole) // 2]


def test_another_version_of_the_format_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "map.nc"
    a_sweep(path, 28.0, 30.0)
    with netCDF4.Dataset(path, "a") as file:
        file.setncattr(FORMAT_ATTRIBUTE, np.int32(99))
    before = path.read_bytes()
    said = refused(capsys, *AXIS, "--resume", "--out", path)
    assert said == f"{path}: has version 99 of the sweep format; this program knows version 1"
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("plan", "says"),
    [
        ("{", "is damaged or incomplete"),
        ("[]", "is damaged or incomplete"),
        ('{"axes": {"exciter.speed": [1, 2]}, "parameters": {}}', "does not fit this program"),
    ],
)
def test_damaged_files_are_refused(
    plan: str, says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "map.nc"
    a_sweep(path, 28.0, 30.0)
    with netCDF4.Dataset(path, "a") as file:
        file.setncattr(PLAN_ATTRIBUTE, plan)
    assert says in refused(capsys, *AXIS, "--resume", "--out", path)


def test_places_that_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert refused(capsys, *AXIS, "--out", tmp_path).endswith("is a folder")
    path = tmp_path / "nowhere" / "map.nc"
    assert refused(capsys, *AXIS, "--out", path).endswith("its folder does not exist")


def test_schedulers_that_are_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "map.nc"
    said = refused(capsys, *AXIS, "--scheduler", "tcp://127.0.0.1:1", "--out", path)
    assert said.startswith("--scheduler tcp://127.0.0.1:1: cannot be reached")
    assert "unknown://x" in refused(capsys, *AXIS, "--scheduler", "unknown://x", "--out", path)
    assert not path.exists()
