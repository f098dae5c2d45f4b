# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A verdict as a JSON object, a short table and JUnit XML."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.score.row import Row, Verdict
from roller_sim_ros.score.score import Score


def as_object(score: Score) -> dict[str, Any]:
    """Return the verdict as an object of JSON values: numbers that are unknown or endless are None."""
    return {
        "trace": str(score.path),
        "topic": score.meter.name,
        "type": score.meter.type_name,
        "field": score.meter.field,
        "flag": score.meter.flag,
        "alarm": score.meter.alarm,
        "matched_by": "stamp" if score.stamped else "log",
        "revolutions": score.revolutions,
        "duration_s": score.duration_s,
        "messages": score.messages,
        "unmatched": score.unmatched,
        "passed": score.passed,
        "rows": [
            {
                "name": row.name,
                "verdict": row.verdict.value,
                "found": _plain(row.found),
                "limit": _plain(row.limit),
                "unit": row.unit,
                "detail": row.detail,
            }
            for row in score.rows
        ],
        "limits": {name: getattr(score.limits, name) for name, _, _ in declared(Limits)},
    }


def as_table(score: Score) -> str:
    """Return the verdict as a table, one line a row."""
    head = ("row", "found", "limit", "verdict", "")
    rows = [head, *(_cells(row) for row in score.rows)]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    lines = []
    for name, found, limit, verdict, detail in rows:
        cells = (
            name.ljust(widths[0]),
            found.rjust(widths[1]),
            limit.rjust(widths[2]),
            verdict.ljust(widths[3]),
            detail,
        )
        lines.append("  ".join(cells).rstrip())
    unmatched = f", {score.unmatched} of no revolution" if score.unmatched else ""
    title = (
        f"{score.meter.name} ({score.meter.type_name}, {score.meter.field}): {score.messages} messages"
        f"{unmatched}, {score.revolutions} revolutions, {score.duration_s:.1f} s, matched by "
        f"{'stamp' if score.stamped else 'time of arrival'}"
    )
    return "\n".join([title, *lines, _verdict(score)])


def write_junit(score: Score, path: Path) -> None:
    """Write the verdict as JUnit XML: each row is a test case, what cannot be judged is skipped.

    The standard library suffices: three elements, and no dependency for whoever only reads the table.

    Raises
    ------
    RollerSimError
        If the file cannot be written.
    """
    skipped = [row for row in score.rows if row.verdict is Verdict.NOT_JUDGED]
    counts = {
        "tests": str(len(score.rows)),
        "failures": str(len(score.failed)),
        "errors": "0",
        "skipped": str(len(skipped)),
    }
    suites = ElementTree.Element("testsuites", {"name": "roller-sim score", **counts})
    suite = ElementTree.SubElement(
        suites,
        "testsuite",
        {"name": score.meter.name, "time": f"{score.duration_s:.3f}", **counts},
    )
    for row in score.rows:
        case = ElementTree.SubElement(
            suite, "testcase", {"classname": f"roller_sim.score{_class(score)}", "name": row.name}
        )
        _, found, limit, _, detail = _cells(row)
        text = ", ".join(item for item in (f"found {found}, limit {limit}", detail) if item)
        if row.verdict is Verdict.FAIL:
            ElementTree.SubElement(case, "failure", {"message": text, "type": "limit"})
        elif row.verdict is Verdict.NOT_JUDGED:
            ElementTree.SubElement(case, "skipped", {"message": row.detail})
        else:
            ElementTree.SubElement(case, "system-out").text = text
    ElementTree.indent(suites)
    try:
        ElementTree.ElementTree(suites).write(path, encoding="utf-8", xml_declaration=True)
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None


def _class(score: Score) -> str:
    """Return the topic as JUnit's readers group by it: dots, not slashes."""
    return score.meter.name.replace("/", ".")


def _cells(row: Row) -> tuple[str, str, str, str, str]:
    return (
        row.name,
        _number(row.found, row.unit),
        _number(row.limit, row.unit),
        row.verdict.value,
        row.detail,
    )


def _number(value: float, unit: str) -> str:
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "never" if unit == "revolutions" else "∞"
    text = f"{value:.0f}" if value == int(value) else f"{value:.3g}"
    return f"{text} {unit}".rstrip()


def _plain(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _verdict(score: Score) -> str:
    failed = score.failed
    if not failed:
        return f"passed: {len(score.rows)} rows, none failed"
    names = ", ".join(row.name for row in failed)
    return f"failed: {len(failed)} of {len(score.rows)} rows: {names}"
