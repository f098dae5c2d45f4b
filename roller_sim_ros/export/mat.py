# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Tables as MATLAB files."""

from __future__ import annotations

from pathlib import Path

from scipy.io import savemat

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.export.table import Table

MOST_BYTES = 1 << 31
"""What a variable of a MATLAB 5 file can hold."""


def write_mat(table: Table, path: Path) -> None:
    """Write column vectors of the columns' names and a struct `parameters`, dots as underscores.

    Raises
    ------
    RollerSimError
        If a column is too long for the format.
    """
    columns = table.whole()
    for name, column in columns.items():
        if column.nbytes >= MOST_BYTES:
            raise RollerSimError(
                f"{path}: {name} has {column.nbytes} bytes, MATLAB 5 files hold less than {MOST_BYTES} in a "
                "variable; take .parquet, which MATLAB reads with parquetread"
            )
    parameters = {name.replace(".", "_"): value for name, value in table.parameters.items()}
    # An open file: of a path that cannot be written scipy says something else.
    with path.open("wb") as file:
        savemat(
            file,  # type: ignore[arg-type]  # scipy takes it, its stubs do not know
            {**columns, "parameters": parameters},
            long_field_names=True,
            do_compression=True,
            oned_as="column",
        )
