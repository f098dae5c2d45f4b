"""The launch file hands on to the command what is given; launch is not among the wheels, so it is stood in for."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from roller_sim_ros.commands import bench

LAUNCH = Path(__file__).resolve().parents[3] / "launch" / "bench.launch.py"


class Recorded:
    """Stands for any class of launch: remembers how it was made."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        self.arguments, self.named = arguments, named


class Configuration:
    """Stands for LaunchConfiguration: the context is a mapping here."""

    def __init__(self, name: str) -> None:
        self.name = name

    def perform(self, context: dict[str, str]) -> str:
        return context[self.name]


@pytest.fixture
def launch_file(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    names = {
        "launch": ("LaunchContext", "LaunchDescription"),
        "launch.actions": ("DeclareLaunchArgument", "ExecuteProcess", "OpaqueFunction", "Shutdown"),
        "launch.substitutions": (),
    }
    for module, classes in names.items():
        stand_in = ModuleType(module)
        for name in classes:
            setattr(stand_in, name, type(name, (Recorded,), {}))
        monkeypatch.setitem(sys.modules, module, stand_in)
    sys.modules["launch.substitutions"].LaunchConfiguration = Configuration  # type: ignore[attr-defined]
    return SimpleNamespace(**runpy.run_path(str(LAUNCH)))


def test_given_arguments_become_flags_that_the_command_knows(launch_file: SimpleNamespace) -> None:
    context = dict.fromkeys(launch_file.FLAGS, "")
    context |= {
        "scenario": "soft_to_stiff",
        "meter": "ros2 run my cmv",
        "clock": "sim",
        "speed": "5",
    }
    (process,) = launch_file._bench(context)
    command = process.named["cmd"]
    assert command[:4] == [sys.executable, "-m", "roller_sim_ros.commands", "bench"]
    arguments = bench._parser().parse_args(command[4:])
    assert (arguments.scenario, arguments.meter) == ("soft_to_stiff", ["ros2", "run", "my", "cmv"])
    assert (arguments.clock, arguments.speed, arguments.limits) == ("sim", 5.0, None)
    every = dict.fromkeys(launch_file.FLAGS, "1") | {"scenario": "x", "clock": "real"}
    (process,) = launch_file._bench(every)
    arguments = bench._parser().parse_args(process.named["cmd"][4:])
    assert (arguments.limits, arguments.junit, arguments.out) == (Path("1"), Path("1"), Path("1"))


def test_it_declares_them_and_ends_with_the_bench(launch_file: SimpleNamespace) -> None:
    (entities,) = launch_file.generate_launch_description().arguments
    declared = [item.arguments[0] for item in entities if item.arguments]
    assert declared == ["scenario", *launch_file.FLAGS]
    # A scenario has to be given.
    assert "default_value" not in entities[0].named
    (process,) = launch_file._bench({**dict.fromkeys(launch_file.FLAGS, ""), "scenario": "x"})
    (shutdown,) = process.named["on_exit"]
    assert type(shutdown).__name__ == "Shutdown"
