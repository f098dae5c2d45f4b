# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The page: one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime, timezone
from html import escape
from typing import Any

import numpy as np

from roller_sim_ros import __version__
from roller_sim_ros.meters import Mode
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.report import figures
from roller_sim_ros.report.run_record import RunRecord
from roller_sim_ros.report.windows import Window

MOST_ROWS = 100
"""Rows of a table that are shown; how many there are more is said."""

STYLE = """\
:root { color-scheme: light dark; --bad: #c0392b; --good: #2c7a4b; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; margin-bottom: 0; } h2 { font-size: 1.15rem; margin-top: 2.2rem; }
.lead { opacity: .7; margin-top: .2rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .15rem 1.2rem .15rem 0; vertical-align: top; }
th { font-weight: 600; }
figure { margin: 1rem 0; overflow-x: auto; }
figure svg { display: block; width: 100%; height: auto; min-width: 44rem; }
.panels { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: .5rem 1rem; }
.panels svg { min-width: 0; }
@media screen and (max-width: 44rem) { .panels { grid-template-columns: minmax(0, 1fr); } }
.scroll { overflow-x: auto; } .pass { color: var(--good); } .fail { color: var(--bad); font-weight: 600; }
.warn { border-left: 4px solid var(--bad); padding-left: .8rem; }
details { margin: .6rem 0; } summary { cursor: pointer; } pre { overflow-x: auto; }
@media screen and (prefers-color-scheme: dark) {
  :root { --bad: #ff8a7a; --good: #7fce9c; }
  /* White becomes the dark of the page, and a hue remains what it is. */
  figure svg { filter: invert(.93) hue-rotate(180deg); }
}
@page {
  size: A4; margin: 14mm 14mm 18mm;
  @bottom-right { content: counter(page) " / " counter(pages); font: 8pt sans-serif; }
}
@media print {
  :root { color-scheme: light; }
  body { font-size: 9pt; line-height: 1.4; max-width: none; margin: 0; padding: 0; }
  h1 { font-size: 15pt; margin-top: 0; } h2 { font-size: 11pt; margin: 5mm 0 1mm; }
  h2, summary, thead { break-after: avoid; } section, tr { break-inside: avoid; }
  figure { margin: 1mm 0; overflow: visible; } figure svg { min-width: 0; }
  .panels { gap: 1mm 3mm; }
  .scroll, pre { overflow: visible; } pre { font-size: 6.8pt; white-space: pre-wrap; }
  details { font-size: 7.5pt; } details:not([open]) { display: none; }
  details .scroll, .many .scroll { columns: 2; column-gap: 8mm; } .gaps .scroll { columns: 3; }
  td + td, pre { overflow-wrap: anywhere; }
  summary { font-size: 11pt; font-weight: bold; list-style: none; margin: 5mm 0 1mm; }
}
"""


def page(
    record: RunRecord, windows: Sequence[Window], score: Mapping[str, Any] | None = None
) -> str:
    """Return the report as HTML.

    Parameters
    ----------
    record : RunRecord
        The run.
    windows : sequence of Window
        Stretches that show how it moved.
    score : mapping, optional
        A verdict as `roller_sim_ros.score.report.as_object` has it.
    """
    title = record.scenario.get("title") or record.path.name
    start = datetime.fromtimestamp(record.start_ns / 1e9, timezone.utc)
    parts = [
        f"<h1>{escape(title)}</h1>",
        (
            f'<p class="lead">{escape(record.path.name)}, {start:%Y-%m-%d %H:%M:%S} UTC, '
            f"{record.duration_s:.1f}\N{NO-BREAK SPACE}s; reported by roller_sim_ros {__version__}</p>"
        ),
    ]
    if record.damage:
        parts.append(f'<p class="warn">{escape(record.damage)}</p>')
    parts += ["<h2>Facts</h2>", _table((), _facts(record))]
    if score is not None:
        parts += _score(score)
    parts.append(_section("Over time", f"<figure>{figures.over_time(record)}</figure>"))
    along = figures.over_chainage(record)
    if along:
        parts.append(_section("Along the lane", f"<figure>{along}</figure>"))
    for window in windows:
        text = (
            f"<p>{100.0 * window.share:.3g} % of the revolutions; here the 16 up to {window.time_s:.2f} s, "
            f"{window.excitation_hz:.4g} Hz.</p>"
        )
        panels = "\n".join(figures.of_window(window))
        shown = f'{text}\n<figure class="panels">{panels}</figure>'
        parts.append(_section(window.mode.label.capitalize(), shown))
    parts += ["<h2>Gaps</h2>", f'<div class="many gaps">{_gaps(record)}</div>']
    parts += ["<h2>Events</h2>", f'<div class="many">{_events(record)}</div>']
    parts += _parameters(record)
    body = "\n".join(parts)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n"
    )


