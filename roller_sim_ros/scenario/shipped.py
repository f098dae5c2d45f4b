# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The scenarios that the package brings, by their names."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.share import share_directory


def shipped_scenarios() -> dict[str, Path]:
    """Return {name: file} of the scenarios that are installed with the package."""
    return {path.stem: path for path in sorted((share_directory() / "scenarios").glob("*.yaml"))}


def scenario_path(text: str) -> Path:
    """Return the file that a user means: a path, or the name of a scenario that the package brings.

    Parameters
    ----------
    text : str
        As on the command line. A bare name without a file of that name is one of the package's.

    Raises
    ------
    RollerSimError
        If it is a bare name and there is no such scenario.
    """
    path = Path(text)
    if path.exists() or path.suffix or path.name != text:
        return path
    shipped = shipped_scenarios()
    if text in shipped:
        return shipped[text]
    near = get_close_matches(text, shipped, n=1, cutoff=0.5)
    offer = f"did you mean {near[0]}?" if near else f"there are {', '.join(shipped)}"
    raise RollerSimError(f"{text}: is no file and no scenario of the package; {offer}")
