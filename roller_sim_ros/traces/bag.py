# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which MCAP files make up what the user names: one file, or the folder of a rosbag2 bag."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from roller_sim_ros.traces.errors import Problem, TraceError, reading_error

METADATA = "metadata.yaml"


def trace_files(path: Path) -> list[Path]:
    """Return the MCAP files of a trace in the order of time.

    Parameters
    ----------
    path : pathlib.Path
        An MCAP file, or a folder with rosbag2's ``metadata.yaml``. A folder without one, as a recording
        that was killed leaves behind, counts as the MCAP files in it.

    Raises
    ------
    TraceError
        If it is not there, not readable, or a bag of another kind.
    """
    if not path.is_dir():
        return [path]
    metadata = path / METADATA
    if metadata.is_file():
        return _listed(path, metadata)
    files = sorted(path.glob("*.mcap"))
    if not files:
        raise TraceError(
            path,
            Problem.FOREIGN,
            f"the folder holds neither {METADATA} nor a .mcap file",
            "give a .mcap file or the folder of a bag",
        )
    return files


def _listed(path: Path, metadata: Path) -> list[Path]:
    try:
        text = metadata.read_text("utf-8")
    except OSError as error:
        raise reading_error(metadata, error) from error
    except UnicodeDecodeError:
        text = ""
    try:
        information: dict[str, Any] = yaml.safe_load(text)["rosbag2_bagfile_information"]
        storage = str(information["storage_identifier"])
        names = [str(name) for name in information["relative_file_paths"]]
    except (yaml.YAMLError, KeyError, TypeError) as error:
        raise TraceError(
            metadata,
            Problem.DAMAGED,
            "it is not rosbag2's metadata",
            "`ros2 bag reindex` makes it anew; or give the .mcap file itself",
        ) from error
    if storage != "mcap":
        raise TraceError(
            path,
            Problem.FOREIGN,
            f"it is a bag in {storage}",
            "`ros2 bag convert` makes MCAP of it",
        )
    if information.get("compression_mode", "").lower() in ("file", "message"):
        raise TraceError(
            path,
            Problem.FOREIGN,
            "it is compressed by rosbag2 and not by MCAP",
            "`ros2 bag convert` makes an uncompressed bag of it",
        )
    return [path / name for name in names]
