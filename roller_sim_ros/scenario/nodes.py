# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""YAML as nodes that know their lines.

PyYAML, on purpose: ROS 2 brings it everywhere, the parameter files are read with it, and it gives the node tree
with the place of every node, from which the records are made without an untyped copy in between. The parser in
Python is used, not libyaml's: a hostile depth of nesting is an exception there, not the end of the process.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Value

LARGEST_BYTES = 1_000_000
_NULL = ("", "~", "null", "Null", "NULL")
_BOOLEANS = {
    "true": True,
    "True": True,
    "TRUE": True,
    "false": False,
    "False": False,
    "FALSE": False,
}
_INTEGER = re.compile(r"[-+]?[0-9]+")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_SPECIAL = re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)")
_STANDARD_TAG = "tag:yaml.org,2002:"


class ScenarioError(RollerSimError):
    """A scenario file cannot be read, or something in it is wrong.

    Attributes
    ----------
    path : pathlib.Path
        The file.
    line : int
        Line, from 1; 0 where the file as a whole is meant.
    """

    def __init__(self, path: Path, line: int, reason: str) -> None:
        place = f"{path}:{line}" if line else str(path)
        super().__init__(f"{place}: {reason}")
        self.path = path
        self.line = line


def load_text(path: Path) -> str:
    """Return the text of a file.

    Raises
    ------
    ScenarioError
        If it cannot be read, or is no text of a scenario's size.
    """
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_BYTES + 1)
    except OSError as error:
        raise ScenarioError(path, 0, f"cannot be read: {error.strerror or error}") from None
    if len(data) > LARGEST_BYTES:
        raise ScenarioError(path, 0, f"is larger than {LARGEST_BYTES} bytes: no scenario")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise ScenarioError(path, line, "is no text in UTF-8") from None


def compose(path: Path, text: str) -> Node:
    """Return the root node of a text.

    Raises
    ------
    ScenarioError
        If it is no YAML, empty, more than one document, or nested without end.
    """
    try:
        root = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, max(0, error.position)) + 1
        raise ScenarioError(path, line, f"is no YAML: {error.reason}") from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        problem = error.problem or error.context or "not understood"
        line = mark.line + 1 if mark is not None else 1
        raise ScenarioError(path, line, f"is no YAML: {problem}") from None
    except RecursionError:
        raise ScenarioError(path, 1, "is nested too deeply") from None
    if root is None:
        raise ScenarioError(path, 1, "holds no scenario, as in lane: {length_m: 20}")
    return root


def line_of(node: Node) -> int:
    """Return the line on which a node begins, from 1."""
    return int(node.start_mark.line) + 1


def entries(path: Path, node: MappingNode) -> Iterator[tuple[str, Node, Node]]:
    """Yield (key, node of the key, node of the value) of a mapping.

    Raises
    ------
    ScenarioError
        If a key is no text, or comes twice.
    """
    seen: dict[str, int] = {}
    for key_node, value_node in node.value:
        if not isinstance(key_node, ScalarNode):
            raise ScenarioError(path, line_of(key_node), "a key must be a text")
        key = key_node.value
        if key in seen:
            raise ScenarioError(
                path, line_of(key_node), f"key {key!r} is there already, in line {seen[key]}"
            )
        seen[key] = line_of(key_node)
        yield key, key_node, value_node


def scalar(path: Path, node: ScalarNode) -> Value | None:
    """Return the value of a scalar as YAML 1.2 reads it, with ROS 2's 35e6 as a number.

    Raises
    ------
    ScenarioError
        If it has a tag of its own.
    """
    if not node.tag.startswith(_STANDARD_TAG):
        raise ScenarioError(path, line_of(node), f"tag {node.tag} means nothing here")
    text: str = node.value
    if node.style is not None:
        return text
    if text in _NULL:
        return None
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    # Python refuses to convert integers of thousands of digits.
    if _INTEGER.fullmatch(text) and len(text) < 300:
        return int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    if _SPECIAL.fullmatch(text):
        return float(text.replace(".", ""))
    return text
