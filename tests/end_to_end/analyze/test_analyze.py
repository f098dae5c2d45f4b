# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bag in, report out: what `roller-sim analyze` finds in a whole bag."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin

from roller_sim_ros.commands.analyze import main
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode, encode, message_class

N = 128
BLOCK = 16
REVOLUTIONS = 160
NUMBER = "std_msgs/msg/Float64"
RECORDED = (topics.ACCELERATION, topics.METER, topics.CMV, topics.TRUTH)

Bag = Callable[..., Path]


def of(run: list[Message], *names: topics.Topic) -> list[Message]:
    return [item for item in run if item.topic in {topic.name for topic in names}]


def replace_topic(message: Message, topic: str) -> Message:
    return message._replace(topic=topic)


def report(capsys: pytest.CaptureFixture[str], *arguments: object) -> dict[str, Any]:
    code = main([*map(str, arguments), "--json", "-"])
    assert code == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def failure(*arguments: object) -> str:
    with pytest.raises(RollerSimError) as error:
        main([str(argument) for argument in arguments])
    assert "\n" not in str(error.value)
    return str(error.value)


def test_values_are_those_that_were_recorded_to_the_last_bit(
    bag: Bag, capsys: pytest.CaptureFixture[str]
) -> None:
    found = report(capsys, bag())
    assert found["complete"] is True
    assert found["topic"] == "/drum/acceleration"
    assert (found["samples"], found["values"]) == (REVOLUTIONS * N, REVOLUTIONS)
    assert found["values_known"] == REVOLUTIONS - 15
    assert found["status"] == {"window filling": 15}
    assert (found["gaps"], found["duplicate_blocks"], found["out_of_order_blocks"]) == (0, 0, 0)
    assert found["stamp_error_max_s"] <= 2e-9
    assert found["excitation_hz"]["min"] == found["excitation_hz"]["max"] == 28.0
    assert found["duration_s"] == pytest.approx(REVOLUTIONS / 28.0, abs=1e-8)
    meter = found["recorded_meter"]
    assert meter["pairs"] == REVOLUTIONS
    assert set(meter["max_difference"].values()) == {0.0}
    assert set(meter["one_unknown"].values()) == {0}
    assert set(meter["disagreements"].values()) == {0}
    assert (meter["unmatched"], meter["window_incomplete"]) == (0, 0)
    assert found["recorded_cmv"]["pairs"] == REVOLUTIONS
    assert found["recorded_cmv"]["max_difference"] == {"cmv": 0.0}
    assert found["truth"]["pairs"] == REVOLUTIONS
    assert 0.0 < found["truth"]["max_difference"]["cmv"] < 1e-5
    assert found["truth"]["disagreements"]["mode"] == 0


