# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a benchmark found, as a Markdown table that also reads well on a terminal."""

from __future__ import annotations

from dataclasses import dataclass, field

from tools.markdown_table import table


@dataclass(frozen=True)
class Table:
    """Result of one benchmark.

    Attributes
    ----------
    title : str
        Heading.
    says : str
        What was measured and against what, one paragraph.
    columns : tuple of str
        Headings; the first column names the row.
    rows : list of tuple of str
        The cells.
    notes : list of str
        Below the table, one paragraph each.
    """

    title: str
    says: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]]
    notes: list[str] = field(default_factory=list)

    def markdown(self) -> str:
        """Heading, paragraph, table and notes."""
        lines = table(self.columns, self.rows, numbers=True)
        parts = [f"## {self.title}", self.says, lines, *self.notes]
        return "\n\n".join(parts) + "\n"


def seconds(value: float) -> str:
    """Return a time with three digits in the unit that fits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if value >= size:
            return f"{_three_digits(value / size)} {unit}"
    return f"{_three_digits(value / 1e-9)} ns"


def ratio(value: float) -> str:
    """Return a ratio with two or three digits."""
    return f"{value:.2f}" if value < 10.0 else f"{value:,.0f}"


def _three_digits(value: float) -> str:
    if value >= 100.0:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10.0 else f"{value:.2f}"
