"""What a sweep does: its grid, how long each point runs, and where each starts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from roller_sim_ros.parameters import PARAMETERS, Configuration
from roller_sim_ros.sweep.axis import Axis
from roller_sim_ros.sweep.errors import AxisError
from roller_sim_ros.sweep.grid import Grid

DEFAULT_REVOLUTIONS = 500

UP, DOWN = "up", "down"


@dataclass(frozen=True)
class Continuation:
    """Each point starts from the final state of its neighbour on one axis.

    Attributes
    ----------
    axis : str
        Dotted name of the parameter, one that may change while the roller runs.
    direction : {"up", "down"}
        Whether its values are gone through in rising or in falling order. The first point starts at rest.
    """

    axis: str
    direction: str = UP

    def __post_init__(self) -> None:
        if self.direction not in (UP, DOWN):
            raise AxisError(f"direction {self.direction!r}: must be {UP} or {DOWN}")


@dataclass(frozen=True)
class Plan:
    """A sweep as it is asked for.

    Attributes
    ----------
    grid : Grid
        The points.
    revolutions : int
        Revolutions at each point, of which the last ones are evaluated; at least 2.
    continuation : Continuation or None
        None: each point starts at rest, in static equilibrium.
    early_stop : bool
        Do not compute revolutions that repeat those before to rounding.
    """

    grid: Grid
    revolutions: int = DEFAULT_REVOLUTIONS
    continuation: Continuation | None = None
    early_stop: bool = True

    def __post_init__(self) -> None:
        if self.revolutions < 2:
            raise AxisError(f"{self.revolutions} revolutions: must be at least 2")
        if self.continuation is not None:
            name = self.continuation.axis
            self.grid.axis(name)
            if not PARAMETERS[name][0].live:
                live = [axis.name for axis in self.grid.axes if axis.quantity.live]
                raise AxisError(
                    f"{name} cannot be continued along, for it cannot change while the roller runs"
                    + (f"; {', '.join(live)} can" if live else "")
                )

    @property
    def line_length(self) -> int:
        """Points of one line: those that have to be computed one after another."""
        if self.continuation is None:
            return 1
        return len(self.grid.axes[self.grid.axis(self.continuation.axis)])

    @property
    def lines(self) -> int:
        """Number of lines."""
        return self.grid.size // self.line_length

    def line(self, number: int) -> list[int]:
        """Return the flat indices of a line's points, in the order in which they are computed.

        Parameters
        ----------
        number : int
            0 … lines − 1.
        """
        if self.continuation is None:
            return [number]
        axis = self.grid.axis(self.continuation.axis)
        inner = math.prod(self.grid.shape[axis + 1 :])
        outer, within = divmod(number, inner)
        first = outer * inner * self.line_length + within
        points = first + inner * np.arange(self.line_length)
        if self.continuation.direction == DOWN:
            points = points[::-1]
        return [int(point) for point in points]

    def as_object(self) -> dict[str, Any]:
        """Return the plan as an object of JSON values."""
        continuation = self.continuation
        return {
            "axes": {axis.name: list(axis.values) for axis in self.grid.axes},
            "parameters": self.grid.parameters,
            "revolutions": self.revolutions,
            "continue": continuation and [continuation.axis, continuation.direction],
            "early_stop": self.early_stop,
        }

    @classmethod
    def of_object(cls, content: Mapping[str, Any]) -> Plan:
        """Return the plan that `as_object` gave.

        Raises
        ------
        RollerSimError
            If a parameter is not known or a value is refused.
        KeyError, TypeError, ValueError
            If it is no such object.
        """
        axes = tuple(Axis.of(name, values) for name, values in content["axes"].items())
        base = Configuration().changed(content["parameters"])
        continuation = content["continue"]
        return cls(
            Grid(axes, base),
            int(content["revolutions"]),
            continuation and Continuation(*continuation),
            bool(content["early_stop"]),
        )

    def difference(self, other: Plan) -> str:
        """Return what is different in another plan, as a reader wants it; empty when nothing is."""
        mine, theirs = self.as_object(), other.as_object()
        for key, what in (("axes", "axis"), ("parameters", "parameter")):
            here, there = mine.pop(key), theirs.pop(key)
            for name in {**here, **there}:
                if here.get(name) != there.get(name):
                    return f"{what} {name}: {_short(there.get(name))}, asked for {_short(here.get(name))}"
        for key, value in mine.items():
            if value != theirs[key]:
                return f"{key}: {theirs[key]}, asked for {value}"
        return ""


def _short(value: object) -> str:
    if isinstance(value, list):
        return f"{len(value)} values, {value[0]!r} … {value[-1]!r}"
    return "none" if value is None else repr(value)
