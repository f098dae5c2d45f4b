# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The wheel as its user has it: installed into a fresh environment without ROS 2, its commands run there.

In `make test` what the wheel requires is linked from the environment of `make setup`, and kernels run as plain Python:
no network, no compiling. `make wheel` does the same with everything installed by pip, and compiled.
"""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
import textwrap
import venv
import zipfile
from collections.abc import Iterable
from email.message import Message
from email.parser import Parser
from importlib.metadata import Distribution, distribution
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import roller_sim_ros
from roller_sim_ros import commands
from roller_sim_ros.jit import DISABLE_VARIABLE
from tests.unit.test_package import ROS_PACKAGES

ROOT = Path(__file__).resolve().parents[2]
KEPT_IN = os.environ.get("ROLLER_SIM_WHEEL_TO")
"""Where `make wheel` wants the wheel."""
BY_PIP = KEPT_IN is not None
"""Whether pip installs what the wheel requires."""

NOT_SOURCES = (".git", ".venv", "build", "dist", "install", "log", "*.egg-info", "__pycache__")

NEED_ROS = {
    "sim": (),
    "panel": (),
    "play": ("trace.mcap",),
    "bench": ("soft_to_stiff",),
}
"""The commands that need ROS 2, with the least that they take."""

ELSEWHERE = {
    "roller_sim_ros.fmu.slave": "pythonfmu",
    "roller_sim_ros.testing": "pytest",
    "roller_sim_ros.testing.plugin": "pytest",
}
"""Modules that run inside of something else, which is there then."""


def closure(requires: Iterable[str], extras: Iterable[str] = ()) -> dict[str, Distribution]:
    """All that is required, directly or not, as it is installed beside these tests."""
    found: dict[str, Distribution] = {}
    seen: set[tuple[str, frozenset[str]]] = set()

    def add(lines: Iterable[str], wanted: Iterable[str]) -> None:
        for line in lines:
            need = Requirement(line)
            marker = need.marker
            if marker and not any(marker.evaluate({"extra": extra}) for extra in ("", *wanted)):
                continue
            key = (canonicalize_name(need.name), frozenset(need.extras))
            if key in seen:
                continue
            seen.add(key)
            there = distribution(need.name)
            assert need.specifier.contains(there.version, prereleases=True), line
            found[key[0]] = there
            add(there.requires or (), need.extras)

    add(requires, extras)
    return found


class User:
    """An environment of its own and an empty folder; nothing of this process's environment but PATH."""

    def __init__(self, wheel: Path, folder: Path) -> None:
        self.wheel, self.environment, self.home = wheel, folder / "environment", folder / "home"
        self.home.mkdir()
        venv.create(self.environment, symlinks=True, with_pip=False)
        (self._site,) = self.environment.glob("lib/python*/site-packages")
        self.install()

    def install(self, *extras: str) -> None:
        """Install the wheel and what it and its extras require."""
        wheel = f"{self.wheel}[{','.join(extras)}]" if extras else str(self.wheel)
        how = ("-c", "requirements/constraints.txt") if BY_PIP else ("--no-deps", "--no-index")
        pip("--python", self.python, "install", "--quiet", *how, wheel)
        if BY_PIP:
            pip("--python", self.python, "check")
            return
        with zipfile.ZipFile(self.wheel) as archive:
            requires = metadata(archive).get_all("Requires-Dist")
        for there in closure(requires or (), extras).values():
            for name in {path.parts[0] for path in there.files or ()} - {"..", "__pycache__"}:
                if not (self._site / name).exists():
                    (self._site / name).symlink_to(str(there.locate_file(name)))

    @property
    def python(self) -> str:
        """The environment's Python."""
        return str(self.environment / "bin" / "python")

    def run(self, *command: str) -> subprocess.CompletedProcess[str]:
        """Run a program of the environment in the user's folder."""
        program, *arguments = command
        plain = {} if BY_PIP else {DISABLE_VARIABLE: "1"}
        return subprocess.run(
            [str(self.environment / "bin" / program), *arguments],
            cwd=self.home,
            env={"PATH": os.environ["PATH"], "HOME": str(self.home), **plain},
            capture_output=True,
            text=True,
            check=False,
        )

    def roller_sim(self, *arguments: str) -> str:
        """Run a command that has to work; its output."""
        result = self.run("roller-sim", *arguments)
        assert result.returncode == 0, result.stderr
        return result.stdout


def pip(*arguments: str) -> None:
    # A colcon workspace that is sourced is on PYTHONPATH, where pip would find the package installed.
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input", *arguments],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def metadata(archive: zipfile.ZipFile) -> Message:
    (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
    return Parser().parsestr(archive.read(name).decode())


def sources() -> list[str]:
    """Files of the repository as it stands, without what is made in it."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(
            ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=True,
        )
        return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]
    ignore = shutil.ignore_patterns(*NOT_SOURCES)
    return [
        path.relative_to(ROOT).as_posix()
        for path in ROOT.rglob("*")
        if path.is_file() and not ignore("", path.relative_to(ROOT).parts)
    ]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of a clean copy."""
    folder = tmp_path_factory.mktemp("wheel")
    for name in sources():
        copy = folder / "copy" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, copy)
    how = () if BY_PIP else ("--no-index", "--no-build-isolation")
    pip("wheel", "--quiet", "--no-deps", *how, "--wheel-dir", str(folder), str(folder / "copy"))
    (made,) = folder.glob("*.whl")
    if KEPT_IN is not None:
        Path(KEPT_IN).mkdir(exist_ok=True)
        shutil.copy2(made, KEPT_IN)
    return made


