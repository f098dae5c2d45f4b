# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The package as a whole: layers, versions, messages, installed commands, the dispatcher."""

from __future__ import annotations

import ast
import importlib
import itertools
import os
import re
import subprocess
import sys
import textwrap
import xml.etree.ElementTree
from pathlib import Path

import pytest

import roller_sim_ros
from roller_sim_ros import commands
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.share import share_directory

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "roller_sim_ros"
MESSAGES = sorted(path.stem for path in (ROOT / "msg").glob("*.msg"))
SERVICES = sorted(path.stem for path in (ROOT / "srv").glob("*.srv"))

# Of ROS, only these may be imported, and only by the modules named below.
ROS_PACKAGES = ("ament_index_python", *commands.ROS_MODULES)
ROS_COMMANDS = ("sim", "play")
ROS_CLIENT = "roller_sim_ros.panel.client"

# From the bottom up, as docs/architecture.md has it: a folder imports from itself and those before it.
# session.block is the one exception: the samples that a session yields, a plain record, are what
# sensors and meters look at.
RECORD = "session.block"
LAYERS = (
    "parameters",
    "soil_mechanics",
    "site",
    "half_space",
    "exciter",
    "drum_soil",
    "sensors",
    "meters",
    "session",
    "faults",
    "scenario",
    "wire",
    "emulation",
    "traces",
    "fmu",
    "analysis",
    "export",
    "offline",
    "sweep",
    "estimate",
    "validation",
    "figures",
    "score",
    "report",
    "node",
    "bench",
    "testing",
    "panel",
    "commands",
)


