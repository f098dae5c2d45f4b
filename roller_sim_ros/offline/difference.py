# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where two messages differ: field by field, sample by sample."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple

import numpy as np
from rosbags.serde import SerdeError

from roller_sim_ros.wire.types import decode


class Difference(NamedTuple):
    """The first difference of a trace and its replay.

    Attributes
    ----------
    topic : str
        As recorded.
    sample : int
        Index of the sample that the differing value belongs to, or with which its block begins.
    time_s : float
        Time of the block's first sample since the start of the run.
    field : str
        Name in the message; empty where a whole message is too much or too few.
    recorded, replayed : str
        Both values as texts.
    """

    topic: str
    sample: int
    time_s: float
    field: str
    recorded: str
    replayed: str


def differing_field(recorded: bytes, replayed: bytes, type_name: str) -> tuple[str, str, str, int]:
    """Return name and both values of the first field that differs, and its place in an array (0 for no array).

    Parameters
    ----------
    recorded, replayed : bytes
        CDR, of one type, not the same.
    type_name : str
        As in ``package/msg/Name``.
    """
    try:
        pairs = zip(
            _leaves(decode(recorded, type_name)), _leaves(decode(replayed, type_name)), strict=True
        )
        for (name, place, one), (other_name, _, other) in pairs:
            if name != other_name:
                return name, "another number of values", "", place
            if not _same(one, other):
                return name, _text(one), _text(other), place
    except (SerdeError, ValueError) as error:
        # Arrays of different lengths, or bytes that are no message.
        return "", f"{len(recorded)} bytes ({error})", f"{len(replayed)} bytes", 0
    return "", "bytes between the fields", "", 0


def _leaves(value: Any, name: str = "", place: int = 0) -> Iterator[tuple[str, int, Any]]:
    """Yield name, place in the outermost array and value of all that is plain in a message."""
    if is_dataclass(value):
        for item in fields(value):
            if not item.name.startswith("_"):
                dot = "." if name else ""
                yield from _leaves(getattr(value, item.name), f"{name}{dot}{item.name}", place)
    elif isinstance(value, np.ndarray | list):
        for index, element in enumerate(value):
            yield from _leaves(element, f"{name}[{index}]", index)
    else:
        yield name, place, value


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, float | np.floating):
        return bool(np.asarray(one).tobytes() == np.asarray(other).tobytes())
    return bool(one == other)


def _text(value: Any) -> str:
    if isinstance(value, str):
        return repr(value)
    return str(value)
