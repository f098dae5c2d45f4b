# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The layouts are what the list of panels says, and every curve is a scalar field of a topic that is published."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from rosbags.interfaces import Nodetype

from roller_sim_ros.wire.topics import TOPICS, Direction
from roller_sim_ros.wire.types import typestore
from tools import generate_layouts
from tools.generated import stale

ROOT = Path(__file__).resolve().parents[2]
TYPES = {
    f"/{topic.name}": topic.type_name for topic in TOPICS if topic.direction is Direction.PUBLISHED
}


def field(type_name: str, names: list[str]) -> tuple[Nodetype, Any]:
    """The declaration of a field by the names that lead to it."""
    kind, of = dict(typestore().fielddefs[type_name][1])[names[0]]
    if len(names) == 1:
        return kind, of
    assert kind is Nodetype.NAME, f"{names[0]} of {type_name} is no message"
    return field(of, names[1:])


def foxglove_curves() -> list[tuple[str, list[str]]]:
    layout = json.loads((ROOT / "layouts/foxglove.json").read_text("utf-8"))
    found = []
    for panel in layout["configById"].values():
        for path in panel["paths"]:
            topic, *names = path["value"].split(".")
            found.append((topic, names))
    return found


def plotjuggler_curves() -> list[tuple[str, list[str]]]:
    root = ElementTree.parse(ROOT / "layouts/plotjuggler.xml").getroot()
    found = []
    for curve in root.iter("curve"):
        name = curve.attrib["name"]
        (topic,) = [it for it in TYPES if name.startswith(f"{it}/")]
        found.append((topic, name[len(topic) + 1 :].split("/")))
    return found


def test_layouts_are_not_stale() -> None:
    assert stale(ROOT, generate_layouts.contents()) == [], "run make docs"


@pytest.mark.parametrize("curves", [foxglove_curves, plotjuggler_curves])
def test_every_curve_is_a_scalar_that_is_published(curves: Any) -> None:
    found = curves()
    assert len(found) == sum(len(panel.curves) for panel in generate_layouts.PANELS)
    for topic, names in found:
        kind, of = field(TYPES[topic], names)
        assert kind is Nodetype.BASE, f"{topic} {names} is no scalar"
        assert of[0].startswith(("float", "int", "uint")), f"{topic} {names} is {of[0]}"


def test_foxglove_shows_every_panel_once() -> None:
    layout = json.loads((ROOT / "layouts/foxglove.json").read_text("utf-8"))

    def leaves(part: Any) -> list[str]:
        if isinstance(part, str):
            return [part]
        return leaves(part["first"]) + leaves(part["second"])

    assert sorted(leaves(layout["layout"])) == sorted(layout["configById"])


def test_plotjuggler_s_splitters_hold_what_they_count() -> None:
    root = ElementTree.parse(ROOT / "layouts/plotjuggler.xml").getroot()
    splitters = list(root.iter("DockSplitter"))
    assert splitters
    for splitter in splitters:
        assert len(splitter) == int(splitter.attrib["count"])
        assert len(splitter.attrib["sizes"].split(";")) == len(splitter)
