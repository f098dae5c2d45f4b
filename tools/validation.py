# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Writes the table and the pictures of docs/validation.md: the paper's statements against what comes out.

``tools/validation.py`` computes everything anew, in some two minutes on two cores; ``--check`` writes nothing and fails
when the page is not what it would be; ``tools/validation.py KEY …`` shows single statements.
"""

from __future__ import annotations

import sys
from pathlib import Path

from roller_sim_ros.figures.output import write_picture
from roller_sim_ros.figures.registry import chosen
from roller_sim_ros.validation.registry import STATEMENTS
from roller_sim_ros.validation.statement import Statement
from roller_sim_ros.validation.study import Study
from tools import markdown_table
from tools.generated import write_or_check
from tools.sections import with_sections

ROOT = Path(__file__).resolve().parent.parent
PAGE = "docs/validation.md"

HALF_SPACES = ("exact", "two-pole")
PICTURES = (("16", "exact"), ("misleading", "exact"), ("sensitivity", "exact"))
"""Figures that the docs show."""


def row(statement: Statement) -> list[str]:
    """Return the cells of a statement."""
    cells = [statement.where, statement.says]
    for half_space in HALF_SPACES if statement.half_space else HALF_SPACES[:1]:
        finding = statement.check(Study.of(half_space))
        cells.append(f"**{finding.verdict.value}**: {finding.text}")
    if not statement.half_space:
        cells.append("the same")
    shown = (
        f"roller-sim {statement.command}"
        if statement.command
        else f"tools/validation.py {statement.key}"
    )
    return [*cells, f"`{shown}`", f"`{statement.key}`"]


def table() -> str:
    """Return the table."""
    head = ("paper", "says", *HALF_SPACES, "shown by", "key")
    return markdown_table.table(head, [row(statement) for statement in STATEMENTS])


def draw_pictures() -> None:
    """Write the pictures of the docs."""
    for name, half_space in PICTURES:
        (entry,) = chosen([name])
        path = ROOT / "docs" / "figures" / f"{entry.stem(half_space)}.png"
        write_picture(entry.drawing(Study.of(half_space)), entry.caption_title(), path)


def main(arguments: list[str]) -> int:
    """Write, check or show; return the exit code."""
    if arguments and arguments != ["--check"]:
        known = {statement.key: statement for statement in STATEMENTS}
        unknown = [key for key in arguments if key not in known]
        if unknown:
            print(f"no statement {unknown[0]!r}; there are {', '.join(known)}", file=sys.stderr)
            return 2
        for key in arguments:
            print(markdown_table.row(row(known[key])))
        return 0
    new = with_sections(ROOT / PAGE, {"statements": table()})
    code = write_or_check(ROOT, {PAGE: new}, arguments, "tools/validation.py")
    if not arguments:
        draw_pictures()
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
