# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What can go wrong in a sweep."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.errors import RollerSimError

if TYPE_CHECKING:
    from roller_sim_ros.sweep.results import Results


class AxisError(RollerSimError):
    """An axis or a grid cannot be what is asked for."""


class SweepFileError(RollerSimError):
    """A sweep file cannot be read or written, or is not what it should be.

    Attributes
    ----------
    path : pathlib.Path
        The file.
    """

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = path


class SweepStopped(RollerSimError):
    """Those who compute broke down before all points were done.

    Attributes
    ----------
    results : Results
        What is done.
    """

    def __init__(self, results: Results, reason: str) -> None:
        super().__init__(
            f"the workers broke down with {results.points_done} of {results.plan.grid.size} points "
            f"done: {reason}"
        )
        self.results = results
