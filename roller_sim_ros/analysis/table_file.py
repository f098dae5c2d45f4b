# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The meter values of a bag as a CSV file."""

from __future__ import annotations

import csv
import math
from pathlib import Path

from roller_sim_ros.analysis.history import COLUMNS, WHOLE_NUMBERS, History
from roller_sim_ros.errors import RollerSimError


def write_csv(history: History, path: Path) -> None:
    """Write one row a revolution: the columns are those of `history.COLUMNS`, unknown numbers are empty.

    Numbers are written so that reading them gives the same bits.

    Raises
    ------
    RollerSimError
        If the file cannot be written.
    """
    columns = [
        history.integers(name) if name in WHOLE_NUMBERS else history.floats(name)
        for name in COLUMNS
    ]
    try:
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(COLUMNS)
            for row in zip(*(column.tolist() for column in columns), strict=True):
                writer.writerow(["" if math.isnan(number) else repr(number) for number in row])
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
