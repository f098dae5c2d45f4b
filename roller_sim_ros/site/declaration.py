# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Records whose fields are declared once: what a scenario file may say, its bounds, docs and JSON Schema.

A field's name is its key in the file, with its unit (``length_m``, ``shear_modulus_mpa``). Its annotation
is its type: ``float``, ``int``, ``bool``, ``str``, one of these ``| None``, another record, or a tuple
of records.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, fields
from types import NoneType
from typing import Any, get_args, get_origin, get_type_hints

from roller_sim_ros.parameters import ParameterError, lookup

_KEY = "roller_sim_ros.declaration"
TAG = "kind"
"""Key that says which record of a registry is meant."""


@dataclass(frozen=True)
class Declaration:
    """What is known of a field beside its type.

    Attributes
    ----------
    doc : str
        One sentence without a full stop.
    minimum, maximum : float or None
        Inclusive bounds.
    choices : tuple of str
        The allowed texts; empty when any is allowed.
    registry : mapping or None
        Records by the value of their key ``kind``, for a field that takes any of them.
    free : bool
        Whether the field is a mapping of any names to plain values.
    source : str
        Where the default is from; empty where there is nothing to be sourced.
    verified : bool
        Whether it was read there.
    """

    doc: str
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    registry: Mapping[str, type[Record]] | None = None
    free: bool = False
    source: str = ""
    verified: bool = False

    @property
    def bounds_text(self) -> str:
        """The bounds as a reader wants them."""
        if self.choices:
            return f"one of {', '.join(self.choices)}"
        if self.minimum is not None and self.maximum is not None:
            return f"{self.minimum:g} … {self.maximum:g}"
        if self.minimum is not None:
            return f"at least {self.minimum:g}"
        if self.maximum is not None:
            return f"at most {self.maximum:g}"
        return ""


def declare(doc: str, *, default: Any = MISSING, **facts: Any) -> Any:
    """Declare a field of a `Record`; `facts` are the other attributes of `Declaration`.

    Parameters
    ----------
    doc : str
        One sentence without a full stop.
    default : object
        Its value where the file says nothing; the field is required when left out.
    **facts
        As in `Declaration`.
    """
    metadata = {_KEY: Declaration(doc, **facts)}
    if isinstance(default, dict):
        return dataclasses.field(default_factory=default.copy, metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


def like(name: str, doc: str = "") -> Any:
    """Declare an optional field by the parameter it sets, bounds in the unit of the parameter's flag.

    Parameters
    ----------
    name : str
        Dotted name of the parameter.
    doc : str
        Instead of the parameter's.
    """
    quantity, _ = lookup(name)
    bounds = {
        side: None if value is None else float(f"{value / quantity.scale:.12g}")
        for side, value in (("minimum", quantity.minimum), ("maximum", quantity.maximum))
    }
    return declare(doc or quantity.doc, default=None, choices=quantity.choices, **bounds)


@dataclass(frozen=True)
class Record:
    """Base of all declared records: checked once, on construction.

    Raises
    ------
    ParameterError
        On construction, if a value breaks its declaration; `name` is that of the field.
    """

    def __post_init__(self) -> None:
        for item in members(type(self)):
            object.__setattr__(self, item.name, item.checked(getattr(self, item.name)))


@dataclass(frozen=True)
class Member:
    """A field of a record, its annotation taken apart.

    Attributes
    ----------
    name : str
        Key.
    declaration : Declaration
        What was declared.
    kind : type
        ``float``, ``int``, ``bool``, ``str``, ``dict`` or a `Record`, of the elements where there are several.
    several : bool
        Whether it is a tuple of them.
    optional : bool
        Whether it may be None.
    required : bool
        Whether it has no default.
    default : object
        Value where nothing is said; meaningless when required.
    """

    name: str
    declaration: Declaration
    kind: type[Any]
    several: bool
    optional: bool
    required: bool
    default: Any

    def checked(self, value: object) -> object:
        """Return the value as the field has it.

        Raises
        ------
        ParameterError
            If it breaks the declaration.
        """
        if value is None and self.optional:
            return None
        if self.several:
            if not isinstance(value, tuple):
                raise ParameterError(self.name, value, "must be a tuple")
            for element in value:
                self._require_record(element)
            return value
        if self.kind is dict:
            if not isinstance(value, Mapping):
                raise ParameterError(self.name, value, "must be a mapping")
            return dict(value)
        if issubclass(self.kind, Record):
            self._require_record(value)
            return value
        return _scalar(self.name, self.kind, self.declaration, value)

    def _require_record(self, value: object) -> None:
        registry = self.declaration.registry
        allowed = tuple(registry.values()) if registry is not None else (self.kind,)
        if not isinstance(value, allowed):
            names = ", ".join(item.__name__ for item in allowed)
            raise ParameterError(self.name, value, f"must be made of {names}")


_MEMBERS: dict[type[Record], tuple[Member, ...]] = {}


def members(record: type[Record]) -> tuple[Member, ...]:
    """Return the fields of a record in the order of declaration."""
    if record not in _MEMBERS:
        _MEMBERS[record] = tuple(_members(record))
    return _MEMBERS[record]


def _members(record: type[Record]) -> Iterator[Member]:
    hints = get_type_hints(record)
    for item in fields(record):
        if _KEY in item.metadata:
            yield _member(item, hints[item.name])


def _member(item: Field[Any], hint: Any) -> Member:
    optional = several = False
    if get_origin(hint) is not None and NoneType in get_args(hint):
        optional = True
        (hint,) = (part for part in get_args(hint) if part is not NoneType)
    if get_origin(hint) is tuple:
        several = True
        hint = get_args(hint)[0]
    declaration: Declaration = item.metadata[_KEY]
    default = item.default
    if item.default_factory is not MISSING:
        default = item.default_factory()
    return Member(
        name=item.name,
        declaration=declaration,
        kind=dict if declaration.free else (get_origin(hint) or hint),
        several=several,
        optional=optional,
        required=default is MISSING,
        default=default,
    )


def _scalar(name: str, kind: type[Any], declaration: Declaration, value: object) -> object:
    if kind is bool:
        if not isinstance(value, bool):
            raise ParameterError(name, value, "must be true or false")
        return value
    if kind is str:
        if not isinstance(value, str):
            raise ParameterError(name, value, "must be a text")
        if declaration.choices and value not in declaration.choices:
            raise ParameterError(name, value, f"must be {declaration.bounds_text}")
        return value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ParameterError(name, value, "must be a number")
    if isinstance(value, float) and not math.isfinite(value):
        raise ParameterError(name, value, "must be finite")
    if kind is int and value != int(value):
        raise ParameterError(name, value, "must be a whole number")
    low, high = declaration.minimum, declaration.maximum
    if (low is not None and value < low) or (high is not None and value > high):
        raise ParameterError(name, value, f"must be {declaration.bounds_text}")
    if kind is int:
        return int(value)
    try:
        return float(value)
    except OverflowError:  # an integer beyond all floats
        raise ParameterError(name, value, "must be finite") from None


def walk(record: type[Record], prefix: str = "") -> Iterator[tuple[str, Member]]:
    """Yield (dotted key, field) of a record and of the records in it, registries left out."""
    for member in members(record):
        yield f"{prefix}{member.name}", member
        if issubclass(member.kind, Record) and member.declaration.registry is None:
            dots = "[]." if member.several else "."
            yield from walk(member.kind, f"{prefix}{member.name}{dots}")


def kind_of(record: Record, registry: Mapping[str, type[Record]]) -> str:
    """Return the name under which a record's class is registered."""
    return next(name for name, item in registry.items() if item is type(record))
