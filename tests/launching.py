# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Stands for launch and launch_ros, which are not among the wheels: what the launch files use of them, as they have it.

The names of the arguments, what must be given by name, and how a command line is put together are those of launch and
launch_ros from Humble to Kilted, so that a description which works here works there.
"""

from __future__ import annotations

import os
import runpy
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "launch"


class LaunchContext:
    """Holds the arguments as they are known so far, and what came of the description."""

    def __init__(self, folder: Path, given: dict[str, str]) -> None:
        self.folder = folder
        self.launch_configurations = dict(given)
        self.started: list[ExecuteProcess] = []


class LaunchConfiguration:
    """Stands for the value of an argument."""

    def __init__(self, variable_name: str) -> None:
        self._name = variable_name

    def perform(self, context: LaunchContext) -> str:
        """Return the value; there must be one."""
        return context.launch_configurations[self._name]


class ExecutableInPackage:
    """Stands for a program under lib/<package>, as ``ros2 run`` finds it."""

    def __init__(self, executable: str, package: str) -> None:
        self._executable, self._package = executable, package

    def perform(self, context: LaunchContext) -> str:  # noqa: ARG002
        """Return its path."""
        prefixes = [*os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep), sys.prefix]
        for prefix in filter(None, prefixes):
            path = Path(prefix, "lib", self._package, self._executable)
            if path.is_file():
                return str(path)
        raise AssertionError(f"{self._executable} is not installed")


@dataclass
class LaunchDescription:
    """Holds what is to be visited, in this order."""

    initial_entities: Sequence[Any]

    def execute(self, context: LaunchContext) -> Iterable[Any]:  # noqa: ARG002
        """Return what is to be visited."""
        return self.initial_entities


class DeclareLaunchArgument:
    """Declares an argument: it must have been given, or have a default."""

    def __init__(
        self,
        name: str,
        *,
        default_value: str | None = None,
        description: str | None = None,
        choices: list[str] | None = None,
    ) -> None:
        assert default_value is None or isinstance(default_value, str), name
        assert choices is None or default_value in choices, name
        self.name, self.default_value = name, default_value
        self.description, self.choices = description, choices

    def execute(self, context: LaunchContext) -> None:
        """Set the default where nothing was given."""
        if self.name not in context.launch_configurations:
            if self.default_value is None:
                raise RuntimeError(f'Required launch argument "{self.name}" was not provided.')
            context.launch_configurations[self.name] = self.default_value
        value = context.launch_configurations[self.name]
        assert isinstance(value, str)
        if self.choices is not None and value not in self.choices:
            raise RuntimeError(f'Argument "{self.name}" provided value "{value}" is not valid.')


class OpaqueFunction:
    """Calls a function, whose result is visited."""

    def __init__(self, *, function: Callable[[LaunchContext], list[Any] | None]) -> None:
        self._function = function

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Call it."""
        return self._function(context)


@dataclass
class PythonLaunchDescriptionSource:
    """A launch file."""

    launch_file_path: str


class IncludeLaunchDescription:
    """Visits another launch file, once the arguments are set; they stay set."""

    def __init__(
        self,
        launch_description_source: PythonLaunchDescriptionSource,
        *,
        launch_arguments: Iterable[tuple[str, str]] | None = None,
    ) -> None:
        self._source = launch_description_source
        self._arguments = tuple(launch_arguments or ())

    def execute(self, context: LaunchContext) -> list[Any]:
        """Set the arguments and read the file."""
        assert all(isinstance(value, str) for _, value in self._arguments)
        context.launch_configurations.update(self._arguments)
        return [_read(Path(self._source.launch_file_path))["generate_launch_description"]()]


@dataclass
class Shutdown:
    """Ends the launch."""

    reason: str = field(default="reason not given", kw_only=True)


