# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Tables as CSV."""

from __future__ import annotations

from pathlib import Path

from roller_sim_ros.export.table import Table


def write_csv(table: Table, path: Path) -> None:
    """Write a head line and one line a row; numbers read back to the same bits, what is unknown is empty."""
    import pandas

    with path.open("w", newline="", encoding="utf-8") as file:
        for number, piece in enumerate(table.pieces()):
            pandas.DataFrame(piece).to_csv(file, index=False, header=number == 0)
