# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What is imported is declared, for pip and for rosdep, and what is declared is imported."""

from __future__ import annotations

import ast
import re
import sys
import xml.etree.ElementTree
from collections.abc import Iterator
from functools import lru_cache
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = xml.etree.ElementTree.parse(ROOT / "package.xml").getroot()
TEXT = (ROOT / "package.xml").read_text(encoding="utf-8")
OWN = {"benchmarks", "examples", "fuzz", "roller_sim_ros", "soak", "tests", "tools"}

# Where the key is not python3- and the module's name in lower case.
KEYS = {"PIL": "python3-pil", "yaml": "python3-yaml"}

# Imported by name only, so that they are no condition for starting, and what calls for them.
BY_NAME = {"distributed": "roller_sim_ros/commands/sweep.py"}

# Of one command or of a test plugin: whoever uses it has it.
EXTRAS = {"pyarrow", "pythonfmu", "pytest"}

# Used by their command or as a plugin, not imported.
NOT_IMPORTED = {"pytest-timeout"}


@lru_cache
def imported(folder: str) -> frozenset[str]:
    """Top-level modules that the files of a folder import, beside Python's and the repository's own."""

    def names() -> Iterator[str]:
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    yield from (alias.name for alias in node.names)
                elif isinstance(node, ast.ImportFrom) and not node.level and node.module:
                    yield node.module

    modules = {name.split(".")[0] for name in names()}
    return frozenset(modules - set(sys.stdlib_module_names) - OWN)


def keys(*kinds: str) -> set[str]:
    """Dependencies of package.xml of some kinds."""
    return {item.text or "" for kind in kinds for item in PACKAGE.iter(kind)}


def without_key(marker: str) -> set[str]:
    """The distributions that a comment of package.xml names after a marker."""
    (line,) = re.findall(rf"{marker}[^:]*:\s+([^\n]*?)(?: -->)?\n", TEXT)
    return set(line.split())


@lru_cache
def distributions() -> dict[str, str]:
    """Modules, and the distribution that brings each, as they are installed here."""
    found = packages_distributions().items()
    return {name: canonicalize_name(brought_by[0]) for name, brought_by in found}


def distribution(module: str) -> str:
    """The distribution that brings a module."""
    return distributions().get(module, module)


def required(file: str) -> set[str]:
    """Distributions that a file of requirements names."""
    lines = (ROOT / "requirements" / file).read_text(encoding="utf-8").splitlines()
    return {
        canonicalize_name(Requirement(line).name)
        for line in lines
        if line and not line.startswith("#")
    }


def undeclared(modules: frozenset[str], declared: set[str], by_pip: set[str]) -> set[str]:
    """Modules for which there is neither a ROS package nor a key nor a word that pip brings it."""
    return {
        name
        for name in modules
        if name not in declared
        and KEYS.get(name, f"python3-{name.lower()}") not in declared
        and distribution(name) not in by_pip
    }


RUNTIME = ("depend", "exec_depend")
BY_PIP = without_key("may not depend on")
ONE_COMMAND = without_key("For one command each")


def test_package_xml_has_all_that_is_imported() -> None:
    modules = imported("roller_sim_ros") | imported("launch") | BY_NAME.keys()
    declared, by_pip = keys(*RUNTIME), BY_PIP | ONE_COMMAND | {"pytest"}
    assert {"rclpy", "python3-numpy"} <= declared
    assert not undeclared(modules, declared, by_pip)


def test_package_xml_has_all_that_the_tests_import() -> None:
    modules = imported("tests") | imported("examples")
    declared = keys(*RUNTIME, "test_depend")
    assert not undeclared(modules, declared, BY_PIP | ONE_COMMAND | without_key("likewise without"))


def test_package_xml_has_no_python_key_that_nothing_imports() -> None:
    modules = imported("roller_sim_ros") | imported("tests") | imported("launch")
    wanted = {KEYS.get(name, f"python3-{name.lower()}") for name in modules}
    unused = {key for key in keys(*RUNTIME, "test_depend") if key.startswith("python3-")} - wanted
    assert unused == {f"python3-{name}" for name in NOT_IMPORTED}


def test_what_has_a_key_is_not_said_to_have_none() -> None:
    declared = {key.removeprefix("python3-") for key in keys(*RUNTIME, "test_depend")}
    everywhere = BY_PIP | ONE_COMMAND | without_key("likewise without")
    assert not everywhere & declared


def test_pip_gets_what_is_imported_and_nothing_else() -> None:
    ros = {key for key in keys(*RUNTIME) if not key.startswith("python3-")}
    modules = (imported("roller_sim_ros") | BY_NAME.keys()) - ros - EXTRAS
    assert {distribution(name) for name in modules} == required("python.txt")
    assert required("python.txt") >= BY_PIP


def test_development_gets_what_the_tests_import() -> None:
    ros = {key for key in keys(*RUNTIME, "test_depend") if not key.startswith("python3-")}
    modules = imported("tests") | imported("examples")
    there = required("python.txt") | required("development.txt")
    assert {distribution(name) for name in modules - ros} <= there


@pytest.mark.parametrize(("module", "file"), BY_NAME.items())
def test_what_is_imported_by_name_is(module: str, file: str) -> None:
    assert f'import_module("{module}")' in (ROOT / file).read_text(encoding="utf-8")


def test_messages_are_those_that_the_wire_and_the_node_name() -> None:
    # Types that are found by their names, as in "sensor_msgs/msg/Imu".
    text = "\n".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "roller_sim_ros").rglob("*.py")
    )
    named = set(re.findall(r'"([a-z_]+_(?:msgs|interfaces))/(?:msg/)?[A-Z]\w+"', text))
    assert {"sensor_msgs", "nav_msgs"} <= named
    assert named <= keys(*RUNTIME)
