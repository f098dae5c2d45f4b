# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Objects of the simulation as plain data and back, without running anything that the data says.

What a run remembers is a graph of objects: sensors and faults share their random numbers, the session knows the
faults. It is written as a list of nodes that refer to each other by their place, plain JSON values, and the bytes of
all arrays. On the way back only classes of this package are made, by name from a list of its folders, and none of
their code runs but the check of declared parameters.
"""

from __future__ import annotations

import dataclasses
import math
import sys
import threading
from collections import deque
from collections.abc import Callable
from enum import Enum
from typing import Any, cast

import numpy as np
from numpy.random import PCG64, Generator

from roller_sim_ros.parameters import ParameterGroup
from roller_sim_ros.site.declaration import Record

FOLDERS = (
    "drum_soil",
    "emulation",
    "exciter",
    "faults",
    "half_space",
    "meters",
    "parameters",
    "scenario",
    "sensors",
    "session",
    "site",
    "soil_mechanics",
)
"""Of the package: where the classes of a run's state are declared."""

_PACKAGE = "roller_sim_ros"
_PLAIN = (type(None), bool, int, float, str)
_DTYPES = ("bool", "uint8", "int32", "int64", "uint64", "float32", "float64", "complex128")
_CONTAINERS: dict[str, type[Any]] = {
    item.__name__: item for item in (tuple, list, dict, set, frozenset)
}
_LOCK = type(threading.Lock())

Nodes = list[list[Any]]
"""Each a kind and what that kind needs; values are plain or ``[place]`` of another node."""


class GraphError(Exception):
    """An object that cannot be written, or nodes that are none."""


def write(root: object) -> tuple[Nodes, bytes]:
    """Return the nodes of an object and of all that it refers to, and the bytes of their arrays.

    The last node says where the object is.

    Raises
    ------
    GraphError
        If something in it is of a class that is not one of this package's state.
    """
    writer = _Writer()
    place = writer.value(root)
    writer.nodes.append(["root", place])
    return writer.nodes, b"".join(writer.pieces)


def read(nodes: Nodes, data: bytes, check: Callable[[object], None] = lambda _: None) -> Any:
    """Return the object that `write` wrote.

    Parameters
    ----------
    nodes, data
        As `write` returned them.
    check : callable
        Called with every object of a class of the package, when all are filled; may raise what it likes.

    Raises
    ------
    GraphError
        If the nodes are not of the form, or name a class that is none of a run's state.
    ParameterError
        If a declared parameter in it has a value that it cannot have.
    """
    try:
        return _Reader(nodes, data).root(check)
    except (TypeError, ValueError, KeyError, IndexError, AttributeError, OverflowError) as error:
        raise GraphError(f"{type(error).__name__}: {error}") from error


class _Writer:
    def __init__(self) -> None:
        self.nodes: Nodes = []
        self.pieces: list[bytes] = []
        self._places: dict[int, int] = {}
        # Keeps what is only made on the way from being replaced by another object of the same id.
        self._kept: list[object] = []
        self._length = 0

    def value(self, item: Any) -> Any:
        """Return a value as it stands in a node."""
        if type(item) in _PLAIN:
            return item
        place = self._places.get(id(item))
        if place is None:
            place = self._node(item)
        return [place]

    def _node(self, item: Any) -> int:
        self._kept.append(item)
        kind = type(item)
        if isinstance(item, Enum):
            return self._add(item, ["enum", _name(kind), self.value(item.value)])
        if isinstance(item, np.ndarray | np.generic):
            return self._add(item, self._array(item))
        if kind is bytes:
            return self._add(item, ["bytes", *self._piece(item)])
        if kind in (tuple, frozenset):
            return self._add(item, [kind.__name__, [self.value(part) for part in item]])
        if isinstance(item, tuple):
            return self._add(item, ["named", _name(kind), [self.value(part) for part in item]])
        if kind is Generator:
            return self._add(item, ["random", _random_state(item)])
        if kind is _LOCK:
            return self._add(item, ["lock"])
        return self._changeable(item)

    def _changeable(self, item: Any) -> int:
        """Add what may refer back to itself: its place is known before its contents are."""
        kind = type(item)
        node: list[Any] = [kind.__name__ if kind in (list, set, dict, deque) else "object"]
        place = self._add(item, node)
        if kind in (list, set):
            node.append([self.value(part) for part in item])
        elif kind is dict:
            node.append([[self.value(key), self.value(part)] for key, part in item.items()])
        elif kind is deque:
            node += [item.maxlen, [self.value(part) for part in item]]
        else:
            node.append(_name(kind))
            node.append({key: self.value(part) for key, part in _attributes(item).items()})
        return place

    def _add(self, item: object, node: list[Any]) -> int:
        place = len(self.nodes)
        self.nodes.append(node)
        self._places[id(item)] = place
        return place

    def _array(self, item: Any) -> list[Any]:
        if item.dtype.name not in _DTYPES:
            raise GraphError(f"an array of {item.dtype}")
        kind = "array" if isinstance(item, np.ndarray) else "scalar"
        shape = list(np.shape(item))
        return [kind, item.dtype.name, shape, *self._piece(np.asarray(item).tobytes())]

    def _piece(self, data: bytes) -> tuple[int, int]:
        start = self._length
        self.pieces.append(data)
        self._length += len(data)
        return start, len(data)


