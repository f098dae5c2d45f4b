# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Results that a command writes."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from roller_sim_ros.errors import RollerSimError


def write_json(report: Mapping[str, object] | Sequence[object], name: str) -> None:
    """Write a JSON object or list to a file, or with ``-`` to the standard output.

    Raises
    ------
    RollerSimError
        If the file cannot be written.
    """
    text = json.dumps(report, indent=2, ensure_ascii=False, allow_nan=False)
    if name == "-":
        print(text)
        return
    try:
        Path(name).write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise RollerSimError(f"{name}: cannot be written: {error.strerror or error}") from None
