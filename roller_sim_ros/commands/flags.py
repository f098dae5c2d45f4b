# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Command-line flags made from the declarations of the parameters, in engineering units."""

from __future__ import annotations

import argparse
from collections.abc import Collection
from pathlib import Path

from roller_sim_ros.parameters import PARAMETERS, ParameterError, Quantity, Value
from roller_sim_ros.parameters.quantity import check


def add_params_flag(parser: argparse.ArgumentParser) -> None:
    """Add ``--params``, a parameter file."""
    parser.add_argument(
        "--params",
        metavar="FILE",
        type=Path,
        help="YAML file with parameters in SI units, as a ROS 2 node reads it or plainly nested; flags win over it",
    )


def add_parameter_flags(parser: argparse.ArgumentParser, exclude: Collection[str] = ()) -> None:
    """Add the flag of every parameter that has one.

    A flag that is not given is None, so that what another source says of the parameter holds.

    Parameters
    ----------
    parser : argparse.ArgumentParser
        Where they go, in one group for each group of parameters.
    exclude : collection of str
        Dotted names of parameters whose flags the command does not want or adds itself.
    """
    groups: dict[str, argparse._ArgumentGroup] = {}
    for name, (quantity, default) in PARAMETERS.items():
        if not quantity.flag or name in exclude:
            continue
        title = name.partition(".")[0]
        if title not in groups:
            groups[title] = parser.add_argument_group(title.replace("_", " "))
        add_flag(groups[title], name, quantity, default)


def add_flag(group: argparse._ArgumentGroup, name: str, quantity: Quantity, default: Value) -> None:
    """Add the flag of one declaration, a parameter's or another's; not given it is None.

    Parameters
    ----------
    group : argparse._ArgumentGroup
        Where it goes.
    name : str
        Dotted name.
    quantity, default : Quantity, Value
        The declaration.
    """
    group.add_argument(
        quantity.flag,
        dest=_destination(name),
        metavar=metavar(quantity, default),
        type=_text_or_number(default),
        help=help_text(quantity, default),
    )


def given_values(arguments: argparse.Namespace) -> dict[str, Value]:
    """Return {dotted name: SI value} of the flags that were given.

    Raises
    ------
    ParameterError
        If a value breaks its declaration; the message speaks of the flag and its unit.
    """
    given = {
        name: given_value(arguments, name, quantity, default)
        for name, (quantity, default) in PARAMETERS.items()
    }
    return {name: value for name, value in given.items() if value is not None}


def given_value(
    arguments: argparse.Namespace, name: str, quantity: Quantity, default: Value
) -> Value | None:
    """Return the SI value of a flag added by `add_flag`, None when it was not given.

    Raises
    ------
    ParameterError
        If the value breaks its declaration; the message speaks of the flag and its unit.
    """
    given = getattr(arguments, _destination(name), None)
    if given is None:
        return None
    value = given if isinstance(default, str) else si_value(given, quantity, default)
    try:
        return check(name, quantity, default, value)
    except ParameterError:
        must = f"must be {bounds_text(quantity, default)}"
        raise ParameterError(quantity.flag, given, must) from None


def _destination(name: str) -> str:
    return f"parameter {name}"


def si_value(given: float, quantity: Quantity, default: Value) -> float:
    """Return the SI value of a number in the flag's unit."""
    # Divided where that is exact: 1.6 mm shall be 0.0016 m, not the neighbour of it.
    inverse = 1.0 / quantity.scale
    value = given / inverse if inverse.is_integer() else given * quantity.scale
    return int(value) if isinstance(default, int) and value.is_integer() else value


def _text_or_number(default: Value) -> type[str] | type[float]:
    return str if isinstance(default, str) else float


def metavar(quantity: Quantity, default: Value) -> str:
    """Return what stands for the value in ``--help``."""
    if quantity.choices:
        return "|".join(quantity.choices)
    if isinstance(default, str):
        return "PATH" if quantity.flag == "--record" else "TEXT"
    unit = quantity.flag_unit
    return unit.upper() if unit.isalpha() and unit.isascii() else "X"


def _engineering(value: float, quantity: Quantity) -> str:
    unit = f" {quantity.flag_unit}" if quantity.flag_unit else ""
    return f"{value / quantity.scale:g}{unit}"


def bounds_text(quantity: Quantity, default: Value) -> str:
    """Return what a value of the flag may be, in the flag's unit."""
    if quantity.choices:
        return f"one of {', '.join(quantity.choices)}"
    whole = "a whole number, " if isinstance(default, int) else ""
    low, high = quantity.minimum, quantity.maximum
    if low is not None and high is not None:
        unit = f" {quantity.flag_unit}" if quantity.flag_unit else ""
        return f"{whole}{low / quantity.scale:g} … {high / quantity.scale:g}{unit}"
    if low is not None:
        return f"{whole}at least {_engineering(low, quantity)}"
    if high is not None:
        return f"{whole}at most {_engineering(high, quantity)}"
    return f"{whole}finite"


def help_text(quantity: Quantity, default: Value) -> str:
    """Return the help of the flag."""
    text = quantity.doc
    if not isinstance(default, str):
        text += f"; {bounds_text(quantity, default)}"
        text += f" (default: {_engineering(float(default), quantity)})"
    elif default:
        text += f" (default: {default})"
    return text.replace("%", "%%")
