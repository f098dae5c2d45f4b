# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A parameter as it is declared once: value, unit, bounds, doc, command-line flag.

Everything that shows or checks a parameter (ROS descriptors, YAML files, `--help`, the docs table) is
made from these declarations; no other place repeats a default or a bound.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import Field, dataclass, field, fields
from typing import Any, ClassVar, cast

from roller_sim_ros.errors import RollerSimError

Value = bool | int | float | str

_KEY = "roller_sim_ros.quantity"


_LONGEST_SHOWN = 120


def shown(value: object) -> str:
    """Return a value as a message shows it, in one line and shortened where it is long."""
    # Python refuses to write integers of thousands of digits.
    if isinstance(value, int) and value.bit_length() > 200:
        return f"an integer of {value.bit_length()} bits"
    try:
        text = repr(value)
    except ValueError:  # such an integer, in a list
        return f"a {type(value).__name__}"
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}…"


def shown_name(name: str) -> str:
    """Return a name as a message shows it: as it is, unless it is one that no parameter can have."""
    return name if name.isprintable() and 0 < len(name) <= _LONGEST_SHOWN else shown(name)


class ParameterError(RollerSimError):
    """A parameter has a value it cannot have.

    Attributes
    ----------
    name : str
        Full name of the parameter, as in ``soil.shear_modulus_pa``.
    value : object
        The refused value.
    reason : str
        What it must be, or why it cannot be what it is.
    """

    def __init__(self, name: str, value: object, reason: str) -> None:
        super().__init__(f"{shown_name(name)} = {shown(value)}: {reason}")
        self.name = name
        self.value = value
        self.reason = reason


@dataclass(frozen=True)
class Quantity:
    """What is known of one parameter beside its value.

    Attributes
    ----------
    unit : str
        SI unit, ``""`` for pure numbers and ``"text"`` is never used: strings have no unit.
    doc : str
        One sentence, shown wherever the parameter is shown.
    minimum, maximum : float or None
        Inclusive bounds.
    choices : tuple of str
        The allowed texts; empty when any is allowed.
    live : bool
        Whether it may change while the roller runs (at the next multiple of 128 samples).
    of_node : bool
        Whether the node may change it then, between two blocks; the roller itself knows nothing of it.
    flag : str
        Command-line flag in engineering units, ``""`` when there is none.
    scale : float
        SI value of one engineering unit of the flag.
    flag_unit : str
        The engineering unit.
    """

    unit: str
    doc: str
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    live: bool = False
    of_node: bool = False
    flag: str = ""
    scale: float = 1.0
    flag_unit: str = ""

    @property
    def changes(self) -> bool:
        """Whether the node takes another value while the roller runs."""
        return self.live or self.of_node

    def bounds_text(self) -> str:
        """Return the bounds as a reader wants them, in SI units."""
        if self.choices:
            return " | ".join(self.choices)
        unit = f" {self.unit}" if self.unit else ""
        if self.minimum is not None and self.maximum is not None:
            return f"{self.minimum:g} … {self.maximum:g}{unit}"
        if self.minimum is not None:
            return f"at least {self.minimum:g}{unit}"
        if self.maximum is not None:
            return f"at most {self.maximum:g}{unit}"
        return "any"


def parameter(default: Value, unit: str, doc: str, **facts: Any) -> Any:
    """Declare a field of a `ParameterGroup`; `facts` are the other attributes of `Quantity`."""
    return field(default=default, metadata={_KEY: Quantity(unit=unit, doc=doc, **facts)})


def check(name: str, quantity: Quantity, default: Value, value: object) -> Value:
    """Return `value` as the type of `default`, or raise.

    Raises
    ------
    ParameterError
        If the type is wrong, the number is not finite or out of bounds, or the text is no choice.
    """
    if isinstance(default, bool):
        if not isinstance(value, bool):
            raise ParameterError(name, value, "must be true or false")
        return value
    if isinstance(default, str):
        if not isinstance(value, str):
            raise ParameterError(name, value, "must be a text")
        if quantity.choices and value not in quantity.choices:
            raise ParameterError(name, value, f"must be one of {', '.join(quantity.choices)}")
        return value
    if isinstance(value, bool) or not isinstance(value, int | float):
        of = f" of {quantity.unit}" if quantity.unit else ""
        raise ParameterError(name, value, f"must be a number{of}")
    if isinstance(default, int) and isinstance(value, float) and not value.is_integer():
        raise ParameterError(name, value, "must be a whole number")
    if isinstance(value, float) and not math.isfinite(value):
        raise ParameterError(name, value, "must be finite")
    unit = f" {quantity.unit}" if quantity.unit else ""
    if quantity.minimum is not None and value < quantity.minimum:
        raise ParameterError(name, value, f"must be at least {quantity.minimum:g}{unit}")
    if quantity.maximum is not None and value > quantity.maximum:
        raise ParameterError(name, value, f"must be at most {quantity.maximum:g}{unit}")
    if isinstance(default, int):
        return int(value)
    try:
        return float(value)
    except OverflowError:  # an integer beyond all floats
        raise ParameterError(name, value, "must be finite") from None


@dataclass(frozen=True)
class ParameterGroup:
    """Base of the parameter dataclasses: checked once, on construction.

    Raises
    ------
    ParameterError
        On construction, if a value breaks its declaration.
    """

    group: ClassVar[str] = ""

    def __post_init__(self) -> None:
        for name, quantity, default in declared(type(self)):
            value = check(f"{self.group}.{name}", quantity, default, getattr(self, name))
            object.__setattr__(self, name, value)


def declared(group: type[ParameterGroup]) -> Iterator[tuple[str, Quantity, Value]]:
    """Yield (name, quantity, default) of each parameter of a group, in the order of declaration."""
    for item in fields(group):
        yield item.name, quantity_of(item), cast(Value, item.default)


def quantity_of(item: Field[Any]) -> Quantity:
    """Return the declaration that `parameter` attached to a dataclass field."""
    return cast(Quantity, item.metadata[_KEY])