def _facts(record: RunRecord) -> list[tuple[str, str]]:
    parameters = record.parameters
    facts = [
        ("samples", f"{record.samples:,} in {record.messages:,} messages"),
        ("missing", f"{sum(max(0, gap.samples) for gap in record.gaps):,} samples"),
    ]
    if "machine.drum_mass_kg" in parameters:
        mass_kg = float(parameters["machine.drum_mass_kg"])
        facts.append(("drum", f"{mass_kg:,.0f} kg vibrating"))
    if "half_space.model" in parameters:
        facts.append(("half space", parameters["half_space.model"]))
    low, high = np.nanmin(record.envelope["low"]), np.nanmax(record.envelope["high"])
    facts.append(
        ("acceleration", f"{low / GRAVITY_M_S2:.2f} to {high / GRAVITY_M_S2:.2f} g, vertical")
    )
    for name in ("cmv", "rmv"):
        values = record.meter.get(name)
        if values is not None and np.isfinite(values).any():
            least, middle, most = np.nanpercentile(values, (5, 50, 95))
            text = f"median {middle:.1f}; 5 to 95 % of the values: {least:.1f} to {most:.1f}"
            facts.append((name.upper(), text))
    if record.meter:
        modes = record.meter["mode"]
        shares = {mode: np.count_nonzero(modes == int(mode)) / len(modes) for mode in Mode}
        text = ", ".join(
            f"{mode.label} {100.0 * share:.3g}\N{NO-BREAK SPACE}%"
            for mode, share in shares.items()
            if share
        )
        facts.append(("modes", text))
    if record.site:
        facts.append(("passes", f"{int(record.site['pass_number'].max())}"))
    return facts


def _score(score: Mapping[str, Any]) -> list[str]:
    verdict = "passed" if score["passed"] else "failed"
    style = "pass" if score["passed"] else "fail"
    rows = [
        (
            row["name"],
            _number(row["found"]),
            _number(row["limit"]),
            row["unit"],
            row["verdict"],
            row["detail"],
        )
        for row in score["rows"]
    ]
    return [
        "<h2>Verdict</h2>",
        f'<p>{escape(score["topic"])} <span class="{style}">{verdict}</span></p>',
        _table(("row", "found", "limit", "unit", "verdict", ""), rows),
    ]


def _number(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else "" if value is None else str(value)


def _gaps(record: RunRecord) -> str:
    if not record.gaps:
        return "<p>None: every sample follows the one before it.</p>"
    rows = [
        (
            f"{gap.time_s:.3f}",
            f"{gap.samples} missing" if gap.samples > 0 else f"{-gap.samples} again or late",
        )
        for gap in record.gaps
    ]
    return _table(("s", "samples"), rows)


def _events(record: RunRecord) -> str:
    if not record.events:
        return "<p>Nothing was changed, and no fault was active.</p>"
    rows = [(f"{event.time_s:.3f}", event.what) for event in record.events]
    return _table(("s", "what took effect"), rows)


def _parameters(record: RunRecord) -> list[str]:
    parts = []
    if record.parameters:
        rows = sorted(record.parameters.items())
        table = _table(("parameter", "value, SI units"), rows, most=len(rows))
        parts.append(f"<details><summary>Parameters as the run began</summary>{table}</details>")
    if record.scenario.get("text"):
        text = escape(record.scenario["text"])
        parts.append(f"<details><summary>Scenario</summary><pre>{text}</pre></details>")
    rows = sorted((name, f"{number:,}") for name, number in record.topics.items())
    table = _table(("topic", "messages"), rows, most=len(rows))
    parts.append(f"<details><summary>Topics of the trace</summary>{table}</details>")
    return parts


def _section(title: str, content: str) -> str:
    return f"<section>\n<h2>{escape(title)}</h2>\n{content}\n</section>"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]], most: int = MOST_ROWS) -> str:
    rows = list(rows)
    lines = ['<div class="scroll"><table>']
    if head:
        names = "".join(f"<th>{escape(name)}</th>" for name in head)
        lines.append(f"<thead><tr>{names}</tr></thead>")
    for row in rows[:most]:
        first = "th" if not head else "td"
        cells = [f"<{first}>{escape(row[0])}</{first}>"]
        cells += [f"<td>{escape(cell)}</td>" for cell in row[1:]]
        lines.append("<tr>" + "".join(cells) + "</tr>")
    lines.append("</table></div>")
    if len(rows) > most:
        lines.append(f"<p>… and {len(rows) - most} more.</p>")
    return "\n".join(lines)
