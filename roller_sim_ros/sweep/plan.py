# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a sweep does: its grid, how long each point runs, and where each starts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

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

    def first_points(self, lines: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the flat index of the lowest point of some lines, shape (n,); their numbers run from 0 on."""
        if self.continuation is None:
            return lines
        outer, within = np.divmod(lines, self._stride)
        return np.asarray(outer * self._stride * self.line_length + within)

    def points(self, lines: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the flat indices of some lines' points, in the order in which they are computed.

        Parameters
        ----------
        lines : ndarray of int, shape (n,)
            Numbers of the lines, from 0 on.

        Returns
        -------
        ndarray of int, shape (n, line_length)
        """
        first = self.first_points(lines)[:, np.newaxis]
        if self.continuation is None:
            return first
        along = self._stride * np.arange(self.line_length)
        return first + (along if self.continuation.direction == UP else along[::-1])

    @property
    def _stride(self) -> int:
        """Distance of neighbours on a line, in flat indices."""
        assert self.continuation is not None
        return math.prod(self.grid.shape[self.grid.axis(self.continuation.axis) + 1 :])

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
