# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The package's scenarios, shortened, show what their names say; and the command runs scenarios."""

from __future__ import annotations

import csv
import json
import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.meters import Mode
from roller_sim_ros.offline.scenario_run import run_scenario, step_with_faults
from roller_sim_ros.scenario import Scenario, SiteMap, read_scenario, start_of
from roller_sim_ros.scenario.metadata import SCENARIO
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.site.features import Gradient, HardObject, RandomField, Section, SoftSpot
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import decode

WINDOW = 16


def shipped(name: str) -> Scenario:
    return read_scenario(shipped_scenarios()[name])


def on_lane(scenario: Scenario, length_m: float, cell_m: float = 0.25) -> Scenario:
    return replace(scenario, lane=replace(scenario.lane, length_m=length_m, cell_m=cell_m))


def with_features(scenario: Scenario, *features: Any) -> Scenario:
    return replace(scenario, ground=replace(scenario.ground, features=features))


def feature(scenario: Scenario, kind: type) -> Any:
    (found,) = [it for it in scenario.ground.features if isinstance(it, kind)]
    return found


def site_map(scenario: Scenario) -> SiteMap:
    start = start_of(scenario)
    session = start.session()
    run = run_scenario(scenario, session, step_with_faults(session, start), lambda _: None)
    assert run.finished
    assert run.unsettled_steps == 0
    return run.site_map


def settled(found: SiteMap, since_m: float, to_m: float, number: int = 1) -> SiteMap:
    """The revolutions of a pass whose whole window lies between two chainages."""
    low, high = found.chainage_m, found.chainage_m
    middle = found.window_middle_m
    span = np.abs(found.chainage_m - middle)
    inside = (
        (middle - span >= since_m) & (middle + span <= to_m) & (low >= since_m) & (high <= to_m)
    )
    part = found.pass_number == number
    assert np.any(inside & part)
    return found.where(inside & part)


def test_constant_ground_every_revolution_is_like_the_last() -> None:
    found = site_map(on_lane(shipped("constant_ground"), 5.0))
    assert set(found.pass_number) == {1, 2}
    later = found.where(found.time_s > 2.0)
    assert np.ptp(later.cmv) < 0.5
    assert np.ptp(later.rmv) < 1.0
    assert set(later.mode) == {Mode.PARTIAL_UPLIFT}
    assert set(later.shear_modulus_pa) == {35e6}
    assert abs(found.chainage_m[-1]) < 0.1


def test_soft_to_stiff_cmv_rises_falls_where_the_drum_jumps_and_rises_again() -> None:
    scenario = shipped("soft_to_stiff")
    short = with_features(
        on_lane(scenario, 32.0, 0.1), replace(feature(scenario, Gradient), to_m=32.0)
    )
    found = site_map(short)
    modulus = found.shear_modulus_pa / 1e6
    assert modulus[0] == pytest.approx(25.0, abs=1.0)
    assert modulus[-1] == pytest.approx(80.0, abs=1.0)
    soft = found.where((modulus > 28.0) & (modulus < 38.0))
    assert set(soft.mode) == {Mode.PARTIAL_UPLIFT}
    assert np.corrcoef(soft.shear_modulus_pa, soft.cmv)[0, 1] > 0.99
    assert soft.cmv[-1] - soft.cmv[0] > 8.0
    # Beyond the onset the drum double-jumps and the meter halves on ground that is ever stiffer.
    jumping = found.where(modulus > 44.0)
    assert np.mean(jumping.mode == Mode.DOUBLE_JUMP) > 0.75
    assert jumping.rmv[-1] > 100.0 > 10.0 > soft.rmv[-1]
    peak = float(np.nanmax(found.cmv[modulus < 50.0]))
    lowest = float(np.min(found.cmv[(modulus > 50.0) & (modulus < 60.0)]))
    assert peak > 40.0
    assert lowest < 0.55 * peak
    assert found.cmv[-1] > peak
    # A smaller amplitude never jumps, and its meter goes on rising.
    small = replace(short, exciter=replace(short.exciter, amplitude_mm=0.8))
    calm = site_map(small)
    assert np.nanmax(calm.rmv[28:]) < 5.0
    assert calm.cmv[-1] > 70.0


