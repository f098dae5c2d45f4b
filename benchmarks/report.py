"""docs/benchmarks.md: one section per benchmark, each with the facts of the machine that it was measured on."""

from __future__ import annotations

import re
from pathlib import Path

from benchmarks.table import Table

PATH = Path(__file__).resolve().parents[1] / "docs" / "benchmarks.md"
_HEAD = """\
# Benchmarks

Written by `make bench ARGS=--write`; a single one by `make bench ARGS="kernel --write"`, which leaves the others as
they are. `make bench ARGS=--quick` only tries all out, in some minutes. Times are medians, of pure computation in CPU
time. The machines are shared and noisy, so what counts is the ratio of two things that took turns in one run. Nothing
here is asserted by a test.
"""


def section(table: Table, facts: dict[str, str], load: str) -> str:
    """Return a benchmark's part of the document."""
    measured = "; ".join(f"{name} {value}" for name, value in facts.items())
    return f"{table.markdown()}\n*{measured}; load before {load}.*\n"


def write(sections: dict[str, str], order: list[str]) -> None:
    """Replace these sections and keep the others.

    Parameters
    ----------
    sections : dict
        {name of the benchmark: text}.
    order : list of str
        All names, in the order of the document.
    """
    kept = _read() if PATH.exists() else {}
    merged = {**kept, **sections}
    parts = [f"<!-- {name} -->\n{merged[name].strip()}\n" for name in order if name in merged]
    PATH.write_text("\n".join([_HEAD, *parts]), encoding="utf-8")


def _read() -> dict[str, str]:
    """Return the sections of the present document."""
    pieces = re.split(r"^<!-- (\w+) -->\n", PATH.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return dict(zip(pieces[1::2], pieces[2::2], strict=True))
