# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a message is the meter's value, its time, its flag and its alarm, found by the fields' names."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.samples import stamp_ns

VALUE_FIELDS = ("cmv", "data", "value")
"""Names that a value has where nothing is said, the first that is there."""

NONE = "-"
"""Chosen as a field: none, though there is one of the usual name."""

FLAG_FIELD, ALARM_FIELD, RMV_FIELD = "status", "double_jump", "rmv"


@dataclass(frozen=True)
class Choice:
    """Which fields are meant; empty: found by their names, ``-``: none.

    Attributes
    ----------
    value : str
        The meter's value, dotted where it is nested: ``data``, ``cmv``, ``result.cmv``.
    flag : str
        Not to be trusted when it is true or not 0.
    alarm : str
        Whether the drum double-jumps: true or false, or an RMV.
    """

    value: str = ""
    flag: str = ""
    alarm: str = ""


@dataclass(frozen=True)
class Given:
    """One message of the meter.

    Attributes
    ----------
    value : float
        NaN: the meter says that it has none.
    flagged : bool
        Whether it says that the value is not to be trusted.
    alarm : float
        1 or 0, or an RMV, see `MeterTopic.alarm_is_rmv`; NaN where the meter says nothing of it.
    stamp_ns : int or None
        Time of the value, ns since the epoch; None: the message has none.
    """

    value: float
    flagged: bool
    alarm: float
    stamp_ns: int | None


class MeterTopic:
    """Reads the messages of a meter, of any type that holds a number.

    Parameters
    ----------
    name, type_name : str
        Topic and type.
    sample : object
        One of its messages.
    choice : Choice
        Which fields are meant.

    Attributes
    ----------
    field, flag, alarm : str
        Fields that are read; empty where there is none.
    alarm_is_rmv : bool
        Whether the alarm is an RMV.
    stamped : bool
        Whether the messages say what time they are of.

    Raises
    ------
    BagError
        If a field is not there, is no number, or must be chosen.
    """

    def __init__(self, name: str, type_name: str, sample: Any, choice: Choice) -> None:
        self.name = name
        self.type_name = type_name
        numbers = dict(_numbers(sample))
        self.field = choice.value or self._value_field(numbers)
        self.flag = _chosen(choice.flag, (FLAG_FIELD,), numbers)
        self.alarm = _chosen(choice.alarm, (ALARM_FIELD, RMV_FIELD), numbers)
        for field in (self.field, self.flag, self.alarm):
            if field and field not in numbers:
                raise BagError(
                    f"{name} ({type_name}) has no number {field!r}; it has {', '.join(numbers) or 'none'}"
                )
        self.alarm_is_rmv = bool(self.alarm) and not isinstance(
            numbers[self.alarm], bool | np.bool_
        )
        self.stamped = hasattr(getattr(sample, "header", None), "stamp")

    def _value_field(self, numbers: dict[str, Any]) -> str:
        for field in VALUE_FIELDS:
            if field in numbers:
                return field
        found = [name for name, value in numbers.items() if isinstance(value, float | np.floating)]
        if len(found) == 1:
            return found[0]
        raise BagError(
            f"{self.name} ({self.type_name}): which number is the value? Choose one with --field: "
            f"{', '.join(numbers) or 'there is none'}"
        )

    def read(self, message: Any) -> Given:
        """Return what a message says."""
        alarm = _get(message, self.alarm) if self.alarm else math.nan
        return Given(
            value=_get(message, self.field),
            flagged=bool(self.flag) and _get(message, self.flag) != 0.0,
            alarm=alarm,
            stamp_ns=stamp_ns(message) if self.stamped else None,
        )


def _chosen(choice: str, names: tuple[str, ...], numbers: dict[str, Any]) -> str:
    """Return the field that was chosen, else the first of some that is there, else nothing."""
    if choice:
        return "" if choice == NONE else choice
    return next((name for name in names if name in numbers), "")


def _numbers(message: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Yield (dotted name, value) of all single numbers of a message, its header left out."""
    if not is_dataclass(message):
        return
    for item in fields(message):
        value = getattr(message, item.name)
        if item.name == "header" or item.name.startswith("__"):
            continue
        if is_dataclass(value):
            yield from _numbers(value, f"{prefix}{item.name}.")
        # Constants are fields with a fixed value, in capitals.
        elif (
            isinstance(value, bool | int | float | np.number | np.bool_) and not item.name.isupper()
        ):
            yield f"{prefix}{item.name}", value


def _get(message: Any, name: str) -> float:
    for part in name.split("."):
        message = getattr(message, part)
    return float(message)
