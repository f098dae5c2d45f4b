"""What a benchmark found, as a Markdown table that also reads well on a terminal."""

from __future__ import annotations

from dataclasses import dataclass, field

_LEFT_COLUMNS = 1


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
        widths = [
            max(len(row[n]) for row in [self.columns, *self.rows]) for n in range(len(self.columns))
        ]
        rule = [
            "-" * width if n < _LEFT_COLUMNS else "-" * (width - 1) + ":"
            for n, width in enumerate(widths)
        ]
        lines = [_line(self.columns, widths), _line(rule, widths)]
        lines += [_line(row, widths) for row in self.rows]
        parts = [f"## {self.title}", self.says, "\n".join(lines), *self.notes]
        return "\n\n".join(parts) + "\n"


def _line(cells: tuple[str, ...] | list[str], widths: list[int]) -> str:
    padded = [
        cell.ljust(width) if n < _LEFT_COLUMNS else cell.rjust(width)
        for n, (cell, width) in enumerate(zip(cells, widths, strict=True))
    ]
    return f"| {' | '.join(padded)} |"


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
