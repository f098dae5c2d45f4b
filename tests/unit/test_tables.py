# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The tables of docs/meters.md and docs/soil.md are what the model and the presets say now."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from roller_sim_ros.meters.registry import DRUM_METERS, METERS
from roller_sim_ros.soil_mechanics import MACHINES, SOILS
from tools import generate_tables

ROOT = Path(__file__).resolve().parents[2]


def text(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


def cells(page: str) -> list[list[str]]:
    return [line.strip("|").split("|") for line in page.splitlines() if line.startswith("|")]


def test_tables_are_not_stale() -> None:
    now = generate_tables.contents()
    assert now["docs/soil.md"] == text("docs/soil.md")
    # The last digits of a settled motion may differ from machine to machine.
    found, expected = cells(text("docs/meters.md")), cells(now["docs/meters.md"])
    assert len(found) == len(expected)
    for row, other in zip(found, expected, strict=True):
        for cell, fresh in zip(row, other, strict=True):
            if re.fullmatch(r" *-?[\d.]+ *", fresh):
                assert float(cell) == pytest.approx(float(fresh), rel=0.02, abs=1.0), (row, other)
            else:
                assert cell == fresh


def test_every_meter_and_every_preset_is_there_with_its_source() -> None:
    meters, soil = text("docs/meters.md"), text("docs/soil.md")
    for meter in (*METERS, *DRUM_METERS):
        assert f"- **{meter.label}**" in meters
        assert f"| {meter.label} | {meter.unit or '–'} |" in meters
        assert f"| {meter.source} | {'yes' if meter.verified else 'no'} |" in meters
    for preset in (*SOILS.values(), *MACHINES.values()):
        (row,) = [line for line in soil.splitlines() if line.startswith(f"| `{preset.name}` |")]
        assert row.endswith(f"| {preset.source} | {'yes' if preset.verified else 'no'} |")


def test_what_the_page_says_of_double_jump_is_in_its_table() -> None:
    rows = {
        (row[0].strip(), row[1].strip()): [cell.strip() for cell in row[3:]]
        for row in cells(text("docs/meters.md"))
        if row[0].strip() in ("0.8", "1.6")
    }
    before, jumping = rows["1.6", "45"], rows["1.6", "55"]
    cmv, rmv, ccv, omega, e_vib, k_s = ((float(before[i]), float(jumping[i])) for i in range(1, 7))
    assert jumping[0] == "double jump"
    assert 0.6 < cmv[1] / cmv[0] < 0.72
    assert k_s[1] < 0.5 * k_s[0]
    assert ccv[1] > 1.5 * ccv[0]
    assert omega[1] < omega[0]
    assert rmv[1] > 100.0
    assert e_vib[1] > e_vib[0]
    for modulus in ("15", "25", "35", "45", "55", "65", "80", "100", "120"):
        gentle, rough = rows["0.8", modulus], rows["1.6", modulus]
        assert float(rough[5]) > 0.8 * float(gentle[5])
        assert int(modulus) < 55 or float(rough[1]) < float(gentle[1])


def test_check_finds_a_changed_number_and_writing_mends_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = tmp_path / "docs" / "soil.md"
    page.parent.mkdir()
    page.write_text(text("docs/soil.md").replace("| 7.12 |", "| 7.21 |"), encoding="utf-8")
    monkeypatch.setattr(generate_tables, "ROOT", tmp_path)
    monkeypatch.setattr(
        generate_tables, "PAGES", {"docs/soil.md": generate_tables.PAGES["docs/soil.md"]}
    )
    assert generate_tables.main(["--check"]) == 1
    assert generate_tables.main([]) == 0
    assert page.read_text(encoding="utf-8") == text("docs/soil.md")
    assert generate_tables.main(["--check"]) == 0
    page.write_text("nothing\n", encoding="utf-8")
    with pytest.raises(SystemExit, match="has no part <!-- written: soils -->"):
        generate_tables.main([])
