# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A grid of points: the axes of a sweep and what is the same at all of its points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep.axis import Axis
from roller_sim_ros.sweep.errors import AxisError

Frozen = TypeVar("Frozen")

MOST_POINTS = 10_000_000
"""More would not fit into memory."""


@dataclass(frozen=True)
class Grid:
    """Every combination of the values of some axes.

    Attributes
    ----------
    axes : tuple of Axis
        At least one; the last one varies fastest.
    base : Configuration
        What holds at all points, beside the axes.

    Raises
    ------
    AxisError
        On construction, if there is no axis, two of one parameter, or too many points.
    """

    axes: tuple[Axis, ...]
    base: Configuration = field(default_factory=Configuration)

    def __post_init__(self) -> None:
        object.__setattr__(self, "axes", tuple(self.axes))
        if not self.axes:
            raise AxisError(
                "the grid has no axis: give a range, as in 15:40:101, or a list of values"
            )
        names = [axis.name for axis in self.axes]
        if len(set(names)) < len(names):
            raise AxisError(f"the grid has two axes of one parameter: {', '.join(names)}")
        if self.size > MOST_POINTS:
            raise AxisError(f"the grid has {self.size} points; at most {MOST_POINTS} are possible")

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(len(axis) for axis in self.axes)

    @property
    def size(self) -> int:
        """Number of points."""
        return math.prod(self.shape)

    def axis(self, name: str) -> int:
        """Return the place of an axis among the others.

        Raises
        ------
        AxisError
            If the parameter is no axis of this grid.
        """
        names = [axis.name for axis in self.axes]
        if name not in names:
            raise AxisError(f"{name} is no axis of this grid, which has {', '.join(names)}")
        return names.index(name)

    def values(self, point: int) -> dict[str, float]:
        """Return {dotted name: SI value} of the axes at a point.

        Parameters
        ----------
        point : int
            Flat index, the last axis running fastest.
        """
        places = np.unravel_index(point, self.shape)
        return {
            axis.name: axis.values[int(place)]
            for axis, place in zip(self.axes, places, strict=True)
        }

    def configuration(self, point: int) -> Configuration:
        """Return all parameters at a point."""
        groups: dict[str, dict[str, float]] = {}
        for name, value in self.values(point).items():
            group, _, short = name.partition(".")
            groups.setdefault(group, {})[short] = value
        changed = {
            group: _with(getattr(self.base, group), values) for group, values in groups.items()
        }
        return _with(self.base, changed)

    @cached_property
    def parameters(self) -> dict[str, Any]:
        """{dotted name: SI value} of what is no axis."""
        names = {axis.name for axis in self.axes}
        return {name: value for name, value in self.base.flat().items() if name not in names}


def _with(instance: Frozen, values: Mapping[str, object]) -> Frozen:
    """Return a copy of a frozen dataclass with other values, unchecked.

    The axes have checked them: to do so again at each of a million points takes longer than all else that is done to
    set a point up.
    """
    copy = object.__new__(type(instance))
    copy.__dict__.update(instance.__dict__, **values)
    return copy