def test_soft_spot_stands_out_more_with_every_pass_and_the_boulder_less() -> None:
    scenario = shipped("soft_spot")
    short = with_features(
        on_lane(scenario, 16.0),
        feature(scenario, RandomField),
        replace(feature(scenario, SoftSpot), at_m=5.0),
        replace(feature(scenario, HardObject), at_m=11.0),
    )
    found = site_map(short)
    spot, boulder = [], []
    for number in (1, 4):
        part = found.of_pass(number)
        middle = part.window_middle_m
        around = float(np.median(part.cmv[np.isfinite(part.cmv)]))
        spot.append(float(np.nanmin(part.cmv[np.abs(middle - 5.0) < 1.0])) / around)
        boulder.append(float(np.nanmax(part.cmv[np.abs(middle - 11.0) < 1.0])) / around)
    assert spot[1] < spot[0] < 0.75
    assert spot[1] < 0.5
    assert 1.0 < boulder[1] < 0.7 * boulder[0]
    # The ground scatters, and compacts.
    first, last = (found.of_pass(number).shear_modulus_pa for number in (1, 4))
    assert 0.04 < np.std(first[:50]) / np.mean(first[:50]) < 0.2
    assert np.median(last) > 1.5 * np.median(first)


def test_double_jump_onset_comes_with_the_amplitude_alone() -> None:
    found = site_map(shipped("double_jump_onset"))
    assert set(found.shear_modulus_pa) == {60e6}
    assert set(found.chainage_m) == {0.0}
    ends = {
        round(amplitude * 1e3, 1): found.where(found.amplitude_m == amplitude)
        for amplitude in np.unique(found.amplitude_m)
        if np.count_nonzero(found.amplitude_m == amplitude) > 50
    }
    assert sorted(ends) == [0.8, 1.0, 1.2, 1.4, 1.6, 1.8]
    rmv = {amplitude: float(part.rmv[-1]) for amplitude, part in ends.items()}
    assert rmv[0.8] < 0.5
    assert rmv[1.0] < 0.5
    assert 10.0 < rmv[1.2] < rmv[1.4] < rmv[1.6]
    assert rmv[1.6] > 150.0
    assert ends[1.0].mode[-1] == Mode.PARTIAL_UPLIFT
    assert {int(ends[it].mode[-1]) for it in (1.2, 1.4, 1.6)} == {Mode.DOUBLE_JUMP}
    assert ends[1.4].cmv[-1] < 0.75 * ends[1.0].cmv[-1]


def test_ten_passes_to_refusal_cmv_rises_and_falls_when_it_jumps() -> None:
    found = site_map(on_lane(shipped("ten_passes_to_refusal"), 2.5))
    passes = [found.of_pass(number) for number in range(1, 11)]
    modulus = np.array([float(np.median(part.shear_modulus_pa)) / 1e6 for part in passes])
    expected = 56.0 - (56.0 - 22.0) * np.exp(-np.arange(10) / 2.5)
    assert modulus == pytest.approx(expected, rel=1e-3)
    growth = np.diff(modulus)
    assert growth[0] > 10.0
    assert growth[-1] < 0.5
    cmv = np.array([float(np.nanmedian(part.cmv)) for part in passes])
    jumping = np.array([np.mean(part.mode == Mode.DOUBLE_JUMP) for part in passes])
    peak = int(np.argmax(cmv))
    assert 2 <= peak <= 5
    assert (np.diff(cmv[: peak + 1]) > 0.0).all()
    assert cmv.min() == cmv[0] or cmv[peak:].min() < 0.6 * cmv[peak]
    assert cmv[-1] < 0.9 * cmv[peak]
    assert jumping[0] < 0.2
    assert jumping[peak:].min() > 0.5


