# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A trace in, the ground out: the command, real sensors, pulses, and input that is of no use."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer

from roller_sim_ros.commands.estimate import main
from roller_sim_ros.commands.run import main as run
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.estimate import Status
from roller_sim_ros.estimate.trace import TraceOptions, estimate_trace
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode, encode, typestore

START_NS = 1_700_000_000_000_000_000

SENSOR = """\
title: a sensor's trace
machine: {preset: paper-10t}
lane: {length_m: 4}
travel: {speed_m_s: 1.0}
ground: {preset: paper-soft}
exciter: {frequency_hz: 28, amplitude_mm: 1.6}
sensors:
  - name: accelerometer
    parameters: {range_m_s2: 490.3325, adc_bits: 12, noise_density: 0.0579, %s}
  - name: tacho
    parameters: {jitter_s: 1.0e-5, missing_probability: 0.02}
seed: 1
"""


def estimated(capsys: pytest.CaptureFixture[str], *arguments: object) -> list[dict[str, Any]]:
    capsys.readouterr()
    assert main([*map(str, arguments), "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert isinstance(found, list)
    return found


def values(windows: list[dict[str, Any]], name: str) -> list[float]:
    return [window[name] for window in windows if window["status"] == "ok"]


def failure(*arguments: object) -> str:
    with pytest.raises(RollerSimError) as error:
        main([str(argument) for argument in arguments])
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("estimate") / "trace.mcap"
    options = "--shear-modulus-mpa 35 --plastic-mm 0.8 --revolutions 80 --json"
    assert run([*options.split(), str(path.with_suffix(".json")), "--record", str(path)]) == 0
    return path


@pytest.fixture(scope="module")
def sensor_trace(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    folder = tmp_path_factory.mktemp("sensor")

    def record(more: str) -> Path:
        scenario = folder / "sensor.yaml"
        scenario.write_text(SENSOR % more)
        path = folder / f"{abs(hash(more))}.mcap"
        if not path.exists():
            assert run([str(scenario), "--record", str(path)]) == 0
        return path

    return record


def test_a_trace_tells_its_ground(trace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    windows = estimated(capsys, trace)
    assert [round(window["start"] * 28) for window in windows] == [0, 8, 16, 24, 32, 40, 48, 56, 64]
    first, last = windows[0], windows[-1]
    # From rest the motion has not settled; what is unknown is null.
    assert first["status"] == "unsettled"
    assert first["shear_modulus_mpa"] is None
    assert first["plastic_spread_mm"] is None
    assert last["status"] == "ok"
    assert last["shear_modulus_mpa"] == pytest.approx(35.0, rel=0.01)
    assert last["plastic_mm"] == pytest.approx(0.8, rel=0.02)
    assert 0.0 < last["shear_modulus_spread_mpa"] < 1.0
    assert 0.0 < last["plastic_spread_mm"] < 0.05
    assert last["excitation_hz"] == pytest.approx(28.0)
    assert last["amplitude_mm"] == pytest.approx(1.6)
    assert last["period"] == 1
    assert last["misfit_share"] < 0.01


def test_table_and_plot(trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    plot, file = tmp_path / "plot.png", tmp_path / "windows.json"
    assert (
        main([str(trace), "--plot", str(plot), "--json", str(file), "--step-revolutions", "16"])
        == 0
    )
    table = capsys.readouterr().out
    assert "drum 3200 kg" in table
    assert "35.0" in table
    assert "unsettled, 1 of 5: the motion drifts" in table
    assert plot.read_bytes().startswith(b"\x89PNG")
    assert len(json.loads(file.read_text())) == 5


def test_another_machine_and_half_space_can_be_assumed(
    trace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    step = ("--window-revolutions", 32, "--step-revolutions", 32)
    truth = values(estimated(capsys, trace, *step), "shear_modulus_mpa")[-1]
    heavier = estimated(capsys, trace, *step, "--drum-mass-kg", 3360, "--amplitude-mm", 1.6 / 1.05)
    assert heavier[-1]["amplitude_mm"] == pytest.approx(1.6 / 1.05)
    assert heavier[-1]["shear_modulus_mpa"] > 1.03 * truth
    two_pole = estimated(capsys, trace, *step, "--half-space", "two-pole")
    assert two_pole[-1]["shear_modulus_mpa"] > 1.01 * truth


@pytest.mark.parametrize("tacho", [False, True])
def test_noise_range_and_converter_of_a_real_sensor(
    sensor_trace: Callable[[str], Path], capsys: pytest.CaptureFixture[str], tacho: bool
) -> None:
    windows = estimated(capsys, sensor_trace("bandwidth_hz: 0"), *(["--tacho"] if tacho else []))
    moduli, plastics = values(windows, "shear_modulus_mpa"), values(windows, "plastic_mm")
    assert len(moduli) >= 8
    assert np.median(np.abs(np.array(moduli) / 35.0 - 1.0)) <= 0.05
    assert np.median(np.abs(np.array(plastics) / 0.8 - 1.0)) <= 0.10


@pytest.mark.parametrize("tacho", [False, True])
def test_a_sensor_with_a_rate_and_a_low_pass_of_its_own(
    sensor_trace: Callable[[str], Path], capsys: pytest.CaptureFixture[str], tacho: bool
) -> None:
    path = sensor_trace("bandwidth_hz: 1000, sample_rate_hz: 5000")
    flags = ["--sensor-bandwidth-hz", "1000", "--step-revolutions", "16"]
    windows = estimated(capsys, path, *flags, *(["--tacho"] if tacho else []))
    moduli, plastics = values(windows, "shear_modulus_mpa"), values(windows, "plastic_mm")
    assert len(moduli) >= 4
    assert np.median(np.abs(np.array(moduli) / 35.0 - 1.0)) <= 0.05
    assert np.median(np.abs(np.array(plastics) / 0.8 - 1.0)) <= 0.10


def messages(
    revolutions: int = 60, changes: dict[int, dict[str, float]] | None = None
) -> list[Message]:
    """What an emulator sends, the per-sample Imu among it; the ground, the exciter may change at a revolution."""
    configuration = Configuration().changed(
        {"soil.shear_modulus_pa": 35e6, "soil.plastic_parameter_m": 0.8e-3}
    )
    emulator = Emulator(configuration, start_ns=START_NS)
    found: list[Message] = []
    for revolution in range(revolutions):
        if changes and revolution in changes:
            emulator.change(changes[revolution])
        for _ in range(8):
            found += emulator.advance(16) + emulator.imu_messages()
    return found


def pulses(revolutions: int = 60) -> Iterator[Message]:
    """Yield the pulses of an ideal tacho, one missing."""
    name = "roller_sim_ros/msg/TachoPulse"
    kind = typestore().types
    for number in range(revolutions + 1):
        if number == 25:
            continue
        stamp = START_NS + round(number / 28.0 * 1e9)
        time = kind["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
        header = kind["std_msgs/msg/Header"](time, "drum_axle")
        yield Message(
            "tacho", name, encode(kind[name](header, number + 1, 0.0, math.nan), name), stamp
        )


def bag(path: Path, found: list[Message]) -> Path:
    """Write a rosbag2 folder without the run's parameters, as a recorder on the network does."""
    with Writer(path, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connections: dict[str, Any] = {}
        for number, item in enumerate(found):
            if item.topic not in connections:
                connections[item.topic] = writer.add_connection(
                    f"/{item.topic}", item.type_name, typestore=typestore()
                )
            writer.write(connections[item.topic], START_NS + number * 1000, item.data)
    return path


@pytest.fixture(scope="module")
def sent() -> list[Message]:
    return messages()


def test_the_topic_machine_tells_the_machine(
    sent: list[Message], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    windows = estimated(
        capsys, bag(tmp_path / "bag", [item for item in sent if item.topic != topics.IMU.name])
    )
    assert values(windows, "shear_modulus_mpa")[-1] == pytest.approx(35.0, rel=0.01)


def test_an_unknown_machine(
    sent: list[Message], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = bag(tmp_path / "bag", [item for item in sent if item.topic == topics.ACCELERATION.name])
    line = failure(path)
    assert str(path) in line
    assert "which machine made it: give --machine NAME or --params FILE" in line
    parameters = tmp_path / "machine.yaml"
    parameters.write_text("machine: {drum_mass_kg: 3200.0}")
    assert "does not say the exciter's amplitude" in failure(path, "--params", parameters)
    assert "there is no such preset" in failure(path, "--machine", "nobody's")
    windows = estimated(capsys, path, "--machine", "paper-10t", "--amplitude-mm", 1.6)
    assert values(windows, "plastic_mm")[-1] == pytest.approx(0.8, rel=0.02)


def test_imu_and_pulses_alone(
    sent: list[Message], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    imu = [item for item in sent if item.topic == topics.IMU.name]
    flags = ("--machine", "paper-10t", "--amplitude-mm", 1.6)
    assert "one topic of roller_sim_ros/msg/TachoPulse is needed" in failure(
        bag(tmp_path / "imu", imu), *flags
    )
    windows = estimated(capsys, bag(tmp_path / "both", [*pulses(), *imu]), *flags)
    moduli = values(windows, "shear_modulus_mpa")
    assert len(moduli) >= 4
    assert moduli[-1] == pytest.approx(35.0, rel=0.01)


def test_what_happens_on_the_way_is_told_window_by_window(tmp_path: Path) -> None:
    changes = {
        60: {"soil.shear_modulus_pa": 45e6},
        120: {"exciter.amplitude_m": 1.2e-3},
        180: {"exciter.vibrate": False},
    }
    found = [
        item
        for item in messages(320, changes)  # type: ignore[arg-type]
        if item.topic != topics.IMU.name
    ]
    result = estimate_trace(
        bag(tmp_path / "bag", found), TraceOptions(window_revolutions=8, step_revolutions=8)
    )
    status = [window.estimate.status for window in result.windows]
    ok = [window for window in result.windows if window.estimate.status is Status.OK]
    turns = [round(window.start_s * 28.0) for window in ok]
    moduli = [window.estimate.shear_modulus_pa / 1e6 for window in ok]
    before = [g for g, turn in zip(moduli, turns, strict=True) if turn < 52]
    after = [g for g, turn in zip(moduli, turns, strict=True) if 80 <= turn < 112]
    smaller = [g for g, turn in zip(moduli, turns, strict=True) if 140 <= turn < 170]
    assert before
    assert before[-1] == pytest.approx(35.0, rel=0.01)
    assert after
    assert after[-1] == pytest.approx(45.0, rel=0.01)
    assert smaller
    assert smaller[-1] == pytest.approx(45.0, rel=0.01)
    assert Status.CHANGING in status
    assert status[-1] in (Status.STANDING, Status.CHANGING, Status.TOO_FEW)


def test_lost_blocks_and_values_that_are_none(sent: list[Message], tmp_path: Path) -> None:
    kept = []
    number = 0
    for item in sent:
        if item.topic == topics.IMU.name:
            continue
        number += item.topic == topics.ACCELERATION.name
        if item.topic != topics.ACCELERATION.name or number not in (20 * 8, 45 * 8):
            kept.append(item)
        elif number == 45 * 8:
            message = decode(item.data, item.type_name)
            message.vertical = np.full_like(message.vertical, np.nan)
            kept.append(Message(item.topic, item.type_name, encode(message, item.type_name), 0))
    result = estimate_trace(
        bag(tmp_path / "bag", kept), TraceOptions(window_revolutions=8, step_revolutions=8)
    )
    spans = [(round(window.start_s * 28.0), window.estimate.status) for window in result.windows]
    # Nothing reaches over the lost block in revolution 19.
    starts = [turn for turn, _ in spans]
    assert starts == [0, 8, 20, 28, 36, 44, 52]
    assert dict(spans)[44] is Status.MISSING
    assert dict(spans)[52] is Status.OK


def test_files_that_are_of_no_use(trace: Path, tmp_path: Path) -> None:
    assert "there is no such file" in failure(tmp_path / "none.mcap")
    text = tmp_path / "text.mcap"
    text.write_text("not a trace at all, only some words")
    assert "no MCAP file" in failure(text)
    assert "there is no topic /nothing" in failure(trace, "--topic", "/nothing")
    assert "neither roller_sim_ros/msg/DrumAcceleration" in failure(trace, "--topic", "/meter")
    assert "phase" in failure(trace, "--tacho")
    assert "cannot be written" in failure(trace, "--json", tmp_path / "no" / "folder.json")
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(trace.read_bytes()[:200_000])
    assert "windows were estimated all the same" in failure(cut)


@pytest.mark.parametrize(
    ("flags", "says"),
    [
        (["--window-revolutions", "2"], "2 is less than 4"),
        (["--step-revolutions", "17"], "17 is more than the window's 16"),
        (["--shear-modulus-mpa", "30"], "unrecognized arguments"),
        (["--sensor-bandwidth-hz", "-5"], "not a number of at least 0"),
    ],
)
def test_flags_that_are_refused(
    flags: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["trace.mcap", *flags])
    assert stop.value.code == 2
    line = capsys.readouterr().err
    assert says in line
    assert line.count("\n") == 1


def test_the_installed_command_fails_in_one_line(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", "estimate", str(tmp_path / "none.mcap")],
        capture_output=True,
        text=True,
        timeout=120,
        env=os.environ | {"COLUMNS": "100"},
    )
    assert done.returncode == 1
    assert done.stderr.startswith("roller-sim estimate: error: ")
    assert done.stderr.count("\n") == 1