def modules() -> dict[str, Path]:
    """Every module of the source tree by its dotted name."""
    found = {}
    for path in sorted(SOURCE.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def may_import_ros(name: str) -> bool:
    return name.startswith("roller_sim_ros.node") or name in {
        ROS_CLIENT,
        *(f"roller_sim_ros.commands.{command}" for command in ROS_COMMANDS),
    }


def run(
    *arguments: str, cwd: Path | None = None, **environment: str
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        arguments,
        cwd=cwd,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


def test_everything_but_the_node_imports_without_ros() -> None:
    names = [
        name for name in modules() if not may_import_ros(name) and not name.endswith(".__main__")
    ]
    assert len(names) > 10
    program = textwrap.dedent(
        """
        import importlib, sys

        class NoRos:
            def find_spec(self, name, path=None, target=None):
                if any(name == ros or name.startswith(ros + ".") for ros in ROS):
                    raise ModuleNotFoundError(f"No module named {name!r} (blocked)", name=name)

        ROS = tuple(sys.argv[1].split(","))
        sys.meta_path.insert(0, NoRos())
        for name in sys.argv[2].split(","):
            try:
                importlib.import_module(name)
            except ModuleNotFoundError as error:
                print(f"{name}: {error}")
        """
    )
    result = run(sys.executable, "-c", program, ",".join(ROS_PACKAGES), ",".join(names))
    assert result.stdout == ""
    assert result.returncode == 0, result.stderr


def test_each_layer_imports_only_from_those_below() -> None:
    for name, path in modules().items():
        layer = name.split(".")[1] if "." in name else ""
        if layer not in LAYERS:
            continue
        allowed = LAYERS[: LAYERS.index(layer) + 1]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom):
                imported = [f"{node.module}.{alias.name}" for alias in node.names]
            elif isinstance(node, ast.Import):
                imported = [alias.name for alias in node.names]
            else:
                continue
            for target in imported:
                package, _, rest = target.partition(".")
                target_layer = rest.split(".")[0]
                if rest == RECORD or rest.startswith(f"{RECORD}."):
                    continue
                if package == "roller_sim_ros" and target_layer in LAYERS:
                    assert target_layer in allowed, f"{name} imports {target}"


def test_every_folder_with_modules_is_a_package() -> None:
    # A folder without __init__.py works from the source tree, and pip leaves it out.
    for path in modules().values():
        assert (path.parent / "__init__.py").is_file(), path.parent


def test_version_is_the_same_everywhere() -> None:
    package = xml.etree.ElementTree.parse(ROOT / "package.xml").getroot()
    assert package.findtext("version") == roller_sim_ros.__version__
    result = run(sys.executable, "setup.py", "--version", cwd=ROOT)
    assert result.stdout.split()[-1:] == [roller_sim_ros.__version__], result.stderr


def test_messages_are_generated_and_are_those_of_the_sources() -> None:
    assert len(MESSAGES) == 14
    generated = importlib.import_module("roller_sim_ros.msg")
    for name in MESSAGES:
        text = (ROOT / "msg" / f"{name}.msg").read_text(encoding="utf-8")
        lines = [line.split("#")[0].strip() for line in text.splitlines()]
        fields = [line.split() for line in lines if line and "=" not in line]
        constants = dict(re.findall(r"^u?int\d+ ([A-Z_0-9]+)=(\d+)", text, flags=re.MULTILINE))
        message = getattr(generated, name)()
        assert [field[1] for field in fields] == list(message.get_fields_and_field_types()), name
        for constant, value in constants.items():
            assert getattr(message, constant) == int(value), f"{name}.{constant}"


def test_services_are_generated_and_are_those_of_the_sources() -> None:
    assert len(SERVICES) == 10
    generated = importlib.import_module("roller_sim_ros.srv")
    for name in SERVICES:
        text = (ROOT / "srv" / f"{name}.srv").read_text(encoding="utf-8")
        service = getattr(generated, name)
        for part, section in zip(
            (service.Request, service.Response), text.split("---"), strict=True
        ):
            lines = [line.split("#")[0].strip() for line in section.splitlines()]
            fields = [line.split()[1] for line in lines if line and "=" not in line]
            assert fields == list(part.get_fields_and_field_types()), name
            constants = re.findall(r"^u?int\d+ ([A-Z_0-9]+)=(\d+)", section, flags=re.MULTILINE)
            for constant, value in constants:
                assert getattr(part, constant) == int(value), f"{name}.{constant}"


def test_services_have_the_fields_and_results_of_simulation_interfaces() -> None:
    # As simulation_interfaces 1.x has them, its package name replaced by this one's.
    services = importlib.import_module("roller_sim_ros.srv")
    generated = importlib.import_module("roller_sim_ros.msg")
    result, state = ("result", "roller_sim_ros/Result"), ("state", "roller_sim_ros/SimulationState")
    features = ("features", "roller_sim_ros/SimulatorFeatures")
    for name, (request, response) in {
        "StepSimulation": ([("steps", "uint64")], [result]),
        "ResetSimulation": ([("scope", "uint8")], [result]),
        "SetSimulationState": ([state], [result]),
        "GetSimulationState": ([], [state, result]),
        "GetSimulatorFeatures": ([], [features]),
    }.items():
        service = getattr(services, name)
        assert list(service.Request.get_fields_and_field_types().items()) == request, name
        assert list(service.Response.get_fields_and_field_types().items()) == response, name
    assert services.StepSimulation.Request().steps == 1
    assert list(generated.SimulatorFeatures.get_fields_and_field_types().items()) == [
        ("features", "sequence<uint16>"),
        ("spawn_formats", "sequence<string>"),
        ("custom_info", "string"),
    ]
    outcome = generated.Result
    assert (outcome.RESULT_FEATURE_UNSUPPORTED, outcome.RESULT_OK) == (0, 1)
    assert outcome.RESULT_NOT_FOUND == 2
    assert (outcome.RESULT_INCORRECT_STATE, outcome.RESULT_OPERATION_FAILED) == (3, 4)
    states = generated.SimulationState
    assert (states.STATE_STOPPED, states.STATE_PLAYING, states.STATE_PAUSED) == (0, 1, 2)
    assert states.STATE_QUITTING == 3


def test_every_field_of_the_messages_is_explained() -> None:
    paths = [ROOT / "msg" / f"{name}.msg" for name in MESSAGES]
    paths += [ROOT / "srv" / f"{name}.srv" for name in SERVICES]
    for path in paths:
        name, lines = path.stem, path.read_text(encoding="utf-8").splitlines()
        for before, line in itertools.pairwise(lines):
            if line and not line.startswith(("#", "---")):
                assert "#" in line or before.startswith("# ") or "=" in line, f"{name}: {line}"


def test_constants_of_the_messages_agree_with_each_other_and_with_the_code() -> None:
    from roller_sim_ros.meters.mode import Mode
    from roller_sim_ros.meters.status import Status
    from roller_sim_ros.msg import (
        AppliedChange,
        CompactionMeter,
        DrumAcceleration,
        DrumSoilState,
        ExciterState,
        SiteState,
    )
    from roller_sim_ros.session import Master
    from roller_sim_ros.session.block import AIR, LOADING, UNLOADING

    for mode in Mode:
        name = "MODE_UNKNOWN" if mode is Mode.UNKNOWN else mode.name
        for message in (CompactionMeter, DrumSoilState, SiteState):
            assert getattr(message, name) == mode.value
    for master in Master:
        for message in (AppliedChange, ExciterState, SiteState):
            assert getattr(message, f"MASTER_{master.name}") == master.value
    for status in Status:
        if status:
            assert getattr(CompactionMeter, str(status.name)) == status.value
    assert (DrumSoilState.LOADING, DrumSoilState.UNLOADING, DrumSoilState.AIR) == (
        LOADING,
        UNLOADING,
        AIR,
    )
    assert (DrumAcceleration.COORDINATE_ACCELERATION, DrumAcceleration.SPECIFIC_FORCE) == (0, 1)
    assert ExciterState.NONE == 0


@pytest.mark.parametrize("where", ["repository", "elsewhere"])
def test_messages_import_with_nothing_sourced(where: str, tmp_path: Path) -> None:
    result = run(
        sys.executable,
        "-c",
        "from roller_sim_ros.msg import DrumAcceleration; print(DrumAcceleration().sequence)",
        cwd=ROOT if where == "repository" else tmp_path,
        AMENT_PREFIX_PATH="",
    )
    assert result.stdout == "0\n", result.stderr


def executables() -> Path:
    """Where `ros2 run` looks: lib/<package> under an ament prefix, or under the one of make setup."""
    prefixes = [*os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep), sys.prefix]
    folders = [Path(prefix, "lib", "roller_sim_ros") for prefix in prefixes if prefix]
    return next((folder for folder in folders if folder.is_dir()), folders[-1])


