# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The page in a real browser, beside a client that hears the same topics."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from PIL import Image
from playwright.sync_api import Page, expect

from roller_sim_ros.meters.mode import Mode
from roller_sim_ros.msg import (
    AppliedChange,
    CompactionMeter,
    DrumSoilState,
    ExciterState,
    FaultStates,
)
from roller_sim_ros.traces.reader import TraceReader
from tests.integration.harness import PATIENCE_S, Client, entry, recorded

ROOT = Path(__file__).resolve().parents[2]
LARGEST_BYTES = 200_000
PHONE = {"width": 375, "height": 1250}

SHOWN = """() => ({
    sample: Number(document.getElementById("cmv").dataset.sample),
    cmv: document.getElementById("cmv").textContent,
    rmv: document.getElementById("rmv").textContent,
    mode: document.getElementById("mode").textContent,
})"""

DRAWN = "Number(document.getElementById('rate').dataset.drawn || 0)"

BLANK = """() => [...document.querySelectorAll("canvas")].filter((canvas) => {
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    const colours = new Set();
    for (let n = 0; n < pixels.length; n += 4) {
        if (pixels[n + 3] > 200) colours.add(pixels[n] << 16 | pixels[n + 1] << 8 | pixels[n + 2]);
    }
    return colours.size < 3;
}).map((canvas) => canvas.id)"""

BRIGHTNESS = """() => getComputedStyle(document.body).backgroundColor
    .match(/\\d+/g).slice(0, 3).reduce((sum, value) => sum + value / 3, 0)"""


def until(page: Page, done: Callable[[], bool]) -> None:
    """Wait for what the page shows; its own way to do so is against the page's policy."""
    deadline = time.monotonic() + PATIENCE_S
    while not done():
        assert time.monotonic() < deadline
        page.wait_for_timeout(20)


def live(page: Page) -> None:
    """Wait until the roller is heard, turns at its speed and has a meter value."""
    expect(page.locator("#link")).to_have_attribute("data-state", "live")
    expect(page.locator("#cmv")).to_have_text(re.compile(r"\d"))


def commanded(client: Client, page: Page, act: Callable[[], Any], wanted: dict[str, Any]) -> None:
    """Act on the page until the roller says that it has been told the wanted values."""
    # It says so again and again, so that nothing hangs on who has found whom by when.
    heard = client.listen("exciter/state", ExciterState)
    client.spin_until(lambda: heard)
    act()

    def arrived() -> bool:
        page.wait_for_timeout(1)
        return all(abs(getattr(heard[-1], name) - value) < 1e-9 for name, value in wanted.items())

    client.spin_until(arrived)
    client.listen_no_more()


def test_values_on_the_page_are_those_on_the_topics(page: Page, client: Client) -> None:
    live(page)
    meter = client.listen("meter", CompactionMeter)
    client.spin_until(lambda: meter)
    heard_from = meter[0].last_sample
    until(page, lambda: page.evaluate(SHOWN)["sample"] > heard_from + 128)
    shown = page.evaluate(SHOWN)
    message = client.spin_until(
        lambda: next((item for item in meter if item.last_sample == shown["sample"]), None)
    )
    client.listen_no_more()
    assert shown["cmv"] == f"{message.cmv:.1f}"
    assert shown["rmv"] == f"{message.rmv:.1f}"
    assert shown["mode"] == Mode(message.mode).label


def test_the_exciter_obeys_the_keyboard(page: Page, client: Client) -> None:
    live(page)
    expect(page.locator("#frequency-number")).to_have_value("28")
    slider = page.locator("#frequency-slider")
    slider.focus()
    # One of a thousand steps from 0 to 80 Hz.
    place = int(slider.input_value())
    wanted = {
        "vibrating": True,
        "commanded_frequency": 0.08 * (place + 1),
        "commanded_amplitude": 1.6e-3,
    }
    commanded(client, page, lambda: page.keyboard.press("ArrowRight"), wanted)

    number = page.locator("#amplitude-number")

    def write() -> None:
        number.fill("1.2")
        page.keyboard.press("Enter")

    commanded(client, page, write, {"vibrating": True, "commanded_amplitude": 1.2e-3})
    expect(page.locator("#amplitude")).to_have_text("1.200")

    page.keyboard.press("Tab")
    page.locator("#vibrate").focus()
    commanded(client, page, lambda: page.keyboard.press("Space"), {"vibrating": False})
    expect(page.locator("#vibrate")).to_have_attribute("aria-pressed", "false")
    commanded(client, page, lambda: page.keyboard.press("Space"), {"vibrating": True})
    expect(page.locator("#vibrate")).to_have_attribute("aria-pressed", "true")


def test_the_first_tab_leads_to_the_controls(page: Page) -> None:
    live(page)
    page.keyboard.press("Tab")
    expect(page.locator(".skip")).to_be_focused()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    expect(page.locator("#vibrate")).to_be_focused()
    assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid"


