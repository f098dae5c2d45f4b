# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""When a fault is active: by a window of the scenario, or from now until something has passed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from roller_sim_ros.parameters import ParameterError, Value
from roller_sim_ros.session import Moment

ROUNDING = 1e-9
"""Times and ways that are so little short of a span have reached its end."""


class When(Protocol):
    """A condition on the moment at which a revolution begins."""

    def holds(self, moment: Moment) -> bool:
        """Return whether it holds."""
        ...


@dataclass(frozen=True)
class Scheduled:
    """A fault and when it is active.

    Attributes
    ----------
    id : str
        Of the fault.
    when : When
        Asked at the beginning of every revolution.
    parameters : mapping
        What differs from the defaults.
    """

    id: str
    when: When
    parameters: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True)
class Span:
    """Holds from the first moment it is asked for until one of these has passed; for ever where nothing is given.

    Attributes
    ----------
    duration_s : float or None
        Time.
    revolutions : int or None
        Revolutions, or stretches of 128 samples.
    distance_m : float or None
        Way along the lane, either direction.

    Raises
    ------
    ParameterError
        On construction, if one of them is not positive.
    """

    duration_s: float | None = None
    revolutions: int | None = None
    distance_m: float | None = None

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if value is not None and not 0.0 < value < float("inf"):
                raise ParameterError(name, value, "must be positive and finite")

    def since(self, begin: Moment) -> Until:
        """Return the condition of a span that begins at a moment."""
        return Until(self, begin)


@dataclass(frozen=True)
class Until:
    """A span that has begun."""

    span: Span
    begin: Moment

    def holds(self, moment: Moment) -> bool:
        """Return whether the span still lasts."""
        span, begin = self.span, self.begin
        way_m = abs(moment.position.chainage_m - begin.position.chainage_m)
        return (
            (span.duration_s is None or moment.time_s - begin.time_s < span.duration_s - ROUNDING)
            and (
                span.revolutions is None or moment.revolution - begin.revolution < span.revolutions
            )
            and (span.distance_m is None or way_m < span.distance_m - ROUNDING)
        )


def surely_overlap(one: object, other: object) -> bool:
    """Return whether two windows, ranges of ``from_…`` and ``to_…``, overlap whatever the roller does.

    Ranges of different kinds, as of time and of chainage, may or may not: they do not surely overlap.
    """
    kinds = ("s", "m", "pass", "revolution")
    ranges = [
        {
            kind: (getattr(it, f"from_{kind}", None), getattr(it, f"to_{kind}", None))
            for kind in kinds
        }
        for it in (one, other)
    ]
    first, second = (
        {kind: ends for kind, ends in item.items() if ends != (None, None)} for item in ranges
    )
    if first and second and first.keys() != second.keys():
        return False
    return all(_meet(first[kind], second[kind]) for kind in first.keys() & second.keys())


_Range = tuple[float | None, float | None]


def _meet(one: _Range, other: _Range) -> bool:
    return all(
        begin is None or end is None or begin < end
        for begin, end in ((one[0], other[1]), (other[0], one[1]))
    )
