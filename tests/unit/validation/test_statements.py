# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements of the paper: that they can fail, what they are made from, and that the page is not stale."""

from __future__ import annotations

import importlib
import importlib.util
import re
import shlex
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
import xarray

from roller_sim_ros.figures.registry import FIGURES
from roller_sim_ros.offline.run import Tail
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session.block import AIR, LOADING
from roller_sim_ros.validation import cases, half_spaces, planes
from roller_sim_ros.validation.ground import circle_over_parabola
from roller_sim_ros.validation.registry import STATEMENTS
from roller_sim_ros.validation.statement import Verdict, percent
from roller_sim_ros.validation.study import STIFF, Study, covarying, point, spaced
from tools import markdown_table

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")

FRESH = (
    "linear_plastic_layer",
    "weak_is_plastic",
    "influence_formula",
    "shape_counts",
    "effective_radii",
    "quality_factor",
    "lag",
    "double_jump",
    "peak_of_double_jump",
    "full_cycle_in_the_air",
    "no_flight",
    "fresh_soil",
)
"""Statements that are computed again here: those without maps."""


@pytest.fixture(scope="module")
def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("validation", ROOT / "tools" / "validation.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def with_half_space(model: str, **values: float) -> Study:
    study = Study.of(model)
    return replace(
        study,
        base=replace(study.base, half_space=replace(study.base.half_space, **values)),  # type: ignore[arg-type]
    )


def test_keys_are_distinct_and_rows_in_order() -> None:
    keys = [statement.key for statement in STATEMENTS]
    assert len(set(keys)) == len(keys)
    assert re.findall(r"^\|.*\| `(\w+)` \|$", PAGE, flags=re.MULTILINE) == keys


@pytest.mark.parametrize("key", FRESH)
def test_rows_of_the_page_are_what_comes_out(tool: ModuleType, key: str) -> None:
    (statement,) = [statement for statement in STATEMENTS if statement.key == key]
    assert markdown_table.row(tool.row(statement)) in PAGE


def test_unknown_statements_are_refused(
    tool: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    assert tool.main(["double_jumps"]) == 2
    assert "no statement 'double_jumps'; there are linear_plastic_layer" in capsys.readouterr().err


def test_what_does_not_come_out_is_explained_on_the_page() -> None:
    for line in PAGE.splitlines():
        key = re.search(r"\| `(\w+)` \|$", line)
        if key and re.search(r"\*\*(partly|does not)\*\*", line):
            assert f"`{key.group(1)}`" in PAGE.replace(line, ""), key.group(1)


@pytest.mark.parametrize(
    "command", sorted({statement.command for statement in STATEMENTS if statement.command})
)
def test_the_commands_of_the_page_exist(command: str) -> None:
    name, *arguments = shlex.split(command)
    if name == "figures":
        assert set(arguments) <= {entry.name for entry in FIGURES}
    else:
        # What the parser does not know, it refuses.
        importlib.import_module(f"roller_sim_ros.commands.{name}")._parser().parse_args(arguments)


@pytest.mark.parametrize(
    ("check", "study", "verdict"),
    [
        (cases.double_jump, with_half_space("exact", area_factor=4.0), Verdict.HOLDS),
        (cases.double_jump, with_half_space("exact", area_factor=2.0), Verdict.PARTLY),
        (cases.peak_of_double_jump, with_half_space("exact", area_factor=8.0), Verdict.FAILS),
        (cases.stable_on_soft, with_half_space("two-pole", quality_factor=0.8), Verdict.FAILS),
    ],
)
def test_statements_can_fail(check: object, study: Study, verdict: Verdict) -> None:
    assert callable(check)
    assert check(study).verdict is verdict


def tail(contact: list[int], samples: int = 4) -> Tail:
    count = len(contact)
    zeros = np.zeros(count)
    return Tail(
        samples_per_revolution=samples,
        duration_s=1.0,
        excitation_hz=np.full(count // samples, 28.0),
        synchronous=True,
        vertical=zeros,
        soil_force=zeros,
        drum_height=zeros,
        contact_state=np.array(contact, dtype=np.uint8),
    )


@pytest.mark.parametrize(
    ("contact", "revolutions"),
    [
        ([LOADING] * 8, 0.0),
        ([AIR, LOADING, LOADING, LOADING, LOADING, LOADING, AIR, AIR], 0.75),
        ([LOADING, AIR, AIR, AIR, AIR, AIR, AIR, LOADING], 1.5),
    ],
)
def test_longest_flight(contact: list[int], revolutions: float) -> None:
    # The window's ends divide no flight.
    assert cases.longest_flight(tail(contact)) == revolutions


def test_order_amplitude_of_a_sum_of_waves() -> None:
    turns = np.arange(64) / 16
    wave = 3.0 * np.sin(2 * np.pi * turns) + 2.0 * np.cos(np.pi * turns)
    assert cases.order_amplitude(wave, 1.0, 16) == pytest.approx(3.0)
    assert cases.order_amplitude(wave, 0.5, 16) == pytest.approx(2.0)


def a_plane(period: np.ndarray, k_s: np.ndarray | None = None) -> xarray.Dataset:
    frequencies, amplitudes = period.shape
    mode = np.where(period == 1, 2, np.where(period == 2, 3, np.where(period == 4, 4, 5)))
    dimensions = ("frequency_hz", "amplitude_m")
    return xarray.Dataset(
        {
            "period": (dimensions, period),
            "mode": (dimensions, mode),
            "k_s": (dimensions, np.zeros(period.shape) if k_s is None else k_s),
        },
        {
            "frequency_hz": np.linspace(15.0, 40.0, frequencies),
            "amplitude_m": np.linspace(0.1e-3, 2.5e-3, amplitudes),
        },
        {"machine.drum_mass_kg": 3200.0},
    )


def test_first_amplitudes_and_the_region_of_longer_periods() -> None:
    period = np.ones((6, 8))
    period[1, 4:6] = 4
    period[2, 4:6] = 0
    period[4, 2:] = 2
    period[4, 5:] = 0
    found = a_plane(period)
    first = planes.first_amplitudes(found, (2,))
    assert np.isnan(first[:4]).all()
    assert first[4] == found.amplitude_m.values[2]
    region = planes.longer_periods(found)
    assert region.any()
    assert np.array_equal(np.flatnonzero(region.any(axis=1)), [1, 2])
    assert not planes.longer_periods(a_plane(np.ones((6, 8)))).any()


def test_resonance_is_where_stiffness_and_inertia_meet() -> None:
    period = np.ones((51, 3))
    frequency = np.linspace(15.0, 40.0, 51)
    inertia = 3200.0 * (2.0 * np.pi * frequency) ** 2
    # A constant stiffness meets the inertia at 20.3 Hz; none is met at 50 Hz.
    stiffness = np.array(
        [3200.0 * (2.0 * np.pi * 20.3) ** 2, 3200.0 * (2.0 * np.pi * 50.0) ** 2, np.nan]
    )
    at = planes.resonance(a_plane(period, np.broadcast_to(stiffness, period.shape)))
    assert at[0] == pytest.approx(20.3, abs=0.01)
    assert np.isnan(at[1:]).all()
    assert inertia[0] < stiffness[0] < inertia[-1]


def test_compliance_of_each_half_space_is_static_at_rest() -> None:
    values = []
    for model in ("exact", "two-pole", "rational"):
        study = Study.of(model)
        values.append(half_spaces.compliance(study.on(STIFF), np.array([0.0]))[0].real)
    assert values == pytest.approx([values[0]] * 3, rel=1e-9)


def test_the_circle_is_the_parabola_at_the_surface() -> None:
    assert circle_over_parabola(0.0, 0.75) == 1.0
    # At a depth of r the circle's half width is r, the parabola's √2 r.
    assert circle_over_parabola(0.75, 0.75) == pytest.approx(0.5)


def test_the_paper_s_grounds_are_on_the_curve_with_their_own_numbers() -> None:
    assert covarying(80e6) == (80e6, 0.5e-3)
    assert covarying(50e6)[1] == pytest.approx(0.653e-3, rel=1e-3)


def test_points_are_those_of_the_command_line() -> None:
    study = Study.of("two-pole")
    assert study.on(STIFF) == Configuration().changed(
        {
            "half_space.model": "two-pole",
            "soil.shear_modulus_pa": 80e6,
            "soil.plastic_parameter_m": 0.5e-3,
        }
    )
    assert point(study.on(STIFF))["period"] == 2
    assert spaced((15.0, 40.0), 101)[1] == 15.25


def test_shares_in_words() -> None:
    assert percent(0.0314) == "3.1 %"
    assert percent(-0.012) == "−1.2 %"