def test_what_the_roller_refuses_is_said(page: Page) -> None:
    live(page)
    page.locator("#frequency-number").fill("90")
    page.keyboard.press("Enter")
    expect(page.locator("#exciter-says")).to_contain_text("80")
    expect(page.locator("#exciter-says")).to_have_class(re.compile("bad"))
    page.locator("#frequency-number").fill("28")
    page.keyboard.press("Enter")
    expect(page.locator("#exciter-says")).to_contain_text("vibrates")


def test_the_ground_changes_with_its_sliders(page: Page, client: Client) -> None:
    live(page)
    applied = client.listen("applied", AppliedChange)
    client.spin_until(lambda: client.node.count_publishers("/applied"))
    page.locator("#shear-modulus-number").fill("60")
    page.keyboard.press("Enter")

    def arrived() -> bool:
        page.wait_for_timeout(1)
        return any((item.name, item.value) == ("soil.shear_modulus_pa", 60e6) for item in applied)

    client.spin_until(arrived)
    client.listen_no_more()
    expect(page.locator("#map-ground")).to_contain_text("G 60.0 MPa")


def test_faults_begin_and_end(page: Page, client: Client) -> None:
    live(page)
    faults = client.listen("faults", FaultStates)
    page.locator("#duration").fill("0")
    page.locator("[data-fault=gain_change]").click()
    expect(page.locator("[data-active=gain_change]")).to_be_visible()
    client.spin_until(
        lambda: any(item.id == "gain_change" for last in faults for item in last.faults)
    )
    page.locator("[data-active=gain_change] button").click()
    expect(page.locator("[data-active=gain_change]")).to_have_count(0)
    client.spin_until(lambda: not faults[-1].faults)
    client.listen_no_more()


def test_a_reload_recovers(page: Page) -> None:
    live(page)
    page.reload()
    live(page)
    until(page, lambda: page.evaluate(DRAWN) > 3)
    until(page, lambda: page.evaluate(BLANK) == [])


def test_a_recording_is_begun_and_ended(page: Page, client: Client, roller) -> None:
    live(page)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    page.locator("#record").click()
    expect(page.locator("#record")).to_have_attribute("aria-pressed", "true")
    expect(page.locator("#recording-says")).to_contain_text("panel_")
    live(page)
    client.spin_until(lambda: "panel_" in getattr(entry(diagnostics, "recording"), "message", ""))
    page.locator("#record").click()
    expect(page.locator("#record")).to_have_attribute("aria-pressed", "false")
    expect(page.locator("#recording-says")).to_have_text("nothing is recorded")
    truth = client.listen("truth", DrumSoilState)
    client.spin_until(lambda: truth)
    client.listen_no_more()
    (trace,) = roller.folder.glob("panel_*.mcap")
    assert TraceReader(trace).topics["/drum/acceleration"].messages > 0
    # The roller went on meanwhile.
    blocks = recorded(trace, "/truth")
    assert 0 < blocks[0].sequence < blocks[-1].sequence < truth[-1].sequence
    live(page)


def test_the_roller_comes_back(page: Page, client: Client, roller) -> None:
    live(page)
    roller.end()
    expect(page.locator("#link")).to_have_attribute("data-state", "silent")
    expect(page.locator("#vibrate")).to_be_disabled()
    roller.start()
    live(page)
    expect(page.locator("#vibrate")).to_be_enabled()
    commanded(client, page, lambda: page.locator("#vibrate").click(), {"vibrating": False})
    expect(page.locator("#vibrate")).to_have_attribute("aria-pressed", "false")
    commanded(client, page, lambda: page.locator("#vibrate").click(), {"vibrating": True})


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_screenshots(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme=scheme)
    phone = scheme == "dark"
    if phone:
        page.set_viewport_size(PHONE)
    live(page)
    expect(page.locator("#map-ground")).to_have_text(re.compile("MPa.*Hz$"))
    expect(page.locator("#rate")).to_have_text(re.compile("[1-9]"))
    expect(page.locator("#mode")).to_have_text("double jump")
    until(page, lambda: page.evaluate(BLANK) == [])
    # Nothing to push sideways, and nothing too small for a thumb.
    assert page.evaluate("document.documentElement.scrollWidth") <= page.viewport_size["width"]
    heights = page.eval_on_selector_all(
        "#controls button:not([hidden])", "all => all.map((item) => item.clientHeight)"
    )
    assert min(heights) >= 30
    brightness = page.evaluate(BRIGHTNESS)
    assert (brightness < 60) == (scheme == "dark")
    folder = Path(os.environ.get("ROLLER_SIM_SCREENSHOTS") or ROOT / "build" / "screenshots")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / ("panel_phone.png" if phone else "panel.png")
    page.screenshot(path=path, full_page=not phone)
    # Of few colours, as the page is: a third of the size.
    few = Image.open(path).convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE)
    few.save(path, optimize=True)
    assert 10_000 < path.stat().st_size < LARGEST_BYTES
