# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The report in a real browser: printed and read back, on a phone, in the dark."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from pypdf import PdfReader

from roller_sim_ros import commands

A4_PT = (595.3, 841.9)

SCENARIO = """\
title: soft & stiff
machine: {preset: paper-10t}
lane: {length_m: 12}
travel: {speed_m_s: 1.5}
ground:
  preset: paper-soft
  features: [{kind: section, from_m: 6, to_m: 12, shear_modulus_mpa: 80, plastic_mm: 0.5}]
exciter: {frequency_hz: 28, amplitude_mm: 1.6}
faults: [{id: bias_step, from_s: 2, to_s: 3}]
seed: 3
"""

# What is folded may be scrolled.
WIDER = """() => [...document.querySelectorAll("section, :not(details) > .scroll > table, .panels svg")]
    .filter((element) => element.getBoundingClientRect().right > innerWidth)
    .map((element) => element.textContent.trim().slice(0, 80))"""


@pytest.fixture(scope="module")
def html(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page, with the PDF beside it."""
    # A path too long for a socket, and names that have to be escaped in an address.
    folder = tmp_path_factory.mktemp("report") / ("bench #1, 50 % " * 8) / "ü"
    folder.mkdir(parents=True)
    (folder / "lane.yaml").write_text(SCENARIO, encoding="utf-8")
    trace, page = folder / "lane.mcap", folder / "report.html"
    assert commands.main(["run", str(folder / "lane.yaml"), "--record", str(trace)]) == 0
    assert commands.main(["report", str(trace), "-o", str(page), "--pdf"]) == 0
    return page


def plain(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def test_the_pdf_says_what_the_page_says(html: Path) -> None:
    reader = PdfReader(html.with_suffix(".pdf"), strict=True)
    assert reader.metadata is not None
    assert reader.metadata.title == "soft & stiff"
    pages = [plain(page.extract_text()) for page in reader.pages]
    assert 1 < len(pages) < 10
    for number, (page, text) in enumerate(zip(reader.pages, pages, strict=True), start=1):
        size = (float(page.mediabox.width), float(page.mediabox.height))
        assert size == pytest.approx(A4_PT, abs=1.0)
        assert f"{number} / {len(pages)}" in text
    source = html.read_text(encoding="utf-8")
    facts = re.findall(r"<tr><th>(.+?)</th><td>(.+?)</td></tr>", source)
    assert len(facts) > 5
    for name, value in facts:
        assert plain(f"{name} {value}") in pages[0]
    whole = " ".join(pages)
    # A folded part, and text that stands in a figure.
    for text in (
        "fault bias_step begins",
        "exciter.frequency_hz",
        "preset: paper-soft",
        "meter value",
    ):
        assert text in whole
    assert [str(item["/Title"]) for item in reader.outline if not isinstance(item, list)] == [
        "soft & stiff"
    ]


def test_no_figure_is_cut_in_two(html: Path) -> None:
    pages = [plain(page.extract_text()) for page in PdfReader(html.with_suffix(".pdf")).pages]
    first = [page.count("Vertical acceleration") for page in pages]
    assert sum(first) > 1
    assert [page.count("of the revolutions; here") for page in pages] == first
    assert [page.count("forward, mm") for page in pages] == first
    over_time = next(page for page in pages if "Over time" in page)
    assert "excitation, Hz" in over_time


def test_nothing_else_is_left(html: Path) -> None:
    names = sorted(path.name for path in html.parent.iterdir())
    assert names == ["lane.mcap", "lane.yaml", "report.html", "report.pdf"]


def test_it_fits_a_phone_and_is_dark_only_on_a_screen(html: Path, browser: Browser) -> None:
    context = browser.new_context(viewport={"width": 375, "height": 800}, color_scheme="dark")
    page = context.new_page()
    page.goto(html.as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") == 375
    assert page.evaluate(WIDER) == []
    dark = "getComputedStyle(document.querySelector('figure svg')).filter !== 'none'"
    assert page.evaluate(dark)
    page.emulate_media(media="print", color_scheme="dark")
    assert not page.evaluate(dark)
    assert page.evaluate("getComputedStyle(document.documentElement).colorScheme") == "light"
    context.close()
