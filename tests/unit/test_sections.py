# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parts of pages that commands write, and the tables in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.registry import BENCHMARKS
from tools.markdown_table import table
from tools.sections import with_sections, write_section

DOCS = Path(__file__).resolve().parents[2] / "docs"


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
    assert with_sections(page, {"y": "two", "x": "one"}) == (
        "a\n<!-- written: x -->\n\none\n\n<!-- end -->\nb\n<!-- written: y -->\n\ntwo\n\n<!-- end -->\n"
    )
    with pytest.raises(SystemExit, match=r"page\.md has no part <!-- written: z -->"):
        write_section(page, "z", "new")
    assert page.read_text() == expected


@pytest.mark.parametrize(
    ("page", "names"),
    [
        ("benchmarks", tuple(BENCHMARKS)),
        ("controllers", ("controllers", "jump_guard")),
        ("estimate", ("round trip", "bias")),
        ("robustness", ("fuzz", "soak")),
    ],
)
def test_pages_have_the_parts_that_commands_write(page: str, names: tuple[str, ...]) -> None:
    text = (DOCS / f"{page}.md").read_text("utf-8")
    marks = [text.index(f"<!-- written: {name} -->\n") for name in names]
    assert marks == sorted(marks)
    assert text.count("<!-- written: ") == text.count("<!-- end -->") == len(names)


def test_a_table_of_texts() -> None:
    assert table(("a", "b"), [("x | y", "")]) == "| a | b |\n|---|---|\n| x \\| y |  |"


def test_a_table_of_numbers_is_as_wide_as_its_cells() -> None:
    expected = "| name |  x/s |\n| ---- | ---: |\n| a    |  1.0 |\n| b\\|c | 10.0 |"
    assert table(("name", "x/s"), [("a", "1.0"), ("b|c", "10.0")], numbers=True) == expected
