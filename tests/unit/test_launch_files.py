# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the launch files start, for every argument; launch itself is stood in for by tests/launching.py."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from roller_sim_ros.commands import bench, panel, sim
from tests.launching import FOLDER, ROOT, Shutdown, declared, launched

FILES = tuple(path.name.removesuffix(".launch.py") for path in sorted(FOLDER.glob("*.py")))
DENSE = str(ROOT / "config" / "dense.yaml")


def own(command: list[str]) -> list[str]:
    """What is for the command itself, not for ROS 2."""
    return command[1 : command.index("--ros-args")]


def for_ros(command: list[str]) -> list[tuple[str, str]]:
    """What is for ROS 2: flags and their values."""
    words = command[command.index("--ros-args") + 1 :]
    return list(zip(words[::2], words[1::2], strict=True))


def parameters(command: list[str], number: int = -1) -> Any:
    """Content of a file of parameters, the last when not told which."""
    files = [value for flag, value in for_ros(command) if flag == "--params-file"]
    return yaml.safe_load(Path(files[number]).read_text(encoding="utf-8"))


def test_there_are_three() -> None:
    assert FILES == ("bench", "demo", "sim")


@pytest.mark.parametrize("name", FILES)
def test_every_argument_is_explained(name: str) -> None:
    arguments = declared(name)
    assert len({item.name for item in arguments}) == len(arguments)
    for item in arguments:
        assert item.description is not None, item.name
        assert item.description.endswith("."), item.name
        assert (item.default_value is None) == (item.name == "scenario" and name == "bench")
    if name != "bench":
        named = {item.name for item in arguments}
        assert named >= {"namespace", "params_file", "record", "use_sim_time", "scenario"}


def test_sim_starts_the_node_as_it_is_by_default(tmp_path: Path) -> None:
    (roller,) = launched("sim", tmp_path)
    assert Path(roller.command[0]).parts[-2:] == ("roller_sim_ros", "sim")
    assert own(roller.command) == []
    assert for_ros(roller.command)[:2] == [("-r", "__node:=roller_sim"), ("-r", "__ns:=/")]
    assert parameters(roller.command) == {"/roller_sim": {"ros__parameters": {"autostart": True}}}
    assert roller.output == "screen"


def test_sim_hands_on_what_is_given(tmp_path: Path) -> None:
    given = {"record": "t.mcap", "scenario": "soft_spot", "clock": "sim", "speed": "2.5"}
    switches = {"lock_step": "true", "exit_at_end": "True", "autostart": "false"}
    (roller,) = launched(
        "sim", tmp_path, namespace="one/two", params_file=DENSE, **given, **switches
    )
    words, ros = sim._split(roller.command[1:])
    arguments = sim._parser().parse_args(words)
    assert sim._time_and_scenario(arguments) == {
        "scenario.path": "soft_spot",
        "pacing.clock": "sim",
        "pacing.speed": 2.5,
        "pacing.lock_step": True,
    }
    assert arguments.exit_at_end
    assert sim.given_values(arguments)["recording.path"] == "t.mcap"
    assert ros == roller.command[roller.command.index("--ros-args") :]
    assert ("-r", "__ns:=/one/two") in for_ros(roller.command)
    assert ("--params-file", DENSE) in for_ros(roller.command)
    assert parameters(roller.command) == {
        "/one/two/roller_sim": {"ros__parameters": {"autostart": False}}
    }


@pytest.mark.parametrize(
    ("given", "flags"),
    [
        ({"use_sim_time": "true"}, ["--clock", "sim"]),
        ({"use_sim_time": "True", "clock": "real"}, ["--clock", "real"]),
        ({"use_sim_time": "false"}, []),
    ],
)
def test_use_sim_time_is_the_clock(given: dict[str, str], flags: list[str], tmp_path: Path) -> None:
    (roller,) = launched("sim", tmp_path, **given)
    assert own(roller.command) == flags


@pytest.mark.parametrize("name", ["sim", "demo"])
@pytest.mark.parametrize(
    "given", [{"use_sim_time": "yes"}, {"params_file": "nowhere.yaml"}, {"lock_step": "2"}]
)
def test_what_is_wrong_is_refused(name: str, given: dict[str, str], tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="|".join([*given, *given.values()])):
        launched(name, tmp_path, **given)


def test_demo_starts_roller_and_page_on_the_same_network(tmp_path: Path) -> None:
    roller, page = launched(
        "demo",
        tmp_path,
        namespace="roller_1",
        params_file=DENSE,
        record="t.mcap",
        scenario="soft_spot",
        use_sim_time="true",
        port="8081",
        token="secret",
    )
    assert own(roller.command) == [
        *("--record", "t.mcap"),
        *("--scenario", "soft_spot"),
        *("--clock", "sim"),
    ]
    assert ("--params-file", DENSE) in for_ros(roller.command)
    assert Path(page.command[0]).parts[-2:] == ("roller_sim_ros", "panel")
    for process in (roller, page):
        assert ("-r", "__ns:=/roller_1") in for_ros(process.command)
    arguments = panel._parser().parse_args(own(page.command))
    assert (arguments.bind, arguments.port, arguments.token) == ("127.0.0.1", 8081, "secret")
    # The page keeps the name it has.
    assert not any("__node" in value for _, value in for_ros(page.command))
    assert parameters(page.command) == {"/**": {"ros__parameters": {"use_sim_time": True}}}


def parsed_bench(folder: Path, **given: str) -> Any:
    (process,) = launched("bench", folder, **given)
    assert Path(process.command[0]).parts[-2:] == ("roller_sim_ros", "bench")
    return bench._parser().parse_args(process.command[1:])


def test_bench_hands_on_what_is_given(tmp_path: Path) -> None:
    meter = "ros2 run my_meters cmv --window 16"
    arguments = parsed_bench(
        tmp_path, scenario="soft_to_stiff", meter=meter, topic="/my/cmv", clock="sim", speed="5"
    )
    assert (arguments.scenario, arguments.topic) == ("soft_to_stiff", "/my/cmv")
    assert arguments.meter == meter.split()
    assert (arguments.clock, arguments.speed) == ("sim", 5.0)
    assert (arguments.limits, arguments.out) == (None, None)
    arguments = parsed_bench(tmp_path, scenario="x", limits="l.yaml", junit="j.xml", out="folder")
    assert (arguments.limits, arguments.junit) == (Path("l.yaml"), Path("j.xml"))
    assert arguments.out == Path("folder")


def test_bench_needs_a_scenario_and_ends_the_launch(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="scenario"):
        launched("bench", tmp_path)
    (process,) = launched("bench", tmp_path, scenario="x")
    assert process.on_exit == [Shutdown(reason="the bench has ended")]