@pytest.mark.parametrize("command", list(commands.COMMANDS))
def test_every_command_is_installed_and_has_a_help(command: str, tmp_path: Path) -> None:
    result = run(str(executables() / command), "--help", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert f"roller-sim {command}" in result.stdout


def test_console_script_is_installed() -> None:
    script = Path(sys.prefix, "bin", "roller-sim")
    if not script.exists() and os.environ.get("AMENT_PREFIX_PATH"):
        return  # built by colcon, which installs executables only
    assert run(str(script), "--version").stdout == f"roller-sim {roller_sim_ros.__version__}\n"


def test_share_directory_prefers_the_ament_index(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("AMENT_PREFIX_PATH", "")
    assert share_directory() == ROOT
    marker = tmp_path / "share" / "ament_index" / "resource_index" / "packages" / "roller_sim_ros"
    marker.parent.mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere{os.pathsep}{tmp_path}")
    assert share_directory() == ROOT
    marker.touch()
    assert share_directory() == tmp_path / "share" / "roller_sim_ros"


def test_a_pip_installation_finds_its_shared_files(tmp_path: Path) -> None:
    # As pip lays them out under a prefix: the modules some folders below it, the rest under share/.
    folder = tmp_path / "lib" / "python3" / "site-packages" / "roller_sim_ros"
    folder.mkdir(parents=True)
    for name in ("__init__.py", "errors.py", "share.py"):
        (folder / name).write_bytes((SOURCE / name).read_bytes())
    program = (
        "import sys; sys.prefix = '/nowhere'; from roller_sim_ros.share import share_directory;"
        "print(share_directory())"
    )

    def installed() -> subprocess.CompletedProcess[str]:
        return run(sys.executable, "-c", program, cwd=folder.parent, AMENT_PREFIX_PATH="")

    assert "install the package anew" in installed().stderr
    share = tmp_path / "share" / "roller_sim_ros"
    (share / "msg").mkdir(parents=True)
    assert installed().stdout.strip() == str(share)


class Command:
    """Stands for the module of a command."""

    def __init__(self, outcome: int | BaseException) -> None:
        self.outcome = outcome
        self.seen: list[str] = []

    def main(self, argv: list[str]) -> int:
        self.seen = argv
        if isinstance(self.outcome, BaseException):
            raise self.outcome
        return self.outcome


@pytest.mark.parametrize(
    ("outcome", "code", "error"),
    [
        (0, 0, ""),
        (3, 3, ""),
        (RollerSimError("no trace.mcap"), 1, "roller-sim run: error: no trace.mcap\n"),
        (KeyboardInterrupt(), 130, ""),
        (
            ModuleNotFoundError("No module named 'rclpy'", name="rclpy"),
            1,
            (
                "roller-sim run: error: needs ROS 2 and this package's messages, which pip does not bring: make setup "
                "in a clone of the repository brings both, colcon build the messages for a ROS 2 that is there "
                "(No module named 'rclpy')\n"
            ),
        ),
    ],
)
def test_dispatcher_turns_outcomes_into_exit_codes(
    outcome: int | BaseException,
    code: int,
    error: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    command = Command(outcome)
    monkeypatch.setitem(sys.modules, "roller_sim_ros.commands.run", command)  # type: ignore[arg-type]
    assert commands.main(["run", "--revolutions", "10"]) == code
    assert command.seen == ["--revolutions", "10"]
    assert capsys.readouterr().err == error


def test_dispatcher_does_not_hide_defects(monkeypatch: pytest.MonkeyPatch) -> None:
    defect = ModuleNotFoundError("No module named 'scpy'", name="scpy")
    monkeypatch.setitem(sys.modules, "roller_sim_ros.commands.run", Command(defect))  # type: ignore[arg-type]
    with pytest.raises(ModuleNotFoundError):
        commands.main(["run"])


def test_dispatcher_help_names_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert commands.main(["--help"]) == 0
    text = capsys.readouterr().out
    for command, line in commands.COMMANDS.items():
        assert re.search(rf"^  {command} +{re.escape(line)}$", text, flags=re.MULTILINE)


@pytest.mark.parametrize("arguments", [[], ["walk"]])
def test_dispatcher_refuses_what_it_does_not_know(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert commands.main(arguments) == 2
    assert "analyze" in capsys.readouterr().err


def test_setup_installs_anew_what_changes() -> None:
    # The folders that CMake installs are among those whose contents make the key of the stage.
    cmake = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    (line,) = re.findall(r"^install\(DIRECTORY ((?:\w+ ?)+)$", cmake, flags=re.MULTILINE)
    setup = (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8")
    (key,) = re.findall(
        r'^messages_key=\$\(hash_of "\$packages_key" ([^)]+)\)', setup, re.MULTILINE
    )
    folders = line.split()
    assert len(folders) > 3
    assert set(key.split()) >= {"CMakeLists.txt", "package.xml", "cmake", "msg", "srv", *folders}


def test_nothing_generated_is_tracked() -> None:
    if not (ROOT / ".git").exists():
        return
    tracked = run("git", "ls-files", cwd=ROOT).stdout.split()
    generated = [
        name for name in tracked if re.search(r"\.(pyc|so|mcap|egg-info)$|^(build|\.venv)/", name)
    ]
    assert generated == []
