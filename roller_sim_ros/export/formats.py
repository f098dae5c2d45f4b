# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The formats that tables are written in. A further one: a function in a file, a line in `FORMATS`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from roller_sim_ros.export.csv_file import write_csv
from roller_sim_ros.export.geojson import write_geojson
from roller_sim_ros.export.mat import write_mat
from roller_sim_ros.export.parquet import write_parquet
from roller_sim_ros.export.table import Table
from roller_sim_ros.export.wav import write_wav


@dataclass(frozen=True)
class Format:
    """A file format.

    Attributes
    ----------
    write : callable
        Writes a table to a path.
    tables : tuple of str
        Tables that it can hold, the one that is taken when none is named first.
    doc : str
        What it is.
    """

    write: Callable[[Table, Path], None]
    tables: tuple[str, ...]
    doc: str


FORMATS = {
    ".csv": Format(
        write_csv, ("meters", "samples", "truth", "map"), "text, one row a line, a head line"
    ),
    ".parquet": Format(
        write_parquet,
        ("samples", "truth", "meters", "map"),
        "columns, for pandas, polars, Spark; the run's parameters in the file's metadata",
    ),
    ".mat": Format(
        write_mat,
        ("samples", "truth", "meters", "map"),
        "MATLAB 5, a column vector each, the run's parameters as a struct",
    ),
    ".wav": Format(
        write_wav,
        ("samples", "truth"),
        "sound: vertical left, horizontal right, 8 kHz, full scale the greatest acceleration",
    ),
    ".geojson": Format(write_geojson, ("map",), "a square polygon a cell, WGS 84"),
}
"""By the ending of the file's name."""
