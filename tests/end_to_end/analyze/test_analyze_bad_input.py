# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bad input: one clear line, exit code 1, no traceback; what can be read is read."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from roller_sim_ros.commands.analyze import main
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode, encode, message_class

Bag = Callable[..., Path]


def failure(*arguments: object) -> str:
    with pytest.raises(RollerSimError) as error:
        main([str(argument) for argument in arguments])
    assert "\n" not in str(error.value)
    return str(error.value)


def command(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", "analyze", *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=120,
        env=os.environ | {"COLUMNS": "100"},
    )


def single(folder: Path) -> Path:
    (file,) = folder.glob("*.mcap")
    return file


def test_missing_empty_and_foreign_files(tmp_path: Path) -> None:
    assert "there is no such file" in failure(tmp_path / "none.mcap")
    empty = tmp_path / "empty.mcap"
    empty.touch()
    assert "empty" in failure(empty)
    text = tmp_path / "text.mcap"
    text.write_text("not a bag at all, only some words")
    assert "no MCAP file" in failure(text)
    assert str(tmp_path) in failure(text)


def test_folders_that_are_no_bags(tmp_path: Path) -> None:
    assert "metadata.yaml" in failure(tmp_path)
    (tmp_path / "metadata.yaml").write_text("rosbag2_bagfile_information: {version: 9}")
    assert "metadata" in failure(tmp_path)


def test_sqlite_folder_without_its_file(bag: Bag, run: list[Message]) -> None:
    from rosbags.rosbag2 import StoragePlugin

    folder = bag(run[:50], storage=StoragePlugin.SQLITE3)
    (file,) = folder.glob("*.db3")
    file.write_bytes(file.read_bytes()[:5000])
    assert str(folder) in failure(folder)
    file.unlink()
    assert str(folder) in failure(folder)


def test_foreign_bag_and_missing_topic(bag: Bag, run: list[Message]) -> None:
    name = "std_msgs/msg/Float64"
    number = Message("temperature", name, encode(message_class(name)(20.0), name), 0)
    folder = bag([number] * 5, "foreign")
    line = failure(folder)
    assert "neither roller_sim_ros/msg/DrumAcceleration nor sensor_msgs/msg/Imu" in line
    assert "/temperature (std_msgs/msg/Float64)" in line
    assert "there is no topic /drum/nothing" in failure(folder, "--topic", "/drum/nothing")
    assert "holds std_msgs/msg/Float64" in failure(folder, "--topic", "temperature")
    truth_only = [item for item in run if item.topic == topics.TRUTH.name][:10]
    assert "its topics: /truth" in failure(bag(truth_only, "truth"))


def test_cut_off_file_is_read_as_far_as_it_goes(
    bag: Bag, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    whole = single(bag()).read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole[: len(whole) * 2 // 3])
    line = failure(cut, "--json", "-", "--plot", tmp_path / "cut.png")
    assert "roller-sim recover" in line
    assert "messages over" in line
    found = json.loads(capsys.readouterr().out)
    assert found["complete"] is False
    assert found["damage"]
    assert 20 < found["values"] < 160
    assert found["recorded_meter"]["max_difference"]["cmv"] == 0.0
    assert (tmp_path / "cut.png").stat().st_size > 10_000


@pytest.mark.parametrize("share", [0.0001, 0.001, 0.01, 0.1, 0.5, 0.99, 0.9999])
def test_wherever_a_file_is_cut_there_is_one_line(bag: Bag, tmp_path: Path, share: float) -> None:
    whole = single(bag()).read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole[: int(len(whole) * share) + 8])
    assert str(cut) in failure(cut)


def test_message_that_is_no_message_of_its_type(bag: Bag, run: list[Message]) -> None:
    samples = [item for item in run if item.topic == topics.ACCELERATION.name][:20]
    samples[10] = samples[10]._replace(data=samples[10].data[:60])
    assert "a message of type roller_sim_ros/msg/DrumAcceleration cannot" in failure(bag(samples))


def test_imu_stream_that_changes_its_frequency(bag: Bag, run: list[Message]) -> None:
    samples = [item for item in run if item.topic == topics.IMU.name]
    start = decode(samples[0].data, samples[0].type_name).header.stamp
    stretched = []
    for item in samples:
        value = decode(item.data, item.type_name)
        stamp = value.header.stamp
        since = (stamp.sec - start.sec) * 10**9 + stamp.nanosec - start.nanosec
        later = since if since < 4 * 10**9 else since + (since - 4 * 10**9) // 20
        stamp.sec, stamp.nanosec = divmod(start.sec * 10**9 + start.nanosec + later, 10**9)
        stretched.append(item._replace(data=encode(value, item.type_name)))
    assert "the excitation does not stay constant" in failure(bag(stretched))


def test_outputs_that_cannot_be_written(bag: Bag, run: list[Message], tmp_path: Path) -> None:
    folder = bag(run[:400])
    for option in ("--csv", "--plot", "--json"):
        line = failure(folder, option, tmp_path / "nowhere" / "out.png")
        assert "cannot be written" in line
        assert str(tmp_path / "nowhere" / "out.png") in line
    assert "cannot be drawn" in failure(folder, "--plot", tmp_path / "out.xyz")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--window-revolutions", "3"], "3 is not a positive even number"),
        (["--window-revolutions", "two"], "invalid"),
        (["--noise-floor", "-1"], "-1 is not a number of at least 0"),
        (["--noise-floor", "nan"], "nan is not a number of at least 0"),
        (["--frequency-hz", "0"], "0 is not a positive number"),
        (["--samples-per-rev", "8"], "8 is less than 16"),
        (["--unknown"], "unrecognized arguments"),
    ],
)
def test_wrong_options_end_with_code_2(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as error:
        main(["some.mcap", *arguments])
    assert error.value.code == 2
    assert words in capsys.readouterr().err


def test_command_shows_one_line_and_code_1(bag: Bag, tmp_path: Path) -> None:
    result = command(tmp_path / "none.mcap")
    assert result.returncode == 1
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert result.stderr.startswith("roller-sim analyze: error: ")
    whole = single(bag()).read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole[: len(whole) // 2])
    result = command(cut)
    assert result.returncode == 1
    assert "recorded meter" in result.stdout
    assert result.stderr.count("\n") == 1
    assert "Traceback" not in result.stderr


def test_help_is_quick_and_tells_units_and_an_example() -> None:
    program = (
        "import sys; from roller_sim_ros.commands import analyze\n"
        "try: analyze.main(['--help'])\n"
        "except SystemExit: pass\n"
        "slow = {'matplotlib', 'rosbags', 'scipy', 'numba', 'mcap'} & set(sys.modules)\n"
        "print('slow:', sorted(slow))"
    )
    result = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, timeout=60
    )
    assert result.returncode == 0, result.stderr
    assert result.stdout.splitlines()[-1] == "slow: []"
    for words in ("m/s²", "Hz (default", "example:", "roller-sim analyze trace.mcap", "--topic"):
        assert words in result.stdout
