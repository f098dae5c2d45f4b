"""Parts of a page that a command writes, between two comments; the rest is by hand."""

from __future__ import annotations

from pathlib import Path


def write_section(page: Path, name: str, text: str) -> None:
    """Put a text between ``<!-- written: name -->`` and the next ``<!-- end -->`` of a page."""
    start, end = f"<!-- written: {name} -->\n", "<!-- end -->"
    content = page.read_text(encoding="utf-8")
    before, found, rest = content.partition(start)
    _, closed, after = rest.partition(end)
    if not found or not closed:
        raise SystemExit(f"{page.name} has no part {start.strip()} … {end}")
    page.write_text(f"{before}{start}\n{text.strip()}\n\n{end}{after}", encoding="utf-8")
