# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Reads a scenario file; whatever is wrong in it is told by file and line."""

from __future__ import annotations

from collections.abc import Collection
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.parameters.quantity import shown, shown_name
from roller_sim_ros.scenario.build import configuration_of, programme_of, site_of
from roller_sim_ros.scenario.catalogue import check_instruments
from roller_sim_ros.scenario.nodes import (
    ScenarioError,
    compose,
    entries,
    line_of,
    load_text,
    scalar,
)
from roller_sim_ros.scenario.scenario import Scenario
from roller_sim_ros.site.declaration import TAG, Member, Record, members

_SAID_AS = {"soil": "ground"}
"""Sections of the parameters and where a scenario says them."""


def read_scenario(path: Path) -> Scenario:
    """Return the scenario of a file, checked as a whole: it can be run.

    Raises
    ------
    ScenarioError
        If anything is wrong; the message begins with file and line.
    """
    return parse_scenario(load_text(path), path)


def parse_scenario(text: str, path: Path) -> Scenario:
    """Return the scenario of a text, checked as a whole.

    Parameters
    ----------
    text : str
        YAML.
    path : pathlib.Path
        The file that it is from, for messages.

    Raises
    ------
    ScenarioError
        If anything is wrong.
    """
    reader = _Reader(path)
    scenario = reader.scenario(compose(path, text), text)
    try:
        configuration_of(scenario)
        site_of(scenario)
        programme_of(scenario)
        check_instruments(scenario.sensors, scenario.faults)
    except ParameterError as error:
        raise ScenarioError(path, reader.line(error.name), _told(error.name, error)) from None
    return scenario


class _Reader:
    """Makes records of nodes, and remembers on which line each key is.

    Parameters
    ----------
    path : pathlib.Path
        The file, for messages.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lines: dict[str, int] = {"": 1}

    def scenario(self, root: Node, text: str) -> Scenario:
        """Return the scenario of the root node."""
        if not isinstance(root, MappingNode):
            raise ScenarioError(
                self._path, line_of(root), "holds no scenario, as in lane: {length_m: 20}"
            )
        values = self._values(Scenario, root, "")
        scenario: Scenario = self._made(
            Scenario, {**values, "path": str(self._path), "text": text}, ""
        )
        return scenario

    def line(self, name: str) -> int:
        """Return the line of a parameter by its dotted name, or of the nearest key around it."""
        section, dot, rest = name.partition(".")
        said = f"{_SAID_AS.get(section, section)}{dot}{rest}"
        for candidate in (f"parameters.{name}", said):
            if candidate in self._lines:
                return self._lines[candidate]
        while said and said not in self._lines:
            said = said.rpartition(".")[0]
        return self._lines[said]

    def _values(self, record: type[Record], node: MappingNode, at: str) -> dict[str, Any]:
        """Return {field: value} of the keys of a mapping."""
        known = {member.name: member for member in members(record)}
        values: dict[str, Any] = {}
        for key, key_node, value_node in entries(self._path, node):
            if key == TAG and TAG not in known:
                continue
            if key not in known:
                where = f"{at}: " if at else ""
                raise ScenarioError(
                    self._path,
                    line_of(key_node),
                    f"{where}unknown key {key!r}{_near(key, known)}",
                )
            name = f"{at}.{key}" if at else key
            self._lines[name] = line_of(key_node)
            values[key] = self._value(known[key], value_node, name)
        for member in known.values():
            if member.required and member.name not in values:
                where = f"{at}: " if at else ""
                raise ScenarioError(
                    self._path,
                    self._lines[at],
                    f"{where}{member.name} is missing: {member.declaration.doc}",
                )
        return values

    def _value(self, member: Member, node: Node, at: str) -> Any:
        if self._is_null(node):
            if member.optional:
                return None
            raise ScenarioError(self._path, line_of(node), f"{at} has no value")
        if member.kind is dict:
            return self._free(node, at)
        if member.several:
            if not isinstance(node, SequenceNode):
                raise ScenarioError(self._path, line_of(node), f"{at}: must be a list, as in - …")
            return tuple(
                self._record(member, element, f"{at}[{index}]")
                for index, element in enumerate(node.value)
            )
        if issubclass(member.kind, Record):
            return self._record(member, node, at)
        if not isinstance(node, ScalarNode):
            raise ScenarioError(self._path, line_of(node), f"{at}: must be a single value")
        value: Any = scalar(self._path, node)
        if member.kind is str:
            value = node.value
        try:
            return member.checked(value)
        except ParameterError as error:
            raise ScenarioError(self._path, line_of(node), _told(at, error)) from None

    def _record(self, member: Member, node: Node, at: str) -> Any:
        self._lines.setdefault(at, line_of(node))
        if not isinstance(node, MappingNode):
            raise ScenarioError(self._path, line_of(node), f"{at}: must be keys with values")
        registry = member.declaration.registry
        record = member.kind
        if registry is not None:
            record = registry[self._kind(node, at, registry)]
        return self._made(record, self._values(record, node, at), at)

    def _kind(self, node: MappingNode, at: str, registry: Collection[str]) -> str:
        for key, _, value_node in entries(self._path, node):
            if key == TAG:
                kind = value_node.value if isinstance(value_node, ScalarNode) else ""
                if kind in registry:
                    return str(kind)
                raise ScenarioError(
                    self._path,
                    line_of(value_node),
                    f"{at}.{TAG}: there is no {kind!r}{_near(kind, registry)}",
                )
        raise ScenarioError(
            self._path,
            line_of(node),
            f"{at}: {TAG} is missing; it is one of {', '.join(registry)}",
        )

    def _made(self, record: type[Record], values: dict[str, Any], at: str) -> Any:
        try:
            return record(**values)
        except ParameterError as error:
            name = f"{at}.{error.name}" if at else error.name
            raise ScenarioError(self._path, self.line(name), _told(name, error)) from None

    def _free(self, node: Node, at: str) -> dict[str, Any]:
        if not isinstance(node, MappingNode):
            raise ScenarioError(self._path, line_of(node), f"{at}: must be keys with values")
        values = {}
        for key, key_node, value_node in entries(self._path, node):
            self._lines[f"{at}.{key}"] = line_of(key_node)
            if not isinstance(value_node, ScalarNode) or self._is_null(value_node):
                raise ScenarioError(
                    self._path,
                    line_of(key_node),
                    f"{shown_name(f'{at}.{key}')}: must be a single value",
                )
            values[key] = scalar(self._path, value_node)
        return values

    def _is_null(self, node: Node) -> bool:
        return isinstance(node, ScalarNode) and scalar(self._path, node) is None


def _told(name: str, error: ParameterError) -> str:
    """Return the error under the name that the file has for it; of a missing value only the reason."""
    value = "" if error.value is None else f" = {shown(error.value)}"
    return f"{shown_name(name)}{value}: {error.reason}"


def _near(key: str, known: Collection[str]) -> str:
    near = get_close_matches(key, known, n=1, cutoff=0.5)
    return f"; did you mean {near[0]}?" if near else f"; there are {', '.join(known)}"
