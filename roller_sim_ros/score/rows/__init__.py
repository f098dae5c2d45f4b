# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The rows of a verdict; a new kind is one file here and one line below."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.row import Row
from roller_sim_ros.score.rows import alarms, deviations, faults, gaps

ROWS: tuple[Callable[[Evidence], Iterable[Row]], ...] = (
    deviations.rows,
    gaps.rows,
    alarms.rows,
    faults.rows,
)
"""What makes the rows, in their order."""


def judge(evidence: Evidence) -> list[Row]:
    """Return all rows."""
    # A meter may say any number; what comes of it is found too far off all the same.
    with np.errstate(all="ignore"):
        return [row for rows in ROWS for row in rows(evidence)]
