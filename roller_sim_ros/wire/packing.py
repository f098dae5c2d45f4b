# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""CDR bytes of the messages that come hundreds of times a second, by one `struct.Struct` each.

Where the fields of a message lie depends on nothing but the lengths of its strings and arrays; the layout of some
lengths is made once. Types with lists of messages or of strings, which come seldom, have none.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from operator import attrgetter
from typing import Any

import numpy as np
from rosbags.interfaces import Nodetype

_HEADER = "4s"
_LITTLE_ENDIAN_CDR = b"\x00\x01\x00\x00"
"""What comes first; places count from behind it."""

_FORMATS = {
    "bool": "?",
    "byte": "B",
    "char": "B",
    "octet": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
_COUNT = "I"
_LAYOUTS = 64
"""Of one type, kept for further messages with the same lengths."""
_TEXTS = 64
"""Strings that come again and again, as frames do."""


class Packer:
    """Makes the bytes of messages of one type.

    Parameters
    ----------
    type_name : str
        As in ``package/msg/Name``.
    definitions : mapping
        Fields of all types, as `rosbags.typesys` has them.

    Raises
    ------
    ValueError
        If the type has lists of messages or of strings; later, if an array of fixed length has another one.
    """

    def __init__(self, type_name: str, definitions: Mapping[str, Any]) -> None:
        names: list[str] = []
        # One item for each value that is packed: its format, or the element's size where it is bytes.
        formats: list[str | int] = []
        self._variable: list[tuple[int, np.dtype[Any] | None, int | None]] = []
        for name, node, what, fixed in _leaves(type_name, "", definitions):
            if node == Nodetype.BASE and what != "string":
                names.append(name)
                formats.append(_FORMATS[what])
                continue
            if fixed is None:
                # This place is the count's.
                names.append(name)
                formats.append(_COUNT)
            dtype = None if what == "string" else np.dtype("<" + _FORMATS[what])
            self._variable.append((len(names), dtype, fixed))
            names.append(name)
            formats.append(1 if what == "string" else struct.calcsize(_FORMATS[what]))
        getter = attrgetter(*names)
        self._values = getter if len(names) > 1 else lambda message: (getter(message),)
        self._layout = lru_cache(_LAYOUTS)(lambda lengths: _layout(formats, lengths))

    def __call__(self, message: object) -> bytes:
        """Return a message as little-endian CDR with its four header bytes."""
        values = list(self._values(message))
        lengths = []
        for place, dtype, fixed in self._variable:
            value = values[place]
            if dtype is None:
                data = _text(value)
                count = len(data)
            else:
                if value.dtype is not dtype and value.dtype != dtype:
                    value = value.astype(dtype)
                data = value.tobytes()
                count = len(value)
            values[place] = data
            if fixed is None:
                values[place - 1] = count
            elif count != fixed:
                raise ValueError(f"an array of {count} elements: the message has {fixed}")
            lengths.append(len(data))
        return self._layout(tuple(lengths)).pack(_LITTLE_ENDIAN_CDR, *values)


def _leaves(
    type_name: str, before: str, definitions: Mapping[str, Any]
) -> Iterator[tuple[str, Nodetype, str, int | None]]:
    """Yield dotted name, kind, basic type and fixed length of all fields of a message and of those in it."""
    for name, (node, what) in definitions[type_name][1]:
        if node == Nodetype.NAME:
            yield from _leaves(what, f"{before}{name}.", definitions)
            continue
        if node == Nodetype.BASE:
            yield before + name, node, what[0], None
            continue
        (inner, of), length = what
        if inner != Nodetype.BASE or of[0] == "string":
            raise ValueError(f"{type_name}.{name}: a list of {of} has no layout")
        yield before + name, node, of[0], length if node == Nodetype.ARRAY else None


def _layout(formats: Sequence[str | int], lengths: Sequence[int]) -> struct.Struct:
    """Return the layout of values with some lengths in bytes: every number lies at a multiple of its size."""
    text, reached = "<" + _HEADER, 0
    variable = iter(lengths)
    for item in formats:
        size = item if isinstance(item, int) else struct.calcsize(f"<{item}")
        length = next(variable) if isinstance(item, int) else size
        # Behind an empty array there is no gap.
        gap = -reached % size if length else 0
        text += f"{gap}x" + (f"{length}s" if isinstance(item, int) else item)
        reached += gap + length
    return struct.Struct(text)


@lru_cache(_TEXTS)
def _text(value: str) -> bytes:
    return value.encode("utf-8") + b"\x00"
