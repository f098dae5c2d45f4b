# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sweep files: netCDF-4, written as a whole or not at all, and checked when read."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.sweep.errors import SweepFileError
from roller_sim_ros.sweep.plan import Plan
from roller_sim_ros.sweep.results import FORMAT, FORMAT_ATTRIBUTE, PLAN_ATTRIBUTE, Results

if TYPE_CHECKING:
    import netCDF4


def write(results: Results, path: Path) -> None:
    """Write results, done or not; what was at the path stays until the new file is complete.

    Raises
    ------
    SweepFileError
        If the file cannot be written.
    """
    import netCDF4

    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with netCDF4.Dataset(str(part), "w", format="NETCDF4") as file:
            _fill(file, results)
        with part.open("rb") as written:
            os.fsync(written.fileno())
        part.replace(path)
    except OSError as error:
        raise SweepFileError(path, f"cannot be written: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)


def read(path: Path) -> Results:
    """Return the results in a file.

    Raises
    ------
    SweepFileError
        If the file cannot be read, is no sweep, or is of a version that this program does not know.
    """
    import netCDF4

    if not path.is_file():
        raise SweepFileError(path, "there is no such file")
    try:
        with netCDF4.Dataset(str(path)) as file:
            file.set_auto_mask(False)
            return _results(path, file)
    except OSError as error:
        reason = error.strerror or str(error)
        raise SweepFileError(path, f"cannot be read as netCDF: {reason}") from None


def _fill(file: netCDF4.Dataset, results: Results) -> None:
    for name, value in results.attributes().items():
        file.setncattr(name, value)
    for axis in results.plan.grid.axes:
        file.createDimension(axis.dimension, len(axis))
    for name, item in {**results.coordinates(), **results.variables()}.items():
        fill = False if item.missing is None else item.missing
        variable = file.createVariable(name, item.array.dtype, item.dimensions, fill_value=fill)
        variable.setncatts(dict(item.attributes))
        variable[...] = item.array


def _results(path: Path, file: netCDF4.Dataset) -> Results:
    if FORMAT_ATTRIBUTE not in file.ncattrs():
        raise SweepFileError(path, "is no file of roller-sim sweep")
    version = file.getncattr(FORMAT_ATTRIBUTE)
    if version != FORMAT:
        raise SweepFileError(
            path,
            f"has version {version} of the sweep format; this program knows version {FORMAT}",
        )
    try:
        content: dict[str, Any] = json.loads(file.getncattr(PLAN_ATTRIBUTE))
        results = Results.none_of(Plan.of_object(content))
        for name, array in results.arrays.items():
            array[...] = np.asarray(file.variables[name][...], dtype=array.dtype)
    except RollerSimError as error:
        raise SweepFileError(path, f"does not fit this program: {error}") from None
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise SweepFileError(path, f"is damaged or incomplete: {error!r}") from None
    return results
