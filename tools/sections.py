# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parts of a page that a command writes, from ``<!-- written: NAME -->`` to ``<!-- end -->``; the rest is by hand."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path


def with_sections(page: Path, sections: Mapping[str, str]) -> str:
    """Return the text of a page with other {name: text} of its parts."""
    content = page.read_text(encoding="utf-8")
    for name, text in sections.items():
        start, end = f"<!-- written: {name} -->\n", "<!-- end -->"
        before, found, rest = content.partition(start)
        _, closed, after = rest.partition(end)
        if not found or not closed:
            raise SystemExit(f"{page.name} has no part {start.strip()} … {end}")
        content = f"{before}{start}\n{text.strip()}\n\n{end}{after}"
    return content


def write_section(page: Path, name: str, text: str) -> None:
    """Write one part of a page."""
    page.write_text(with_sections(page, {name: text}), encoding="utf-8")
