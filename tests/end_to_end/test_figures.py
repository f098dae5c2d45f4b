# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""roller-sim figures: files, captions and data of every figure, and what it refuses."""

from __future__ import annotations

import csv
import xml.etree.ElementTree
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from roller_sim_ros import commands
from roller_sim_ros.figures.registry import FIGURES, Entry
from roller_sim_ros.parameters import Configuration, covarying_plastic_parameter
from roller_sim_ros.sweep import values_at

OF_THE_PAPER = ("2", "5", "6", "7", "8", "10", "14", "15", "16", "17", "18", "19", "20")
MODEL = "two-pole"
RESOLUTION = 7
DRAWN = [entry for entry in FIGURES if entry.default]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """All figures that are drawn by default, coarse, with one half space."""
    path = tmp_path_factory.mktemp("figures") / "made" / "here"
    arguments = ["figures", "--out", str(path), "--half-space", MODEL]
    assert commands.main([*arguments, "--resolution", str(RESOLUTION)]) == 0
    return path


def read(path: Path) -> dict[str, list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert rows
    return {name: [row[place] for row in rows] for place, name in enumerate(head)}


def numbers(table: dict[str, list[str]], name: str) -> np.ndarray:
    return np.array([float(text) if text else np.nan for text in table[name]])


def test_the_figures_of_the_paper_are_there() -> None:
    assert tuple(entry.name for entry in DRAWN if entry.name.isdigit()) == OF_THE_PAPER


def test_nothing_else_is_left_in_the_folder(folder: Path) -> None:
    expected = {
        f"{entry.stem(MODEL)}.{ending}" for entry in DRAWN for ending in ("png", "svg", "csv")
    }
    assert {path.name for path in folder.iterdir()} == expected


@pytest.mark.parametrize("entry", DRAWN, ids=lambda entry: entry.name)
def test_each_figure_has_a_picture_a_caption_and_data(folder: Path, entry: Entry) -> None:
    stem = entry.stem(MODEL)
    with Image.open(folder / f"{stem}.png") as picture:
        caption = str(picture.info["Description"])
        colours = picture.convert("RGB").getcolors(maxcolors=1 << 20)
        assert picture.width > 800
    assert colours is not None
    assert len(colours) > 50  # not an empty page
    assert caption.startswith(entry.caption_title())
    if entry.half_space:
        for parameter in ("Half space two-pole (Q = 0.4", "k = 4", "drum 3200 kg", "ν = 0.25"):
            assert parameter in caption
    drawing = xml.etree.ElementTree.parse(folder / f"{stem}.svg").getroot()
    assert drawing.tag.endswith("svg")
    table = read(folder / f"{stem}.csv")
    lengths = {len(column) for column in table.values()}
    assert len(lengths) == 1
    known = [any(text not in {"", "nan"} for text in column) for column in table.values()]
    assert all(known)


def test_maps_are_over_one_plane(folder: Path) -> None:
    tables = [read(folder / f"figure_{number}_two_pole.csv") for number in (16, 18, 20)]
    for table in tables:
        assert len(table["frequency_Hz"]) == RESOLUTION**2
        for axis, bounds in (("frequency_Hz", (15.0, 40.0)), ("amplitude_mm", (0.1, 2.5))):
            assert table[axis] == tables[0][axis]
            values = numbers(table, axis)
            assert (values.min(), values.max()) == bounds


def test_whole_numbers_are_written_as_such(folder: Path) -> None:
    assert set(read(folder / "figure_16_two_pole.csv")["period_revolutions"]) <= set("01248")


def test_data_are_those_of_the_model(folder: Path) -> None:
    table = read(folder / "figure_19_two_pole.csv")
    row = int(len(table["cmv"]) * 0.8)
    modulus = numbers(table, "G_MPa")[row] * 1e6
    values = {
        "half_space.model": MODEL,
        "soil.shear_modulus_pa": modulus,
        "soil.plastic_parameter_m": covarying_plastic_parameter(modulus),
        "exciter.amplitude_m": float(table["amplitude_mm"][row]) * 1e-3,
    }
    found = values_at([Configuration().changed(values)], 500)
    assert numbers(table, "cmv")[row] == pytest.approx(found["cmv"][0], rel=1e-3)


def test_the_static_load_is_within_every_loop_of_figure_17(folder: Path) -> None:
    table = read(folder / "figure_17_two_pole.csv")
    force, ground = numbers(table, "soil_force_kN"), np.array(table["ground"])
    static = Configuration().machine.static_load_n / 1e3
    assert len(set(ground)) == 4
    for name in set(ground):
        assert force[ground == name].min() < static < force[ground == name].max()


def test_one_figure_with_both_half_spaces(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["figures", "10", "--out", str(tmp_path), "--half-space", "exact"]
    assert commands.main([*arguments, "--half-space", MODEL]) == 0
    assert {path.stem for path in tmp_path.iterdir()} == {"figure_10_exact", "figure_10_two_pole"}
    assert "figure_10_exact.png, svg, csv" in capsys.readouterr().out
    exact, other = (
        numbers(read(tmp_path / f"figure_10_{name}.csv"), "vertical_g")
        for name in ("exact", "two_pole")
    )
    assert 0.01 < np.abs(exact - other).max() < 3.0


def test_the_same_figure_has_the_same_bytes(folder: Path, tmp_path: Path) -> None:
    assert commands.main(["figures", "5", "--out", str(tmp_path), "--half-space", MODEL]) == 0
    for ending in ("png", "svg", "csv"):
        name = f"figure_05.{ending}"
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes()


def refused(capsys: pytest.CaptureFixture[str], *arguments: str, code: int = 1) -> str:
    """Return the last line that is said."""
    try:
        found = commands.main(["figures", *arguments])
    except SystemExit as left:
        found = int(left.code or 0)
    output = capsys.readouterr()
    assert found == code
    assert output.out == ""
    line = output.err.strip().splitlines()[-1]
    assert line.startswith("roller-sim figures: error: ")
    return line.removeprefix("roller-sim figures: error: ")


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (("3",), 1, "no figure '3'; there are 2, 5, 6, 7,"),
        (("16", "sixteen"), 1, "no figure 'sixteen'"),
        (("16", "--half-space", "hard"), 2, "invalid choice: 'hard'"),
        (("16", "--resolution", "2"), 2, "2 is less than 6"),
        (("16", "--resolution", "fine"), 2, "invalid _resolution value: 'fine'"),
        (("16", "--workers", "0"), 2, "0 is less than 1"),
    ],
)
def test_what_cannot_be_drawn(
    arguments: tuple[str, ...],
    code: int,
    says: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = tmp_path / "out"
    assert says in refused(capsys, *arguments, "--out", str(out), code=code)
    assert not out.exists()


def test_places_that_cannot_be_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "file"
    file.write_text("kept")
    for out in (file, file / "below"):
        said = refused(capsys, "5", "--out", str(out))
        assert said.startswith(f"{out}: cannot be written into: ")
    assert file.read_text() == "kept"


def test_a_picture_that_cannot_be_replaced(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "figure_05.png").mkdir()
    said = refused(capsys, "5", "--out", str(tmp_path))
    assert said.startswith(f"{tmp_path / 'figure_05.png'}: cannot be written: ")
    assert [path.name for path in tmp_path.iterdir()] == ["figure_05.png"]


def test_stems_are_distinct() -> None:
    stems = {entry.stem(model) for entry in FIGURES for model in ("exact", "two-pole")}
    assert len(stems) == sum(1 + entry.half_space for entry in FIGURES)
