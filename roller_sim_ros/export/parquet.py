# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Tables as Parquet."""

from __future__ import annotations

import json
from pathlib import Path

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.export.table import Table


def write_parquet(table: Table, path: Path) -> None:
    """Write columns, a row group a piece; the run's parameters are in the metadata as JSON.

    Raises
    ------
    RollerSimError
        If pyarrow is not installed, which is large and needed for this alone.
    """
    try:
        import pyarrow
        from pyarrow.parquet import ParquetWriter
    except ModuleNotFoundError:
        raise RollerSimError(
            "Parquet needs pyarrow, which is not installed: python3 -m pip install pyarrow"
        ) from None

    writer: ParquetWriter | None = None
    try:
        for piece in table.pieces():
            rows = pyarrow.table(piece)
            if writer is None:
                notes = {"roller_sim_parameters": json.dumps(dict(table.parameters))}
                writer = ParquetWriter(path, rows.schema.with_metadata(notes))
            writer.write_table(rows.cast(writer.schema))
    finally:
        if writer is not None:
            writer.close()
