# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Declared records: checked on construction, and known to the reader and the schema alike."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from roller_sim_ros.parameters import PARAMETERS, ParameterError
from roller_sim_ros.site.compaction import LAWS
from roller_sim_ros.site.declaration import Record, declare, kind_of, like, members
from roller_sim_ros.site.features import FEATURES, SoftSpot


@dataclass(frozen=True)
class Part(Record):
    """A part."""

    length_m: float = declare("its length", minimum=0.5, maximum=9.0)
    count: int = declare("how many", default=2, minimum=1)
    name: str | None = declare("its name", default=None, choices=("a", "b"))
    on: bool = declare("whether", default=True)
    amplitude_mm: float | None = like("exciter.amplitude_m")


@dataclass(frozen=True)
class Whole(Record):
    """Parts together."""

    part: Part = declare("a part", default=Part(length_m=1.0))
    parts: tuple[Part, ...] = declare("more", default=())
    free: dict[str, float] = declare("anything", default={}, free=True)


def test_values_are_converted_to_their_types() -> None:
    part = Part(length_m=3, count=2.0)  # type: ignore[arg-type]
    assert (part.length_m, part.count) == (3.0, 2)
    assert isinstance(part.length_m, float)
    assert isinstance(part.count, int)


@pytest.mark.parametrize(
    ("values", "name", "reason"),
    [
        ({"length_m": 0.4}, "length_m", "must be 0.5 … 9"),
        ({"length_m": 9.1}, "length_m", "must be 0.5 … 9"),
        ({"length_m": float("nan")}, "length_m", "must be finite"),
        ({"length_m": "1"}, "length_m", "must be a number"),
        ({"length_m": True}, "length_m", "must be a number"),
        ({"count": 1.5}, "count", "must be a whole number"),
        ({"count": 0}, "count", "must be at least 1"),
        ({"name": "c"}, "name", "must be one of a, b"),
        ({"name": 3}, "name", "must be a text"),
        ({"on": 1}, "on", "must be true or false"),
        ({"amplitude_mm": 5.1}, "amplitude_mm", "must be 0 … 5"),
    ],
)
def test_what_breaks_its_declaration_is_refused(
    values: dict[str, object], name: str, reason: str
) -> None:
    with pytest.raises(ParameterError) as caught:
        Part(**{"length_m": 1.0, **values})  # type: ignore[arg-type]
    assert caught.value.name == name
    assert caught.value.reason == reason


@pytest.mark.parametrize(
    "values", [{"part": 3.0}, {"parts": [Part(1.0)]}, {"parts": (3.0,)}, {"free": 1.0}]
)
def test_records_take_nothing_but_records(values: dict[str, object]) -> None:
    with pytest.raises(ParameterError):
        Whole(**values)  # type: ignore[arg-type]


def test_fields_of_a_mapping_are_not_shared() -> None:
    one, other = Whole(), Whole()
    one.free["x"] = 1.0
    assert other.free == {}


def test_a_field_like_a_parameter_has_its_bounds_in_the_unit_of_its_flag() -> None:
    (member,) = [item for item in members(Part) if item.name == "amplitude_mm"]
    quantity, _ = PARAMETERS["exciter.amplitude_m"]
    assert quantity.maximum == 5e-3
    assert (member.declaration.minimum, member.declaration.maximum) == (0.0, 5.0)
    assert member.declaration.doc == quantity.doc
    assert member.optional


def test_registries_name_each_record_once() -> None:
    for registry in (FEATURES, LAWS):
        assert len(set(registry.values())) == len(registry)
    assert kind_of(SoftSpot(at_m=1.0, length_m=1.0), FEATURES) == "soft_spot"


def test_every_default_that_is_a_number_of_the_ground_says_where_it_is_from() -> None:
    for registry, unsourced in ((LAWS, set()), (FEATURES, {"from_m"})):
        for record in registry.values():
            for member in members(record):
                if isinstance(member.default, float) and member.name not in unsourced:
                    assert member.declaration.source, f"{record.__name__}.{member.name}"
