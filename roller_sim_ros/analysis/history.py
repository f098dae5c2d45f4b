# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Meter values over time, one row a revolution, in compact columns."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import MeterValue
from roller_sim_ros.meters.registry import FURTHER, column

WHOLE_NUMBERS = ("last_sample", "period", "mode", "status")
NUMBERS = (
    "time_s",
    "excitation_frequency_hz",
    "cmv",
    "rmv",
    "fundamental_amplitude_m_s2",
    "fundamental_phase_rad",
)
FURTHER_COLUMNS = {meter.name: column(meter) for meter in FURTHER}
"""Columns of the further meter values by their names."""

BESIDE = ("recorded_cmv", "recorded_rmv", "true_cmv", "true_rmv")
"""What was recorded for the same revolution, NaN where nothing was."""

COLUMNS = (
    *WHOLE_NUMBERS[:1],
    *NUMBERS,
    *FURTHER_COLUMNS.values(),
    *WHOLE_NUMBERS[1:],
    *BESIDE,
)


class History:
    """Rows of meter values: about 150 bytes each, 15 MB for an hour at 28 Hz."""

    def __init__(self) -> None:
        self._columns: dict[str, array[int] | array[float]] = {
            name: array("q") if name in WHOLE_NUMBERS else array("d") for name in COLUMNS
        }

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self._columns["last_sample"])

    def append(self, value: MeterValue, time_s: float) -> int:
        """Add a value; return its row.

        Parameters
        ----------
        value : MeterValue
            The value.
        time_s : float
            Time of its last sample since the first stamp of the bag, s.
        """
        row = {
            "last_sample": value.last_sample,
            "time_s": time_s,
            "excitation_frequency_hz": value.excitation_frequency,
            "cmv": value.cmv,
            "rmv": value.rmv,
            "fundamental_amplitude_m_s2": value.fundamental_amplitude,
            "fundamental_phase_rad": value.fundamental_phase,
            "period": value.period,
            "mode": int(value.mode),
            "status": int(value.status),
            **{FURTHER_COLUMNS[name]: number for name, number in value.further.items()},
        }
        for name, entries in self._columns.items():
            entries.append(row.get(name, math.nan))  # type: ignore[arg-type]
        return len(self) - 1

    def note(self, row: int, beside: Mapping[str, float]) -> None:
        """Write what was recorded beside a row, by the names in `BESIDE`."""
        for name, number in beside.items():
            self._columns[name][row] = number  # type: ignore[call-overload]

    def floats(self, name: str) -> NDArray[np.float64]:
        """Return a column as float64, shape (rows,)."""
        return np.array(self._columns[name], dtype=np.float64)

    def integers(self, name: str) -> NDArray[np.int64]:
        """Return a column of whole numbers, shape (rows,)."""
        return np.array(self._columns[name], dtype=np.int64)
