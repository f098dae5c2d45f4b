# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Markdown tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]], *, numbers: bool = False) -> str:
    """Return a table without a line break at its end.

    Parameters
    ----------
    head : sequence of str
        Headings.
    rows : iterable of sequence of str
        Cells, as many in each row as there are headings.
    numbers : bool
        Whether all columns but the first are numbers: to the right, and wide enough to be read on a terminal, too.
    """
    lines = [_escaped(head), *map(_escaped, rows)]
    if not numbers:
        return "\n".join([_line(lines[0]), "|" + "---|" * len(head), *map(_line, lines[1:])])
    widths = [max(len(cell) for cell in column) for column in zip(*lines, strict=True)]
    rule = ["-" * width if n == 0 else "-" * (width - 1) + ":" for n, width in enumerate(widths)]
    lines.insert(1, rule)
    return "\n".join(
        _line(
            cell.ljust(width) if n == 0 else cell.rjust(width)
            for n, (cell, width) in enumerate(zip(cells, widths, strict=True))
        )
        for cells in lines
    )


def row(cells: Iterable[str]) -> str:
    """Return cells as a line of a table of texts."""
    return _line(_escaped(cells))


def _escaped(cells: Iterable[str]) -> list[str]:
    """Return cells that a bar in them does not end."""
    return [cell.replace("|", "\\|") for cell in cells]


def _line(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |"
