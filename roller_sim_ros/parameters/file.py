# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parameter files: YAML as a ROS 2 node reads it, or plainly nested; SI units, every name checked."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters.configuration import Configuration, lookup
from roller_sim_ros.parameters.quantity import ParameterError, Value, check

NODE = "roller_sim"
"""The node whose parameters are read; those of other nodes in the file are left alone."""

_ROS = "ros__parameters"
_OF_ANY_ROS_NODE = ("autostart", "qos_overrides", "start_type_description_service", "use_sim_time")
"""Parameters of the node that say nothing of the roller."""


class ParameterFileError(RollerSimError):
    """A parameter file cannot be read, or something in it is wrong.

    Attributes
    ----------
    path : pathlib.Path
        The file.
    """

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = path


def read_parameters(path: Path) -> dict[str, Value]:
    """Return {dotted name: SI value} of a parameter file, each checked and fit to be applied together.

    Parameters
    ----------
    path : pathlib.Path
        YAML: ``/**: {ros__parameters: {soil: {shear_modulus_pa: 50.0e+6}}}`` as ROS 2 has it, or
        ``soil: {shear_modulus_pa: 50.0e+6}``. Dotted names (``soil.shear_modulus_pa: …``) are taken in both.

    Raises
    ------
    ParameterFileError
        If the file cannot be read, is no YAML, names an unknown parameter, or holds a value that is refused.
    """
    content = _load(path)
    try:
        values = {
            name: check(name, *lookup(name, value), value)
            for section in _sections(path, content)
            for name, value in _flat(section)
        }
        Configuration().changed(values)
    except ParameterError as error:
        raise ParameterFileError(path, str(error)) from None
    return values


def _load(path: Path) -> Mapping[str, Any]:
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), Loader=_Loader)
    except OSError as error:
        raise ParameterFileError(path, f"cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise ParameterFileError(path, "is no text in UTF-8") from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f" in line {mark.line + 1}" if mark is not None else ""
        problem = getattr(error, "problem", None) or "not understood"
        raise ParameterFileError(path, f"is no YAML{where}: {problem}") from None
    except RecursionError:
        raise ParameterFileError(path, "is nested too deeply") from None
    except (ValueError, TypeError, AttributeError) as error:
        # What PyYAML raises for a value that is not what its form or its tag says, as 2001-99-99.
        raise ParameterFileError(path, f"holds a value that is none: {error}") from None
    if not isinstance(content, Mapping) or not content:
        raise ParameterFileError(
            path, "holds no parameters, as in soil: {shear_modulus_pa: 50.0e+6}"
        )
    return content


def _sections(path: Path, content: Mapping[str, Any]) -> Sequence[Mapping[str, Any]]:
    """Return the mappings of parameters that are meant for the roller."""
    nodes = dict(_nodes(content, ""))
    if not nodes:
        return [content]
    own = [
        {name: value for name, value in section.items() if name not in _OF_ANY_ROS_NODE}
        for node, section in nodes.items()
        if node.rpartition("/")[2] in ("*", "**", NODE)
    ]
    if not own:
        raise ParameterFileError(
            path, f"holds no parameters for {NODE} or /**, only for {', '.join(nodes)}"
        )
    return own


def _nodes(content: Mapping[str, Any], prefix: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield (node, parameters) of a file in the form of ROS 2; namespaces may be nested."""
    for key, value in content.items():
        name = f"{prefix}/{str(key).strip('/')}"
        if isinstance(value, Mapping):
            if isinstance(value.get(_ROS), Mapping):
                yield name, value[_ROS]
            else:
                yield from _nodes(value, name)


def _flat(section: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in section.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            yield from _flat(value, f"{name}.")
        else:
            yield name, value


class _Loader(yaml.SafeLoader):
    """Reads numbers as ROS 2 does: 35e6 is one, which YAML 1.1 takes for a text. Like it, refuses aliases.

    A file of a few lines could stand for values without end by them.
    """

    def compose_node(self, parent: yaml.Node | None, index: int) -> yaml.Node | None:
        """Return the next node."""
        if self.check_event(yaml.AliasEvent):
            mark = self.peek_event().start_mark  # type: ignore[no-untyped-call]
            raise yaml.composer.ComposerError(None, None, "aliases are not taken", mark)
        return super().compose_node(parent, index)


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+"),
    list("-+.0123456789"),
)