@pytest.fixture(scope="module")
def user(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> User:
    return User(wheel, tmp_path_factory.mktemp("user"))


def test_the_wheel_says_what_it_is_and_holds_what_the_repository_shares(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        facts, names = metadata(archive), archive.namelist()
    assert (facts["Name"], facts["Version"]) == ("roller_sim_ros", roller_sim_ros.__version__)
    assert facts["Requires-Python"] == ">=3.10"
    assert facts.get_payload().startswith("# roller_sim_ros")
    assert any(name.endswith("/LICENSE") for name in names)
    shared = f"{wheel.name.rsplit('-py3', 1)[0]}.data/data/share/roller_sim_ros/"
    in_wheel = {name.removeprefix(shared) for name in names if name.startswith(shared)}
    folders = ("config", "launch", "layouts", "msg", "scenarios", "security", "srv")
    in_sources = {
        name for name in sources() if name.startswith(tuple(f"{folder}/" for folder in folders))
    }
    assert in_wheel == {"package.xml", *in_sources} - {"config/README.md"}
    modules = {name for name in names if name.startswith("roller_sim_ros/")}
    assert modules == {name for name in sources() if name.startswith("roller_sim_ros/")}


def test_there_is_no_ros_and_all_else_can_be_imported(user: User) -> None:
    program = textwrap.dedent(
        """
        import importlib, pkgutil, roller_sim_ros
        print(roller_sim_ros.__file__)
        for module in pkgutil.walk_packages(roller_sim_ros.__path__, "roller_sim_ros."):
            if not module.name.endswith("__main__"):
                try:
                    importlib.import_module(module.name)
                except ModuleNotFoundError as error:
                    print(module.name, error.name)
        """
    )
    result = user.run("python", "-c", program)
    assert result.returncode == 0, result.stderr
    where, *failures = result.stdout.splitlines()
    assert user.environment in Path(where).parents
    assert len(failures) > 5
    for failure in failures:
        name, missing = failure.split()
        assert missing.startswith(ROS_PACKAGES) or ELSEWHERE.get(name) == missing, failure


def test_help_names_the_commands(user: User) -> None:
    text = user.roller_sim("--help")
    assert all(f"  {name} " in text for name in commands.COMMANDS)
    assert user.roller_sim("--version") == f"roller-sim {roller_sim_ros.__version__}\n"
    assert (
        "soft_to_stiff.yaml"
        in user.run(
            "python",
            "-c",
            "from roller_sim_ros.scenario.shipped import scenario_path; print(scenario_path('soft_to_stiff'))",
        ).stdout
    )


def test_a_run_is_recorded_evaluated_shown_exported_and_computed_again(
    user: User, tmp_path: Path
) -> None:
    run = ("run", "--shear-modulus-mpa", "35", "--plastic-mm", "0.8", "--revolutions", "28")
    there = json.loads(user.roller_sim(*run, "--record", "trace.mcap", "--json", "-"))
    assert commands.main([*run, "--json", str(tmp_path / "here.json")]) == 0
    here = json.loads((tmp_path / "here.json").read_text(encoding="utf-8"))
    for value in ("cmv", "force_ratio_max", "acceleration_max_g"):
        assert there[value] == pytest.approx(here[value], rel=1e-6)
    said = user.roller_sim("analyze", "trace.mcap")
    assert "3584 samples" in said
    assert "no gaps" in said
    user.roller_sim("report", "trace.mcap", "-o", "report.html")
    assert "</html>" in (user.home / "report.html").read_text(encoding="utf-8")
    user.roller_sim("export", "trace.mcap", "meters.csv")
    with (user.home / "meters.csv").open(encoding="utf-8", newline="") as text:
        assert len(list(csv.reader(text))) > 28
    assert user.roller_sim("replay", "trace.mcap").startswith("identical")


@pytest.mark.parametrize("command", NEED_ROS)
def test_what_needs_ros_says_in_a_line_where_it_comes_from(user: User, command: str) -> None:
    result = user.run("roller-sim", command, *NEED_ROS[command])
    assert result.returncode != 0
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"roller-sim {command}: error: needs ROS 2")
    assert "make setup" in line
    assert "colcon" in line


def test_extras_bring_what_is_asked_for(user: User) -> None:
    user.roller_sim("run", "--revolutions", "4", "--record", "short.mcap")
    tries = {"parquet": ("export", "short.mcap", "out.parquet"), "fmu": ("fmu", "out.fmu")}
    for arguments in tries.values():
        refused = user.run("roller-sim", *arguments)
        assert refused.returncode == 1
        (line,) = refused.stderr.splitlines()
        assert "pip install" in line
    user.install(*tries)
    for extra, arguments in tries.items():
        user.roller_sim(*arguments)
        assert (user.home / f"out.{extra}").stat().st_size > 0
