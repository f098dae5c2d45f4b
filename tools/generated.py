# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Files that follow from declarations: written, or with ``--check`` compared."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path


def stale(root: Path, files: Mapping[str, str]) -> list[str]:
    """Return those of the {path from the root: text} that are not what they would be."""
    return [
        name
        for name, text in files.items()
        if not (root / name).is_file() or (root / name).read_text(encoding="utf-8") != text
    ]


def write_or_check(
    root: Path, files: Mapping[str, str], arguments: Sequence[str], command: str
) -> int:
    """Write the stale ones, or with ``--check`` name them and the command that writes them; return the exit code."""
    changed = stale(root, files)
    if "--check" in arguments:
        for name in changed:
            print(f"{name} is stale: run {command}", file=sys.stderr)
        return 1 if changed else 0
    for name in changed:
        (root / name).write_text(files[name], encoding="utf-8")
        print(f"wrote {name}")
    return 0