def test_sensor_failure_campaign_breaks_the_sensor_and_not_the_truth() -> None:
    scenario = on_lane(shipped("sensor_failure_campaign"), 26.5)
    scenario = replace(
        scenario,
        faults=tuple(it for it in scenario.faults if it.from_revolution is None),
        description="",
    )
    emulator = Emulator(start_ns=0, **start_of(scenario)._asdict())
    calm = Emulator(start_ns=0, **start_of(replace(scenario, faults=()))._asdict())
    meter: dict[int, float] = {}
    undisturbed: dict[int, float] = {}
    active: dict[int, str] = {}
    while not emulator.session.site.position.finished:
        revolution = emulator.session.next_sample // 128
        truths = []
        for roller, values in ((emulator, meter), (calm, undisturbed)):
            for message in roller.advance(128):
                if message.topic == "meter":
                    value = decode(message.data, message.type_name)
                    values[value.last_sample // 128] = value.cmv
                elif message.topic == "truth":
                    truths.append(message.data)
        assert truths[0] == truths[1]
        for fault in emulator.instruments.faults.active:
            active[revolution] = fault.fault.group
    assert list(dict.fromkeys(active.values())) == [it.id for it in scenario.faults]
    affected = {name: [r for r, it in active.items() if it == name] for name in active.values()}
    deviation = {
        name: [
            abs(meter.get(r, math.nan) / undisturbed[r] - 1.0) for r in revolutions[WINDOW + 1 :]
        ]
        for name, revolutions in affected.items()
    }
    # What its sensor says is lost or wrong, or harmless, as each fault declares.
    assert all(math.isnan(it) for it in deviation["stuck"])
    assert any(math.isnan(it) for it in deviation["dropout"])
    assert max(deviation["spike"]) > 0.01
    assert max(deviation["gain_change"]) < 0.05
    assert max(deviation["bias_step"]) < 0.05
    # In peace it is right.
    peaceful = [r for r in meter if not any(r - WINDOW - 2 < it <= r for it in active)][WINDOW:]
    assert len(peaceful) > 100
    assert max(abs(meter[r] / undisturbed[r] - 1.0) for r in peaceful) < 0.001


def test_controller_step_test_gives_steps_of_ground_and_of_amplitude() -> None:
    scenario = shipped("controller_step_test")
    section = replace(feature(scenario, Section), from_m=4.0, to_m=8.0)
    last = replace(scenario.exciter.programme[1], to_m=2.0)
    programme = (scenario.exciter.programme[0], last)
    short = replace(
        with_features(on_lane(scenario, 12.0), section),
        exciter=replace(scenario.exciter, programme=programme),
        travel=replace(scenario.travel, turn_s=0.2),
    )
    found = site_map(short)
    soft, stiff, soft_again = (
        settled(found, *stretch) for stretch in ((1.5, 4.0), (5.5, 8.0), (9.5, 12.0))
    )
    assert np.median(stiff.rmv) > 100.0
    assert set(stiff.mode) == {Mode.DOUBLE_JUMP}
    for part in (soft, soft_again):
        assert set(part.mode) == {Mode.PARTIAL_UPLIFT}
        assert np.median(part.cmv) == pytest.approx(37.2, abs=0.5)
    back = settled(found, 5.0, 7.0, number=2)
    assert set(back.amplitude_m) == {0.8e-3}
    assert set(back.mode) == {Mode.PARTIAL_UPLIFT}
    assert set(settled(found, 0.0, 1.0, number=2).amplitude_m) == {1.6e-3}


def test_the_same_seed_gives_the_same_run_and_another_one_another() -> None:
    scenario = on_lane(replace(shipped("soft_spot"), travel=shipped("soft_to_stiff").travel), 3.0)
    first, again, other = (site_map(replace(scenario, seed=seed)) for seed in (7, 7, 8))
    assert np.array_equal(first.cmv, again.cmv, equal_nan=True)
    assert not np.array_equal(first.shear_modulus_pa, other.shear_modulus_pa)


SHORT = """\
title: short
lane: {length_m: 2}
travel: {passes: 2}
ground: {shear_modulus_mpa: 40, compaction: {kind: hyperbolic, limit_shear_modulus_mpa: 60}}
parameters: {half_space.model: two-pole, pacing.samples_per_message: 64}
seed: 5
"""


@pytest.fixture
def short(tmp_path: Path) -> Path:
    path = tmp_path / "short.yaml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def run(*arguments: object) -> int:
    return commands.main(["run", *map(str, arguments)])


def test_the_command_shows_the_passes_and_writes_map_and_trace(
    short: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table, figure, trace = tmp_path / "map.csv", tmp_path / "map.png", tmp_path / "trace.mcap"
    assert run(short, "--map", table, "--record", trace) == 0
    lines = capsys.readouterr().out.splitlines()
    assert re.match(r"short: 11\d revolutions, 4\.0\d s; seed 5", lines[0])
    assert [line.split()[0] for line in lines[1:]] == ["pass", "1", "2"]
    assert run(short, "--map", figure, "--json", "-") == 0
    report = json.loads(capsys.readouterr().out)
    assert report["finished"]
    assert report["scenario"]["seed"] == 5
    assert [it["pass"] for it in report["passes"]] == [1, 2]
    assert report["passes"][1]["shear_modulus_pa"]["mean"] == pytest.approx(46.67e6, rel=1e-3)
    assert report["parameters"]["half_space.model"] == "two-pole"
    assert figure.read_bytes().startswith(b"\x89PNG")
    assert figure.stat().st_size > 20_000
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == report["revolutions"]
    assert rows[0]["cmv"] == ""
    reader = TraceReader(trace)
    assert reader.topics["/site/state"].messages == len(rows) + 1
    states = [
        decode(message.data, "roller_sim_ros/msg/SiteState")
        for message in reader.messages()
        if message.topic == "/site/state"
    ]
    # The trace has one revolution more, in which all is driven.
    assert [it.finished for it in states] == [False] * len(rows) + [True]
    for state, row in zip(states, rows, strict=False):
        assert float(row["chainage_m"]) == state.chainage
        assert float(row["shear_modulus_pa"]) == state.shear_modulus
        assert float(row["cmv"] or "nan") == pytest.approx(state.cmv, nan_ok=True)
        assert int(row["mode"]) == state.mode
    record = reader.metadata[SCENARIO]
    assert record["text"] == SHORT
    assert reader.metadata["roller_sim_ros"]["seed"] == "5"


def test_a_run_can_be_cut_short(short: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(short, "--revolutions", 20) == 0
    assert ", cut short; seed 5" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("flags", "reason"),
    [
        (
            ["--shear-modulus-mpa", "80"],
            "--shear-modulus-mpa = 80000000.0: is said by the scenario",
        ),
        (["--frequency-hz", "30"], "--frequency-hz = 30.0: is said by the scenario"),
        (["--void-ratio", "0.4"], "--void-ratio = 0.4: is said by the scenario"),
        (["--soil", "sand"], "--soil = 'sand': does not go with a scenario"),
        (["--machine", "ca250"], "--machine = 'ca250': does not go with a scenario"),
        (["--plot", "a.png"], "--plot = 'a.png': does not go with a scenario"),
        (["--samples-per-rev", "64", "--record", "a.mcap"], "need 128 samples per revolution"),
    ],
)
def test_flags_that_do_not_go_with_a_scenario_are_refused(
    short: Path, flags: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(short, *flags) == 1
    error = capsys.readouterr().err
    assert reason in error
    assert error.count("\n") == 1


def test_flags_change_what_the_scenario_leaves_open(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "one.yaml"
    path.write_text("lane: {length_m: 1}", encoding="utf-8")
    assert run(path, "--half-space", "two-pole", "--run-up", "--json", "-") == 0
    report = json.loads(capsys.readouterr().out)
    assert report["parameters"]["half_space.model"] == "two-pole"
    assert report["passes"][0]["cmv"]["mean"] is None


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("lane: {lenght_m: 2}\n", 1),
        ("lane: {length_m: 2}\nground:\n  features:\n    - kind: pit\n", 4),
        ("lane: {length_m: 2\n", 2),
        ("lane: {length_m: 2}\nfaults:\n  - id: tired\n", 3),
    ],
)
def test_a_wrong_scenario_is_one_line_with_file_and_line(
    text: str, line: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "wrong.yaml"
    path.write_text(text, encoding="utf-8")
    assert run(path) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"roller-sim run: error: {path}:{line}: ")
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["nowhere.yaml"], "nowhere.yaml: cannot be read"),
        (["soft_to_stif"], "did you mean soft_to_stiff?"),
        (["--map", "map.png"], "--map = 'map.png': needs a scenario"),
    ],
)
def test_scenarios_that_are_not_there_are_told(
    arguments: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*arguments) == 1
    assert reason in capsys.readouterr().err


@pytest.mark.parametrize("name", ["map.png", "map.csv", "map.xyz"])
def test_a_map_that_cannot_be_written_is_told(
    name: str, short: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path if name.endswith("xyz") else tmp_path / "none"
    assert run(short, "--revolutions", 40, "--map", folder / name) == 1
    assert re.search(rf"{name}: cannot be (written|drawn)", capsys.readouterr().err)


def test_the_analysis_of_a_trace_knows_the_tolerance_of_its_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # On this slope the motion repeats within 5 %, not within 1 %.
    path, trace = tmp_path / "slope.yaml", tmp_path / "slope.mcap"
    path.write_text(
        "lane: {length_m: 6}\n"
        "ground: {shear_modulus_mpa: 25, features: [{kind: gradient, shear_modulus_mpa: 38}]}\n"
        "parameters: {meter.period_tolerance: 0.05}\n",
        encoding="utf-8",
    )
    assert run(path, "--record", trace) == 0
    capsys.readouterr()
    assert commands.main(["analyze", str(trace), "--json", "-"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert set(report["recorded_meter"]["disagreements"].values()) == {0}
    assert set(report["truth"]["disagreements"].values()) == {0}
    assert report["periods"]["1"] > 0.9
