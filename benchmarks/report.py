# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parts of docs/benchmarks.md: one per benchmark, each with the facts of the machine that it was measured on."""

from __future__ import annotations

from pathlib import Path

from benchmarks.table import Table

PATH = Path(__file__).resolve().parents[1] / "docs" / "benchmarks.md"


def section(table: Table, facts: dict[str, str], load: str) -> str:
    """Return a benchmark's part of the document."""
    measured = "; ".join(f"{name} {value}" for name, value in facts.items())
    return f"{table.markdown()}\n*{measured}; load before {load}.*\n"
