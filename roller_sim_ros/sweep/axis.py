# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""An axis of a sweep: one parameter and the values that it takes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import PARAMETERS, Quantity, lookup
from roller_sim_ros.parameters.quantity import check
from roller_sim_ros.sweep.errors import AxisError


def axis_names() -> list[str]:
    """Return the dotted names of the parameters that can be an axis: the real numbers that have a flag."""
    return [
        name
        for name, (quantity, default) in PARAMETERS.items()
        if quantity.flag and isinstance(default, float)
    ]


@dataclass(frozen=True)
class Axis:
    """One parameter and the values that it takes, in rising order.

    Attributes
    ----------
    name : str
        Dotted name of the parameter, as in ``exciter.frequency_hz``.
    values : tuple of float
        SI values, distinct; sorted on construction.

    Raises
    ------
    AxisError
        On construction, if there is no value, one twice, or the parameter cannot be an axis.
    ParameterError
        If a value breaks the declaration of the parameter, or there is no such parameter.
    """

    name: str
    values: tuple[float, ...]

    def __post_init__(self) -> None:
        quantity, default = lookup(self.name)
        if self.name not in axis_names():
            raise AxisError(
                f"{self.name} cannot be an axis of a sweep; these can: {', '.join(axis_names())}"
            )
        if not self.values:
            raise AxisError(f"{self.name}: the axis has no points")
        values = sorted(float(check(self.name, quantity, default, value)) for value in self.values)
        for before, after in pairwise(values):
            if before == after:
                raise AxisError(f"{self.name}: the axis has {after!r} twice")
        object.__setattr__(self, "values", tuple(values))

    @classmethod
    def of(cls, name: str, values: Iterable[float]) -> Axis:
        """Return an axis from numbers of any kind, an array's too."""
        return cls(name, tuple(float(value) for value in values))

    def __len__(self) -> int:
        """Return the number of values."""
        return len(self.values)

    @property
    def dimension(self) -> str:
        """Name of the dimension in a file: the parameter's without its group."""
        return self.name.partition(".")[2]

    @property
    def quantity(self) -> Quantity:
        """Declaration of the parameter."""
        return PARAMETERS[self.name][0]

    @property
    def array(self) -> NDArray[np.float64]:
        """Values, shape (len,)."""
        return np.array(self.values)
