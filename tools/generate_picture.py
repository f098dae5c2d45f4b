# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Draws docs/figures/data_flow.svg: the folders, and an arrow from each to those that import it (`make docs`).

Arrows that follow from others are left out, and ``commands``, which may import all. ``--check`` writes nothing and
fails when the picture is not what it would be.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from tools.generated import write_or_check

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = "roller_sim_ros"
EVERYWHERE = ("parameters", "meters.status", "errors", "jit", "share")
"""What nearly all import; arrows from there would hide the others."""
LEFT_OUT = ("parameters", "commands")
RECORD = ("session", "block")
"""The samples that a session yields, a plain record: sensors and meters look at it, and import nothing else of it."""

WIDTH, HEIGHT = 112, 34
STEP_X, STEP_Y = 138, 56
MARGIN = 14

Graph = Mapping[str, frozenset[str]]


def imports() -> Graph:
    """Return the folders that each folder imports."""
    folders = {path.parent.name for path in (ROOT / PACKAGE).glob("*/__init__.py")}
    found: dict[str, set[str]] = {folder: set() for folder in folders}
    for folder in folders:
        for path in (ROOT / PACKAGE / folder).rglob("*.py"):
            for name in _imported(ast.parse(path.read_text(encoding="utf-8"))):
                _, _, rest = name.partition(f"{PACKAGE}.")
                parts = rest.split(".")
                record = tuple(parts[:2]) == RECORD and folder != "faults"
                if parts[0] in folders - {folder} and parts[0] not in EVERYWHERE and not record:
                    found[folder].add(parts[0])
    return {folder: frozenset(names) for folder, names in found.items() if folder not in LEFT_OUT}


def _imported(tree: ast.AST) -> list[str]:
    names = []
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith(PACKAGE):
            names += [f"{node.module}.{alias.name}" for alias in node.names]
        elif isinstance(node, ast.Import):
            names += [alias.name for alias in node.names if alias.name.startswith(PACKAGE)]
    return names


def reduced(graph: Graph) -> Graph:
    """Return the graph without the arrows that follow from others."""

    def reach(folder: str) -> set[str]:
        found: set[str] = set()
        for name in graph[folder]:
            found |= {name} | reach(name)
        return found

    return {
        folder: frozenset(
            name for name in names if not any(name in reach(other) for other in names - {name})
        )
        for folder, names in graph.items()
    }


def columns(graph: Graph) -> list[list[str]]:
    """Return the folders by how long the chain of imports below them is; within a column near what they import."""
    depth: dict[str, int] = {}

    def deep(folder: str) -> int:
        if folder not in depth:
            depth[folder] = 1 + max((deep(name) for name in graph[folder]), default=-1)
        return depth[folder]

    found: list[list[str]] = [[] for _ in range(1 + max(deep(folder) for folder in graph))]
    for folder in sorted(graph):
        found[deep(folder)].append(folder)
    place: dict[str, float] = {}
    for column in found:
        wanted = {
            folder: sum(place[name] for name in graph[folder]) / len(graph[folder])
            if graph[folder]
            else float(number)
            for number, folder in enumerate(column)
        }
        column.sort(key=lambda folder: (wanted[folder], folder))
        place |= {folder: number - (len(column) - 1) / 2 for number, folder in enumerate(column)}
    return found


def picture() -> str:
    """Return the picture as SVG."""
    graph = reduced(imports())
    by_column = columns(graph)
    rows = max(map(len, by_column))
    at = {}
    for number, column in enumerate(by_column):
        top = (rows - len(column)) * STEP_Y / 2
        for row, folder in enumerate(column):
            at[folder] = (MARGIN + number * STEP_X, MARGIN + top + row * STEP_Y)
    width = 2 * MARGIN + (len(by_column) - 1) * STEP_X + WIDTH
    bottom = 2 * MARGIN + (rows - 1) * STEP_Y + HEIGHT
    arrows = []
    top_of_all, bottom_of_all = 0.0, float(bottom)
    for folder in sorted(graph):
        x, y = at[folder]
        for name in sorted(graph[folder]):
            start_x, start_y = at[name][0] + WIDTH, at[name][1] + HEIGHT / 2
            end_x, end_y = x, y + HEIGHT / 2
            bend = (end_x - start_x) / 2
            # Over what stands between, or under it.
            aside = 0.0 if end_x - start_x < STEP_X else 0.34 * (end_x - start_x)
            aside *= 1.0 if start_y + end_y > bottom else -1.0
            # A curve reaches three quarters of the way to its control points.
            top_of_all = min(top_of_all, min(start_y, end_y) + 0.75 * aside - MARGIN)
            bottom_of_all = max(bottom_of_all, max(start_y, end_y) + 0.75 * aside + MARGIN)
            arrows.append(
                f'<path d="M{start_x} {start_y:g} C{start_x + bend:g} {start_y + aside:g}'
                f' {end_x - bend:g} {end_y + aside:g} {end_x} {end_y:g}" fill="none"'
                ' stroke="#8394a5" marker-end="url(#tip)"/>'
            )
    frame = f"0 {top_of_all:g} {width} {bottom_of_all - top_of_all:g}"
    lines = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{frame}" font-family="sans-serif"'
            ' font-size="13">'
        ),
        "<title>Folders of roller_sim_ros, each with an arrow to those that import it</title>",
        (
            f'<rect y="{top_of_all:g}" width="{width}" height="{bottom_of_all - top_of_all:g}"'
            ' fill="#ffffff"/>'
        ),
        (
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7"'
            ' orient="auto"><path d="M0 0 L8 4 L0 8 z" fill="#8394a5"/></marker></defs>'
        ),
        *arrows,
    ]
    for folder, (x, y) in sorted(at.items()):
        lines += [
            (
                f'<rect x="{x}" y="{y:g}" width="{WIDTH}" height="{HEIGHT}" rx="5" fill="#e9eff5"'
                ' stroke="#1f5a94"/>'
            ),
            (
                f'<text x="{x + WIDTH / 2:g}" y="{y + HEIGHT / 2 + 4.5:g}" text-anchor="middle"'
                f' fill="#12334f">{folder}</text>'
            ),
        ]
    return "\n".join([*lines, "</svg>", ""])


def contents() -> dict[str, str]:
    """Return {path from the root: text} of the generated file."""
    return {"docs/figures/data_flow.svg": picture()}


def main(arguments: Sequence[str]) -> int:
    return write_or_check(ROOT, contents(), arguments, "make docs")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
