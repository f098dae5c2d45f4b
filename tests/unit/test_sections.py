"""Parts of pages that commands write."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.sections import write_section


def test_only_the_part_is_written(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "a\n<!-- written: x -->\nold\n<!-- end -->\nb\n<!-- written: y -->\n<!-- end -->\n"
    )
    write_section(page, "x", "new\n")
    write_section(page, "x", "newer")
    expected = (
        "a\n<!-- written: x -->\n\nnewer\n\n<!-- end -->\nb\n<!-- written: y -->\n<!-- end -->\n"
    )
    assert page.read_text() == expected
    with pytest.raises(SystemExit, match="has no part <!-- written: z -->"):
        write_section(page, "z", "new")
    assert page.read_text() == expected


def test_pages_have_the_parts_that_commands_write() -> None:
    page = (Path(__file__).resolve().parents[2] / "docs" / "robustness.md").read_text("utf-8")
    for name in ("fuzz", "soak"):
        assert page.count(f"<!-- written: {name} -->\n") == 1
