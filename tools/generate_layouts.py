# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Writes the layouts for Foxglove and PlotJuggler from one list of panels (`make docs`).

Both draw each element of an array as a curve of its own, so that panels hold scalar fields: per sample those of
``drum/imu``, per block and revolution those of the other topics. ``--check`` writes nothing and fails when a file is
not what it would be.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from tools.generated import write_or_check

ROOT = Path(__file__).resolve().parent.parent


@dataclass(frozen=True)
class Panel:
    """A plot over time.

    Attributes
    ----------
    title : str
        What it shows, with the unit.
    curves : tuple of str
        Fields as in ``/topic/name.field.part``.
    """

    title: str
    curves: tuple[str, ...]


PANELS = (
    Panel(
        "acceleration, m/s² (specific force: +9.81 on z at rest)",
        ("/drum/imu.linear_acceleration.z", "/drum/imu.linear_acceleration.x"),
    ),
    Panel("CMV and RMV: measured and true", ("/meter.cmv", "/meter.rmv", "/truth.cmv")),
    Panel(
        "mode: 1 contact, 2 uplift, 3 double jump, 4 quad jump, 5 chaotic",
        ("/truth.mode", "/meter.mode"),
    ),
    Panel("greatest soil force over the static one", ("/truth.force_ratio_max",)),
    Panel("excitation, Hz", ("/exciter/state.frequency", "/exciter/state.commanded_frequency")),
    Panel("amplitude, m", ("/exciter/state.amplitude", "/exciter/state.commanded_amplitude")),
    Panel("shear modulus, Pa", ("/truth.shear_modulus",)),
    Panel(
        "along the lane: chainage, m, and pass", ("/site/state.chainage", "/site/state.pass_number")
    ),
)

COLUMNS = 2
COLOURS = ("#1f77b4", "#d62728", "#2ca02c")


def contents() -> dict[str, str]:
    """Return {path from the root: text} of all generated files."""
    return {"layouts/foxglove.json": foxglove(), "layouts/plotjuggler.xml": plotjuggler()}


def foxglove() -> str:
    """Return the layout as Foxglove imports it (Layouts, Import from file)."""
    configurations = {
        f"Plot!roller{number}": {
            "title": panel.title,
            "paths": [
                {
                    "value": curve,
                    "label": curve,
                    "enabled": True,
                    "timestampMethod": "headerStamp",
                    "color": colour,
                }
                for curve, colour in zip(panel.curves, COLOURS, strict=False)
            ],
            "showLegend": True,
            "legendDisplay": "floating",
            "showPlotValuesInLegend": True,
            "isSynced": True,
            "xAxisVal": "timestamp",
            "showXAxisLabels": True,
            "showYAxisLabels": True,
        }
        for number, panel in enumerate(PANELS)
    }
    rows = [list(configurations)[at : at + COLUMNS] for at in range(0, len(PANELS), COLUMNS)]
    layout = {
        "configById": configurations,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": _split([_split(list(row), "row") for row in rows], "column"),
    }
    return json.dumps(layout, indent=2, ensure_ascii=False) + "\n"


def _split(parts: list[object], direction: str) -> object:
    """Return parts side by side, each with the same share; Foxglove splits in two."""
    if len(parts) == 1:
        return parts[0]
    return {
        "first": parts[0],
        "second": _split(parts[1:], direction),
        "direction": direction,
        "splitPercentage": round(100.0 / len(parts), 3),
    }


def plotjuggler() -> str:
    """Return the layout as PlotJuggler loads it (Layout, Import)."""
    root = ElementTree.Element("root")
    tabs = ElementTree.SubElement(
        root, "tabbed_widget", {"parent": "main_window", "name": "Main Window"}
    )
    tab = ElementTree.SubElement(tabs, "Tab", tab_name="roller", containers="1")
    container = ElementTree.SubElement(tab, "Container")
    rows = [PANELS[at : at + COLUMNS] for at in range(0, len(PANELS), COLUMNS)]
    column = _splitter(container, "-", len(rows))
    for row in rows:
        beside = _splitter(column, "|", len(row))
        for panel in row:
            area = ElementTree.SubElement(beside, "DockArea", name=panel.title)
            plot = ElementTree.SubElement(area, "plot", mode="TimeSeries", style="Lines")
            ElementTree.SubElement(plot, "limitY")
            for curve, colour in zip(panel.curves, COLOURS, strict=False):
                name = curve.replace(".", "/")
                ElementTree.SubElement(plot, "curve", name=name, color=colour)
    ElementTree.SubElement(tabs, "currentTabIndex", index="0")
    ElementTree.SubElement(root, "use_relative_time_offset", enabled="1")
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f"<?xml version='1.0' encoding='UTF-8'?>\n{text}\n"


def _splitter(parent: ElementTree.Element, orientation: str, count: int) -> ElementTree.Element:
    sizes = ";".join([f"{1.0 / count:.4f}"] * count)
    return ElementTree.SubElement(
        parent, "DockSplitter", orientation=orientation, sizes=sizes, count=str(count)
    )


def main(arguments: Sequence[str]) -> int:
    return write_or_check(ROOT, contents(), arguments, "make docs")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
