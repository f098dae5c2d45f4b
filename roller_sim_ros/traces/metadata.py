# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a trace says of its run, in MCAP's Metadata records."""

from __future__ import annotations

import os
from datetime import datetime, timezone

from roller_sim_ros import __version__
from roller_sim_ros.parameters import Configuration

RUN = "roller_sim_ros"
"""Name of the record with version, seed and start time."""

PARAMETERS = "roller_sim_ros.parameters"
"""Name of the record with every parameter as the run began, by its dotted name, in SI units."""

ROSBAG2 = "rosbag2"
"""Name of the record that rosbag2 looks for."""


def run_metadata(
    configuration: Configuration, start_ns: int, seed: int | None = None
) -> dict[str, dict[str, str]]:
    """Return the Metadata records of a run by their names, with the one that rosbag2 looks for.

    Parameters
    ----------
    configuration : Configuration
        All parameters at the start.
    start_ns : int
        Stamp of the first sample, ns since the epoch.
    seed : int, optional
        Seed of the random numbers; None: the run has none.
    """
    start = datetime.fromtimestamp(start_ns / 1e9, timezone.utc)
    return {
        RUN: {
            "version": __version__,
            "seed": "" if seed is None else str(seed),
            "start_time_ns": str(start_ns),
            "start_time": start.isoformat(timespec="microseconds"),
        },
        PARAMETERS: {name: _text(value) for name, value in configuration.flat().items()},
        ROSBAG2: _for_rosbag2(),
    }


def _for_rosbag2() -> dict[str, str]:
    """Return the record for rosbag2.

    Without it rosbag2 (Jazzy and later) expects quality of service in names, which its older releases
    do not read; with it, and no metadata of its own in it, the numbers that all releases read.
    """
    record = {"serialized_metadata": ""}
    if os.environ.get("ROS_DISTRO"):
        record["ROS_DISTRO"] = os.environ["ROS_DISTRO"]
    return record


def _text(value: bool | float | str) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)