class ExecuteProcess:
    """Starts a program."""

    def __init__(
        self,
        *,
        cmd: Iterable[str | ExecutableInPackage],
        output: str = "log",
        emulate_tty: bool = False,
        on_exit: list[Any] | None = None,
    ) -> None:
        self.cmd, self.output, self.emulate_tty = list(cmd), output, emulate_tty
        self.on_exit = on_exit
        self.command: list[str] = []

    def execute(self, context: LaunchContext) -> None:
        """Note the command line."""
        self.command = [
            item if isinstance(item, str) else item.perform(context) for item in self.cmd
        ]
        context.started.append(self)


class Node(ExecuteProcess):
    """Starts a program that is a node."""

    def __init__(
        self,
        *,
        executable: str,
        package: str,
        name: str | None = None,
        namespace: str | None = None,
        parameters: list[str | dict[str, Any]] | None = None,
        arguments: Iterable[str] | None = None,
        output: str = "log",
        emulate_tty: bool = False,
    ) -> None:
        program = ExecutableInPackage(executable=executable, package=package)
        cmd = [program, *(arguments or ()), "--ros-args"]
        if name is not None:
            cmd += ["-r", f"__node:={name}"]
        super().__init__(cmd=cmd, output=output, emulate_tty=emulate_tty)
        self._name, self._namespace, self._parameters = name, namespace, parameters or []

    def execute(self, context: LaunchContext) -> None:
        """Note the command line, with namespace and parameters as arguments for ROS 2."""
        whose = "/**"
        if self._namespace is not None:
            namespace = f"/{self._namespace.strip('/')}"
            self.cmd += ["-r", f"__ns:={namespace}"]
            whose = f"{namespace.rstrip('/')}/{self._name}" if self._name else "/**"
        for parameters in self._parameters:
            path = parameters
            if isinstance(parameters, dict):
                path = str(context.folder / f"launch_params_{len(context.started)}")
                content = {whose: {"ros__parameters": parameters}}
                Path(path).write_text(yaml.dump(content), encoding="utf-8")
            # launch leaves a missing file out, with a warning.
            assert Path(str(path)).is_file()
            self.cmd += ["--params-file", str(path)]
        super().execute(context)


MODULES = {
    "launch": (LaunchContext, LaunchDescription),
    "launch.actions": (
        DeclareLaunchArgument,
        ExecuteProcess,
        IncludeLaunchDescription,
        OpaqueFunction,
        Shutdown,
    ),
    "launch.launch_description_sources": (PythonLaunchDescriptionSource,),
    "launch.substitutions": (LaunchConfiguration,),
    "launch_ros": (),
    "launch_ros.actions": (Node,),
    "launch_ros.substitutions": (ExecutableInPackage,),
}


@contextmanager
def _stood_in_for() -> Iterator[None]:
    before = {name: sys.modules.get(name) for name in MODULES}
    for name, classes in MODULES.items():
        module = ModuleType(name)
        vars(module).update({item.__name__: item for item in classes})
        sys.modules[name] = module
    try:
        yield
    finally:
        for name, module_before in before.items():
            del sys.modules[name]
            if module_before is not None:
                sys.modules[name] = module_before


def _read(path: Path) -> dict[str, Any]:
    with _stood_in_for():
        return runpy.run_path(str(path))


def declared(name: str) -> list[DeclareLaunchArgument]:
    """Return the arguments of a launch file, as ``ros2 launch --show-args`` does."""
    description = _read(FOLDER / f"{name}.launch.py")["generate_launch_description"]()
    entities = description.initial_entities
    return [item for item in entities if isinstance(item, DeclareLaunchArgument)]


def launched(name: str, folder: Path, **given: str) -> list[ExecuteProcess]:
    """Return what ``ros2 launch roller_sim_ros NAME.launch.py ARGUMENT:=VALUE …`` starts, in this order.

    Files for parameters are written to `folder`.
    """
    context = LaunchContext(folder, given)

    def visit(entity: Any) -> None:
        for item in entity.execute(context) or ():
            visit(item)

    visit(_read(FOLDER / f"{name}.launch.py")["generate_launch_description"]())
    return context.started