class _Reader:
    """Makes all objects first, empty where they may refer to later ones, then fills those."""

    def __init__(self, nodes: Nodes, data: bytes) -> None:
        self._data = data
        self._made: list[Any] = []
        self._fill: list[Callable[[], None]] = []
        self._objects: list[Any] = []
        *items, (last, self._root) = nodes
        if last != "root":
            raise GraphError("there is no root")
        for kind, *rest in items:
            self._made.append(getattr(self, f"_make_{kind}")(*rest))

    def root(self, check: Callable[[object], None]) -> Any:
        for fill in self._fill:
            fill()
        for item in self._objects:
            if isinstance(item, ParameterGroup | Record):
                item.__post_init__()
            check(item)
        return self._value(self._root)

    def _value(self, item: Any) -> Any:
        if type(item) in _PLAIN:
            return item
        (place,) = item
        if place < 0:
            raise GraphError(f"there is no node {place}")
        return self._made[place]

    def _values(self, items: list[Any]) -> list[Any]:
        return [self._value(item) for item in items]

    def _make_enum(self, name: str, value: Any) -> Any:
        kind = _state_class(name)
        if not issubclass(kind, Enum):
            raise GraphError(f"{name} is no enumeration")
        return kind(self._value(value))

    def _make_bytes(self, start: int, length: int) -> bytes:
        if start < 0 or length < 0 or start + length > len(self._data):
            raise GraphError("bytes are missing")
        return self._data[start : start + length]

    def _make_array(self, dtype: str, shape: list[int], start: int, length: int) -> Any:
        if dtype not in _DTYPES:
            raise GraphError(f"an array of {dtype}")
        piece = self._make_bytes(start, length)
        if any(size < 0 for size in shape) or math.prod(shape) * np.dtype(dtype).itemsize != length:
            raise GraphError(f"{length} bytes are no {dtype} of shape {shape}")
        # A copy, for what the bytes belong to cannot be changed.
        return np.frombuffer(piece, dtype=dtype).reshape(shape).copy()

    def _make_scalar(self, dtype: str, shape: list[int], start: int, length: int) -> Any:
        return self._make_array(dtype, shape, start, length)[()]

    def _make_tuple(self, items: list[Any]) -> tuple[Any, ...]:
        return tuple(self._values(items))

    def _make_frozenset(self, items: list[Any]) -> frozenset[Any]:
        return frozenset(self._values(items))

    def _make_named(self, name: str, items: list[Any]) -> Any:
        kind = _state_class(name)
        if not issubclass(kind, tuple) or len(getattr(kind, "_fields", ())) != len(items):
            raise GraphError(f"{name} is no named tuple of {len(items)}")
        return tuple.__new__(kind, self._values(items))

    def _make_random(self, state: dict[str, Any]) -> Generator:
        bits = PCG64(0)
        bits.state = cast("Any", state)
        return Generator(bits)

    def _make_lock(self) -> Any:
        return threading.Lock()

    def _make_list(self, items: list[Any]) -> list[Any]:
        made: list[Any] = []
        self._fill.append(lambda: made.extend(self._values(items)))
        return made

    def _make_set(self, items: list[Any]) -> set[Any]:
        made: set[Any] = set()
        self._fill.append(lambda: made.update(self._values(items)))
        return made

    def _make_deque(self, most: int | None, items: list[Any]) -> deque[Any]:
        made: deque[Any] = deque(maxlen=most)
        self._fill.append(lambda: made.extend(self._values(items)))
        return made

    def _make_dict(self, items: list[list[Any]]) -> dict[Any, Any]:
        made: dict[Any, Any] = {}
        self._fill.append(lambda: made.update(dict(map(self._values, items))))
        return made

    def _make_object(self, name: str, attributes: dict[str, Any]) -> Any:
        kind = _state_class(name)
        if issubclass(kind, tuple | Enum | BaseException):
            raise GraphError(f"{name} is no plain class")
        made = object.__new__(kind)
        self._objects.append(made)
        if dataclasses.is_dataclass(made):
            declared = {field.name for field in dataclasses.fields(made)}
            if declared != attributes.keys():
                raise GraphError(f"{name} has {', '.join(sorted(declared))}")
        self._fill.append(
            lambda: _set_attributes(
                made, {key: self._value(value) for key, value in attributes.items()}
            )
        )
        return made


def _attributes(item: Any) -> dict[str, Any]:
    if hasattr(item, "__dict__"):
        return dict(vars(item))
    return {field.name: getattr(item, field.name) for field in dataclasses.fields(item)}


def _set_attributes(made: Any, attributes: dict[str, Any]) -> None:
    if hasattr(made, "__dict__"):
        vars(made).update(attributes)
        return
    for name, value in attributes.items():
        object.__setattr__(made, name, value)


def _name(kind: type[Any]) -> str:
    """Return the name by which a class of the state is found again."""
    name = f"{kind.__module__}:{kind.__qualname__}"
    if _state_class(name) is not kind:
        raise GraphError(f"{name} is no class of a run's state")
    return name


def _state_class(name: str) -> type[Any]:
    """Return a class of the package by its module and name; modules are not imported for it."""
    module_name, _, class_name = name.partition(":")
    package, _, rest = module_name.partition(".")
    module = sys.modules.get(module_name)
    kind = vars(module).get(class_name) if module is not None else None
    if (
        package != _PACKAGE
        or rest.partition(".")[0] not in FOLDERS
        or not isinstance(kind, type)
        or kind.__module__ != module_name
    ):
        raise GraphError(f"{name} is no class of a run's state")
    return kind


def _random_state(random: Generator) -> dict[str, Any]:
    state = random.bit_generator.state
    if state["bit_generator"] != PCG64.__name__:
        raise GraphError(f"random numbers of {state['bit_generator']}")
    return dict(state)
