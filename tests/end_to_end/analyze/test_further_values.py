# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""CCV, Omega, E_vib and k_s of a bag: anew from the samples and the machine's facts, beside the recorded ones."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from roller_sim_ros.commands.analyze import main
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.offline.recording import record_steps
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message, machine_facts
from roller_sim_ros.wire.types import decode

N, BLOCK, REVOLUTIONS, WINDOW = 128, 16, 160, 16
START_NS = 1_700_000_000_000_000_000
COLUMNS = ("ccv", "omega_j", "e_vib_pa", "k_s_n_m")
NEED_MACHINE = COLUMNS[1:]
ALONE = tuple(topic.name for topic in topics.FURTHER_METERS)

Bag = Callable[..., Path]


def report(capsys: pytest.CaptureFixture[str], *arguments: object) -> dict[str, Any]:
    assert main([*map(str, arguments), "--json", "-"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def recorded_last(run: list[Message]) -> dict[str, float]:
    """The last value on each topic, by its column."""
    last = {
        item.topic: float(decode(item.data, item.type_name).data)
        for item in run
        if item.topic in ALONE
    }
    return {column: last[topic] for column, topic in zip(COLUMNS, ALONE, strict=True)}


def without(run: list[Message], *names: str) -> list[Message]:
    return [item for item in run if item.topic not in {topics.IMU.name, *names}]


def test_values_are_those_recorded_to_the_last_bit(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    found = report(capsys, bag())
    compared = found["recorded_further"]
    assert compared["pairs"] == 4 * REVOLUTIONS
    assert compared["max_difference"] == {"ccv": 0.0, "omega": 0.0, "e_vib": 0.0, "k_s": 0.0}
    assert set(compared["one_unknown"].values()) == {0}
    assert compared["unmatched"] == compared["window_incomplete"] == 0
    for column, last in recorded_last(run).items():
        assert found[column]["last"] == last
        # Partial uplift on soft ground at first, double jump on stiff ground in the end.
        assert 0.0 < found[column]["min"] < 0.9 * found[column]["max"]
    assert found["settled"]["ccv"] == pytest.approx(found["ccv"]["last"], rel=0.01)


def test_table_and_csv_have_them_with_their_units(
    bag: Bag, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = bag()
    assert main([str(folder), "--csv", str(tmp_path / "out.csv")]) == 0
    table = {line.split("  ")[0]: line for line in capsys.readouterr().out.splitlines()}
    assert table["Omega"].endswith(" J")
    assert table["E_vib"].endswith(" MPa")
    assert table["k_s"].endswith(" MN/m")
    assert "e vib within 0, k s within 0" in table["other values"]
    found = report(capsys, folder)
    with (tmp_path / "out.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for column in COLUMNS:
        assert [row[column] for row in rows[: WINDOW - 1]] == [""] * (WINDOW - 1)
        assert float(rows[-1][column]) == found[column]["last"]
    assert f"{found['e_vib_pa']['last'] / 1e6:.2f}" in table["E_vib"]


@pytest.mark.parametrize("gone", ["machine", "one parameter", "a number"])
def test_machine_that_is_not_stated_in_full_gives_no_values_of_its_own(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str], gone: str
) -> None:
    messages = without(run, "machine")
    if gone != "machine":
        facts = machine_facts(Configuration(), START_NS)
        before, after = {
            "one parameter": (b"machine.drum_mass_kg", b"machine.drum_mess_kg"),
            "a number": (b"3200.0", b"32OO.0"),
        }[gone]
        assert facts.data.count(before) == 1
        messages = [facts._replace(data=facts.data.replace(before, after)), *messages]
    found = report(capsys, bag(messages))
    assert [found[column] for column in NEED_MACHINE] == [None, None, None]
    assert found["ccv"]["last"] > 0.0
    assert found["recorded_further"]["max_difference"]["ccv"] == 0.0
    assert found["recorded_further"]["one_unknown"]["omega"] == REVOLUTIONS - WINDOW + 1


def test_amplitude_is_that_of_the_parameters_when_the_exciter_says_nothing(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    found = report(capsys, bag(without(run, "exciter/state")))
    assert {column: found[column]["last"] for column in COLUMNS} == recorded_last(run)


def test_amplitude_is_not_guessed_before_the_exciter_tells_it(
    bag: Bag, run: list[Message], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    late = START_NS + round(20.5 / 28.0 * 1e9)
    kept = [
        item
        for item in without(run, "truth")
        if item.topic != "exciter/state" or item.stamp_ns > late
    ]
    assert main([str(bag(kept)), "--csv", str(tmp_path / "out.csv")]) == 0
    capsys.readouterr()
    with (tmp_path / "out.csv").open(newline="") as file:
        known = [bool(row["k_s_n_m"]) for row in csv.DictReader(file)]
    # Told ten times a second, the first time after revolution 20 within the next three.
    first = known.index(True)
    assert 20 + WINDOW - 1 < first <= 23 + WINDOW
    assert all(known[first:])


def test_imu_stream_has_no_phase_and_so_only_ccv(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    found = report(capsys, bag(run), "--topic", "/drum/imu")
    assert [found[column] for column in NEED_MACHINE] == [None, None, None]
    assert found["ccv"]["last"] == pytest.approx(recorded_last(run)["ccv"], rel=1e-4)


def test_trace_of_an_exciter_that_runs_up_and_changes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    configuration = Configuration().changed(
        {"exciter.amplitude_rate_m_per_s": 0.01, "exciter.frequency_rate_hz_per_s": 100.0}
    )
    path = tmp_path / "trace.mcap"
    with record_steps(configuration, path, start_ns=START_NS, run_up=True) as step:
        for _ in range(80 * N // BLOCK):
            step()
    found = report(capsys, path)
    compared = found["recorded_further"]
    assert set(compared["max_difference"].values()) == {0.0}
    assert set(compared["one_unknown"].values()) == {0}
    assert 0 < found["values_known"] < 80
    assert found["k_s_n_m"]["last"] > 0.0


def test_amplitude_is_followed_while_it_changes(
    bag: Bag, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    emulator = Emulator(
        Configuration().changed({"exciter.amplitude_rate_m_per_s": 0.01}), start_ns=START_NS
    )
    messages: list[Message] = []
    for revolution in range(80):
        if revolution == 40:
            emulator.command(vibrate=True, frequency_hz=28.0, amplitude_m=0.8e-3)
        for _ in range(N // BLOCK):
            messages += emulator.advance(BLOCK)
    folder = bag(messages)
    main([str(folder), "--csv", str(tmp_path / "out.csv")])
    with (tmp_path / "out.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    known = [bool(row["omega_j"]) for row in rows]
    # 0.8 mm at 0.01 m/s take 3 revolutions, and the window has to be rid of them.
    assert known == [False] * 15 + [True] * 25 + [False] * 17 + [True] * 23
    assert all(row["ccv"] for row in rows[15:])
    capsys.readouterr()
    found = report(capsys, folder)
    assert set(found["recorded_further"]["max_difference"].values()) == {0.0}
    assert set(found["recorded_further"]["one_unknown"].values()) == {0}
