# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The results of a sweep as far as they are there, and their labelled form."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros import __version__
from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.sweep.plan import Plan
from roller_sim_ros.sweep.task import DONE, Outcome
from roller_sim_ros.sweep.values import VALUES

if TYPE_CHECKING:
    import xarray

FORMAT = 1
"""Version of the labelled form; it changes when what a reader has to know does."""

FORMAT_ATTRIBUTE = "roller_sim_sweep_format"
PLAN_ATTRIBUTE = "plan"


@dataclass(frozen=True)
class Variable:
    """One array with its labels.

    Attributes
    ----------
    dimensions : tuple of str
        Names of its dimensions.
    array : ndarray
        What it holds.
    attributes : dict
        Unit and description.
    missing : float or None
        What stands where there is no value.
    """

    dimensions: tuple[str, ...]
    array: NDArray[Any]
    attributes: Mapping[str, Any]
    missing: float | None = None


@dataclass(frozen=True)
class Results:
    """Values at all points of a plan, filled in as they come.

    Attributes
    ----------
    plan : Plan
        What is swept.
    arrays : dict
        {name: ndarray of the grid's shape}: those of `VALUES`, and `DONE`.
    """

    plan: Plan
    arrays: dict[str, NDArray[Any]]

    @classmethod
    def none_of(cls, plan: Plan) -> Results:
        """Return results of which nothing is there yet."""
        shape = plan.grid.shape
        arrays = {value.name: np.full(shape, value.missing, value.dtype) for value in VALUES}
        arrays[DONE] = np.zeros(shape, dtype=np.int32)
        return cls(plan, arrays)

    def add(self, outcome: Outcome) -> None:
        """Fill in what became of a task."""
        for name, values in outcome.values.items():
            self.arrays[name].reshape(-1)[outcome.points] = values

    @property
    def points_done(self) -> int:
        """Number of points that are there."""
        return int(np.count_nonzero(self.arrays[DONE]))

    def missing_lines(self) -> NDArray[np.int64]:
        """Return the numbers of the lines that are not done; a line is there as a whole or not at all."""
        done = self.arrays[DONE].reshape(-1)
        return np.flatnonzero(done[self.plan.first_points(np.arange(self.plan.lines))] == 0)

    def coordinates(self) -> dict[str, Variable]:
        """Return the axes."""
        return {
            axis.dimension: Variable(
                (axis.dimension,),
                axis.array,
                {
                    "units": axis.quantity.unit or "1",
                    "long_name": axis.quantity.doc,
                    "parameter": axis.name,
                },
            )
            for axis in self.plan.grid.axes
        }

    def variables(self) -> dict[str, Variable]:
        """Return the values."""
        dimensions = tuple(axis.dimension for axis in self.plan.grid.axes)
        variables = {}
        for value in VALUES:
            attributes: dict[str, Any] = {"units": value.unit, "long_name": value.doc}
            if value.labels:
                attributes["flag_values"] = np.arange(len(value.labels), dtype=value.dtype)
                attributes["flag_meanings"] = " ".join(
                    label.replace(" ", "_") for label in value.labels
                )
            array = self.arrays[value.name]
            variables[value.name] = Variable(dimensions, array, attributes, value.missing)
        about_done = (
            "revolutions that were computed, those after them repeat them; 0: point not done"
        )
        variables[DONE] = Variable(
            dimensions, self.arrays[DONE], {"units": "1", "long_name": about_done}
        )
        return variables

    def attributes(self) -> dict[str, Any]:
        """Return what holds for all points: every parameter that is no axis, by its dotted name."""
        attributes: dict[str, Any] = {
            "title": "settled motion of a vibratory roller over a grid of parameters",
            "source": f"roller_sim_ros {__version__}",
            FORMAT_ATTRIBUTE: np.int32(FORMAT),
            PLAN_ATTRIBUTE: json.dumps(self.plan.as_object(), ensure_ascii=False),
        }
        for name, value in self.plan.grid.parameters.items():
            # There are no booleans in netCDF.
            attributes[name] = np.int8(value) if isinstance(value, bool) else value
        units = {name: PARAMETERS[name][0].unit for name in self.plan.grid.parameters}
        attributes["parameter_units"] = json.dumps(
            {name: unit for name, unit in units.items() if unit}, ensure_ascii=False
        )
        return attributes

    def dataset(self) -> xarray.Dataset:
        """Return the labelled form; missing values are NaN."""
        import xarray

        def labelled(variables: Mapping[str, Variable]) -> dict[str, Any]:
            found = {}
            for name, item in variables.items():
                array = item.array
                if item.missing is not None and array.dtype.kind == "i":
                    array = np.where(array == item.missing, np.float32(np.nan), array)
                found[name] = (item.dimensions, array, dict(item.attributes))
            return found

        return xarray.Dataset(
            labelled(self.variables()), labelled(self.coordinates()), self.attributes()
        )