def test_settled_values_follow_from_the_samples(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    settled = report(capsys, bag())["settled"]
    pieces = [decode(item.data, item.type_name) for item in of(run, topics.ACCELERATION)]
    vertical = np.concatenate([piece.vertical for piece in pieces])[-64 * N :].astype(float)
    bins = np.abs(np.fft.rfft(vertical))
    assert settled["revolutions"] == 64
    assert settled["cmv"] == pytest.approx(300.0 * bins[128] / bins[64], rel=1e-9)
    assert settled["rmv"] == pytest.approx(300.0 * bins[32] / bins[64], rel=1e-9)
    assert settled["rmv"] > 100.0
    assert settled["acceleration_max_g"] == pytest.approx(vertical.max() / 9.81)
    assert settled["acceleration_min_g"] == pytest.approx(-6.798, abs=1e-3)
    truth = [decode(item.data, item.type_name) for item in of(run, topics.TRUTH)]
    force = np.concatenate([piece.soil_force for piece in truth])[-64 * N :]
    assert settled["soil_force_max_n"] == pytest.approx(force.max())
    assert settled["air_fraction"] == pytest.approx(np.mean(force == 0.0), abs=0.01)


def test_settled_revolutions_are_of_one_frequency(
    bag: Bag, capsys: pytest.CaptureFixture[str]
) -> None:
    emulator = Emulator(Configuration(), start_ns=0)
    messages = []
    for block in range(8 * 140):
        if block == 8 * 99:
            emulator.command(vibrate=True, frequency_hz=30.0, amplitude_m=1.6e-3)
        messages += emulator.advance(N // 8)
    found = report(capsys, bag(messages))
    frequencies = [
        decode(item.data, item.type_name).excitation_frequency
        for item in of(messages, topics.ACCELERATION)
    ]
    settled = found["settled"]
    assert settled["excitation_hz"] == 30.0
    assert 20 < settled["revolutions"] <= frequencies.count(30.0) // 8
    assert found["excitation_hz"]["min"] == 28.0
    assert found["status"]["frequency changing"] >= 16
    assert found["recorded_meter"]["max_difference"]["cmv"] == 0.0


def test_table_says_the_same_in_words(bag: Bag, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(bag())]) == 0
    text = capsys.readouterr().out
    for words in (
        "no gaps, no duplicates",
        "28 Hz",
        "double jump",
        "recorded meter  160 values",
    ):
        assert words in text
    assert "cmv within 0, rmv within 0" in text


def test_csv_gives_the_same_bits_and_unknown_is_empty(bag: Bag, tmp_path: Path) -> None:
    folder = bag()
    main([str(folder), "--csv", str(tmp_path / "out.csv"), "--json", str(tmp_path / "out.json")])
    with (tmp_path / "out.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == REVOLUTIONS
    assert rows[0]["cmv"] == rows[0]["recorded_cmv"] == ""
    assert rows[-1]["last_sample"] == str(REVOLUTIONS * N - 1)
    assert rows[-1]["cmv"] == rows[-1]["recorded_cmv"] != rows[-1]["true_cmv"]
    found = json.loads((tmp_path / "out.json").read_text())
    assert float(rows[-1]["cmv"]) == found["cmv"]["last"]
    assert float(rows[-1]["true_cmv"]) == pytest.approx(found["cmv"]["last"], abs=1e-5)


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_plot(bag: Bag, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"out.{ending}"
    main([str(bag()), "--plot", str(path)])
    begins = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}[ending]
    assert path.read_bytes().startswith(begins)
    assert path.stat().st_size > 15_000


def test_plot_without_truth_and_without_a_settled_revolution(
    bag: Bag, run: list[Message], tmp_path: Path
) -> None:
    for name, count in (("long", REVOLUTIONS), ("short", 3)):
        samples = of(run, topics.ACCELERATION)[: count * N // BLOCK]
        path = tmp_path / f"{name}.png"
        main([str(bag(samples, name)), "--plot", str(path)])
        assert path.stat().st_size > 10_000


def test_losses_are_counted_and_what_is_left_still_agrees(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    samples = of(run, topics.ACCELERATION)
    received = samples[:100] + samples[101:200] + [samples[199], samples[201], samples[200]]
    received += samples[202:300] + samples[340:]
    meter = of(run, topics.METER)
    found = report(capsys, bag(received + meter))
    assert (found["gaps"], found["missing_samples"]) == (2, 16 + 40 * 16)
    assert (found["duplicate_blocks"], found["out_of_order_blocks"]) == (1, 1)
    assert found["samples"] == REVOLUTIONS * N - found["missing_samples"]
    compared = found["recorded_meter"]
    assert set(compared["max_difference"].values()) == {0.0}
    assert compared["window_incomplete"] > 30
    assert compared["unmatched"] == 1 + 1 + 6
    assert compared["pairs"] + compared["window_incomplete"] + compared["unmatched"] == REVOLUTIONS


def test_recording_that_begins_late_is_compared_where_it_can_be(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    later = [item for item in run if item.topic != topics.IMU.name][len(run) // 40 :]
    compared = report(capsys, bag(later))["recorded_meter"]
    assert compared["window_incomplete"] == 15
    assert set(compared["max_difference"].values()) == {0.0}
    assert set(compared["one_unknown"].values()) == {0}


def test_imu_stream_gives_the_same_cmv(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    folder = bag(of(run, topics.IMU, topics.METER))
    found = report(capsys, folder)
    assert found["type"] == "sensor_msgs/msg/Imu"
    assert found["imu_excitation_hz"] == pytest.approx(28.0, rel=1e-6)
    assert found["samples_per_revolution"] == N
    assert found["recorded_meter"]["max_difference"]["cmv"] < 1e-5
    assert found["settled"]["acceleration_min_g"] == pytest.approx(-6.798, abs=1e-3)
    assert "samples per revolution at 27.000 Hz" in failure(folder, "--frequency-hz", 27)


@pytest.mark.parametrize(
    ("storage", "compressed", "single"),
    [
        (StoragePlugin.SQLITE3, False, False),
        (StoragePlugin.SQLITE3, True, False),
        (StoragePlugin.MCAP, False, True),
    ],
)
def test_other_kinds_of_bags(
    bag: Bag,
    capsys: pytest.CaptureFixture[str],
    storage: StoragePlugin,
    compressed: bool,
    single: bool,
) -> None:
    path = bag(storage=storage, compressed=compressed)
    if single:
        (path,) = path.glob("*.mcap")
    found = report(capsys, path)
    assert found["recorded_meter"]["max_difference"]["cmv"] == 0.0
    assert found["recorded_meter"]["pairs"] == REVOLUTIONS


def test_rollers_in_two_namespaces_are_told_apart(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    first = [replace_topic(item, f"a/{item.topic}") for item in of(run, *RECORDED)]
    second = [replace_topic(item, f"b/{item.topic}") for item in of(run, *RECORDED)[:2000]]
    folder = bag(first, more=second)
    assert "choose one with --topic: /a/drum/acceleration, /b/drum/acceleration" in failure(folder)
    for name, values in (("/a/drum/acceleration", REVOLUTIONS), ("b/drum/acceleration", 111)):
        found = report(capsys, folder, "--topic", name)
        assert found["recorded_meter"]["pairs"] == found["values"] == pytest.approx(values, abs=1)
        assert found["recorded_meter"]["max_difference"]["cmv"] == 0.0


def test_meter_under_test_is_compared_in_place_of_the_recorded_one(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    mine, numbers = [], []
    for item in of(run, topics.METER):
        value = decode(item.data, item.type_name)
        value.cmv += 0.25
        mine.append(Message("mine", item.type_name, encode(value, item.type_name), item.stamp_ns))
        number = message_class("std_msgs/msg/Float64")(value.cmv + 0.25)
        numbers.append(Message("number", NUMBER, encode(number, NUMBER), item.stamp_ns))
    messages = of(run, topics.ACCELERATION, topics.METER) + mine
    folder = bag(messages)
    assert report(capsys, folder)["recorded_meter"]["max_difference"]["cmv"] == 0.0
    found = report(capsys, folder, "--meter", "/mine")["recorded_meter"]
    assert found["max_difference"]["cmv"] == pytest.approx(0.25)
    assert found["max_difference"]["rmv"] == 0.0
    # A plain number has no index: it belongs to the value before it.
    places = {id(item): index for index, item in enumerate(run)}
    by_place = [(places[id(item)], item) for item in of(run, topics.ACCELERATION)]
    by_place += [
        (places[id(item)], number)
        for item, number in zip(of(run, topics.METER), numbers, strict=True)
    ]
    folder = bag([item for _, item in sorted(by_place, key=lambda pair: pair[0])], "numbers")
    found = report(capsys, folder, "--meter", "number")
    assert found["recorded_meter"] is None
    assert found["recorded_cmv"]["max_difference"]["cmv"] == pytest.approx(0.5)
    assert found["recorded_cmv"]["pairs"] == REVOLUTIONS


def test_window_of_the_recorded_meter_is_taken_over(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    short = []
    for item in of(run, topics.METER):
        value = decode(item.data, item.type_name)
        value.window_revolutions = 4
        short.append(item._replace(data=encode(value, item.type_name)))
    folder = bag(of(run, topics.ACCELERATION) + short)
    taken_over = report(capsys, folder)
    assert (taken_over["window_revolutions"], taken_over["warnings"]) == (4, [])
    found = report(capsys, folder, "--window-revolutions", 8)
    assert (found["window_revolutions"], found["values_known"]) == (8, REVOLUTIONS - 7)
    assert "window of 4 revolutions, not of 8" in found["warnings"][0]
    # 8 revolutions tell periods up to 4; where they find none, that is no statement.
    assert "unknown" in found["periods"]
    assert "none" not in found["periods"]


def test_other_number_of_samples_per_revolution_is_noticed(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    thinned = []
    for item in of(run, topics.ACCELERATION):
        value = decode(item.data, item.type_name)
        value.sequence //= 2
        value.sample_period *= 2
        value.phase_increment *= 2
        value.vertical, value.horizontal = value.vertical[::2].copy(), value.horizontal[::2].copy()
        thinned.append(item._replace(data=encode(value, item.type_name)))
    folder = bag(thinned)
    found = report(capsys, folder)
    # The first revolution and the last cannot be interpolated.
    assert found["values_known"] == REVOLUTIONS - 17
    assert "64 samples per revolution, not 128" in found["warnings"][0]
    exactly = report(capsys, folder, "--samples-per-rev", 64)
    assert exactly["values_known"] == REVOLUTIONS - 15
    assert exactly["warnings"] == []
    assert found["cmv"]["last"] == pytest.approx(exactly["cmv"]["last"], rel=1e-2)


def test_specific_force_is_shown_as_coordinate_acceleration(
    bag: Bag, run: list[Message], capsys: pytest.CaptureFixture[str]
) -> None:
    heavy = []
    for item in of(run, topics.ACCELERATION):
        value = decode(item.data, item.type_name)
        value.kind = 1
        value.vertical = value.vertical + np.float32(9.81)
        heavy.append(item._replace(data=encode(value, item.type_name)))
    plain = report(capsys, bag(of(run, topics.ACCELERATION)))["settled"]
    found = report(capsys, bag(heavy, "heavy"))["settled"]
    assert found["acceleration_max_g"] == pytest.approx(plain["acceleration_max_g"], abs=1e-6)
    assert found["cmv"] == pytest.approx(plain["cmv"], rel=1e-6)
    assert found["period"] == plain["period"]


def test_progress_goes_to_the_standard_error_when_asked_for(
    bag: Bag, capsys: pytest.CaptureFixture[str]
) -> None:
    main([str(bag()), "--progress", "--json", "-"])
    captured = capsys.readouterr()
    json.loads(captured.out)
    percents = [int(line.split()[1]) for line in captured.err.splitlines()]
    assert percents[-1] == 100
    assert percents == sorted(set(percents))
    main([str(bag(name="again")), "--json", "-"])
    assert capsys.readouterr().err == ""
