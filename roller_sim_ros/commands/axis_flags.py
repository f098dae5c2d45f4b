# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Flags that take one value, a list or a range: the axes of a sweep."""

from __future__ import annotations

import argparse

import numpy as np

from roller_sim_ros.commands.flags import (
    add_flag,
    bounds_text,
    given_value,
    help_text,
    metavar,
    si_value,
)
from roller_sim_ros.parameters import PARAMETERS, ParameterError, Quantity, Value, lookup
from roller_sim_ros.parameters.quantity import check
from roller_sim_ros.sweep.axis import Axis, axis_names
from roller_sim_ros.sweep.errors import AxisError

_DIGITS = 12
"""The values of a range are rounded to so many digits: each is then a number that can be given to another command."""

_MOST_VALUES = 1_000_000


def add_axis_flags(parser: argparse.ArgumentParser, exclude: tuple[str, ...]) -> None:
    """Add the flag of every parameter; those that can be an axis take several values.

    Parameters
    ----------
    parser : argparse.ArgumentParser
        Where they go, in one group for each group of parameters.
    exclude : tuple of str
        Dotted names of parameters that the command has no use for.
    """
    groups: dict[str, argparse._ArgumentGroup] = {}
    axes = axis_names()
    for name, (quantity, default) in PARAMETERS.items():
        if not quantity.flag or name in exclude:
            continue
        title = name.partition(".")[0].replace("_", " ")
        if title not in groups:
            groups[title] = parser.add_argument_group(title)
        if name in axes:
            groups[title].add_argument(
                quantity.flag,
                dest=_destination(name),
                metavar=f"{metavar(quantity, default)}[,…|:…:N]",
                help=help_text(quantity, default),
            )
        else:
            add_flag(groups[title], name, quantity, default)


def given_axes(arguments: argparse.Namespace) -> tuple[tuple[Axis, ...], dict[str, Value]]:
    """Return the axes, and {dotted name: SI value} of what has one value, that the flags give.

    Raises
    ------
    AxisError
        If a text is malformed.
    ParameterError
        If a value breaks its declaration; the message speaks of the flag and its unit.
    """
    axes: list[Axis] = []
    values: dict[str, Value] = {}
    names = axis_names()
    for name, (quantity, default) in PARAMETERS.items():
        if name not in names:
            value = given_value(arguments, name, quantity, default)
            if value is not None:
                values[name] = value
            continue
        text = getattr(arguments, _destination(name), None)
        if text is None:
            continue
        several = parse_values(name, text)
        if len(several) == 1:
            values[name] = several[0]
        else:
            axes.append(Axis(name, several))
    return tuple(axes), values


def parse_values(name: str, text: str) -> tuple[float, ...]:
    """Return the SI values that a text gives: a number, a list ``28,30`` or a range ``15:40:101``.

    Parameters
    ----------
    name : str
        Dotted name of the parameter.
    text : str
        Numbers in the unit of the parameter's flag. A range is first and last value and how many there are, evenly
        spaced.

    Raises
    ------
    AxisError
        If the text is malformed.
    ParameterError
        If a value is out of bounds.
    """
    quantity, _ = lookup(name)
    numbers = _range(quantity, text) if ":" in text else _list(quantity, text)
    return tuple(_checked(name, number) for number in numbers)


def axis_of_flag(flag: str) -> str:
    """Return the dotted name of the parameter of a flag, with or without its dashes.

    Raises
    ------
    AxisError
        If there is no such flag of an axis.
    """
    for name in axis_names():
        if PARAMETERS[name][0].flag == f"--{flag.removeprefix('--')}":
            return name
    flags = ", ".join(PARAMETERS[name][0].flag[2:] for name in axis_names())
    raise AxisError(f"--along {flag}: there is no such axis; there are {flags}")


def _destination(name: str) -> str:
    return f"axis {name}"


def _checked(name: str, number: float) -> float:
    quantity, default = lookup(name)
    try:
        return float(check(name, quantity, default, si_value(number, quantity, default)))
    except ParameterError:
        must = f"must be {bounds_text(quantity, default)}"
        raise ParameterError(quantity.flag, number, must) from None


def _list(quantity: Quantity, text: str) -> list[float]:
    return [_number(quantity, text, part) for part in text.split(",")]


def _range(quantity: Quantity, text: str) -> list[float]:
    parts = text.split(":")
    if len(parts) != 3:
        raise AxisError(
            f"{quantity.flag} {text}: a range is first:last:count, as in {_example(quantity)}"
        )
    first, last = _number(quantity, text, parts[0]), _number(quantity, text, parts[1])
    try:
        count = int(parts[2])
    except ValueError:
        raise AxisError(
            f"{quantity.flag} {text}: the count {parts[2]!r} is no whole number"
        ) from None
    if count < 1:
        raise AxisError(f"{quantity.flag} {text}: a grid with {count} values has no points")
    if count > _MOST_VALUES:
        raise AxisError(f"{quantity.flag} {text}: at most {_MOST_VALUES} values are possible")
    if (first == last and count > 1) or (first != last and count == 1):
        raise AxisError(f"{quantity.flag} {text}: {count} values do not fit between the two ends")
    return [float(f"{value:.{_DIGITS}g}") for value in np.linspace(first, last, count)]


def _number(quantity: Quantity, text: str, part: str) -> float:
    try:
        return float(part)
    except ValueError:
        unit = f" of {quantity.flag_unit}" if quantity.flag_unit else ""
        raise AxisError(
            f"{quantity.flag} {text}: {part!r} is no number{unit}; as in {_example(quantity)} or 28,30"
        ) from None


def _example(quantity: Quantity) -> str:
    low, high = quantity.minimum, quantity.maximum
    return f"{quantity.flag} {low}:{high}:11"
