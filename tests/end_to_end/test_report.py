# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`roller-sim report`: one page that needs nothing else and says what the trace says."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.report.displacement import twice_integrated, without_sinking
from roller_sim_ros.report.run_record import read_run
from roller_sim_ros.report.windows import read_windows
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.types import decode

SCENARIO = """\
title: <soft & stiff>
machine: {preset: paper-10t}
lane: {length_m: 12}
travel: {speed_m_s: 1.5, passes: 2}
ground:
  preset: paper-soft
  features:
    - kind: section
      from_m: 6
      to_m: 12
      shear_modulus_mpa: 80
      plastic_mm: 0.5
exciter: {frequency_hz: 28, amplitude_mm: 1.6}
sensors:
  - name: mems_50g
faults:
  - id: bias_step
    from_s: 2
    to_s: 3
seed: 3
"""


class Page(HTMLParser):
    """Texts of the page by the element that they stand in, and what it would load."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.texts: dict[str, list[str]] = {}
        self.loads: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.open.append(tag)
        for name, value in attrs:
            if name in ("src", "href", "xlink:href") and value and not value.startswith("#"):
                self.loads.append(value)

    def handle_endtag(self, tag: str) -> None:
        while self.open and self.open.pop() != tag:
            pass

    def handle_data(self, data: str) -> None:
        if self.open and data.strip():
            self.texts.setdefault(self.open[-1], []).append(data.strip())


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("report")
    (folder / "lane.yaml").write_text(SCENARIO, encoding="utf-8")
    path = folder / "lane.mcap"
    assert commands.main(["run", str(folder / "lane.yaml"), "--record", str(path)]) == 0
    return path


def report(trace: Path, *arguments: str, code: int = 0) -> Page:
    path = trace.with_suffix(".html")
    assert commands.main(["report", str(trace), "-o", str(path), *arguments]) == code
    return Page(path.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def page(trace: Path) -> Page:
    return report(trace)


def test_the_page_needs_nothing_else(trace: Path, page: Page) -> None:
    assert page.loads == []
    text = trace.with_suffix(".html").read_text(encoding="utf-8")
    assert "@import" not in text
    assert "<script" not in text
    # Each name once, although the figures come from one library.
    names = re.findall(r'\bid="([^"]+)"', text)
    assert len(names) == len(set(names)) > 100
    for name in re.findall(r'(?:url\(#|href="#)([^)"]+)', text):
        assert name in names


def test_it_says_what_the_trace_says(
    trace: Path, page: Page, capsys: pytest.CaptureFixture[str]
) -> None:
    assert page.texts["h1"] == ["<soft & stiff>"]
    capsys.readouterr()
    assert commands.main(["analyze", str(trace), "--json", "-"]) == 0
    analysis = json.loads(capsys.readouterr().out)
    cells = page.texts["td"]
    assert any(cell.startswith(f"{analysis['samples']:,} in ") for cell in cells)
    assert "fault bias_step begins" in cells
    assert "fault bias_step ends" in cells
    headings = page.texts["h2"]
    assert "Double jump" in headings
    assert "Along the lane" in headings
    assert page.texts["pre"][0].startswith("title: <soft & stiff>")


def test_windows_hold_the_samples_of_the_trace(trace: Path) -> None:
    record = read_run(trace, None)
    windows = read_windows(record, lambda _share: None)
    assert 1 < len(windows) <= 4
    vertical = np.concatenate(
        [
            np.asarray(decode(item.data, item.type_name).vertical)
            for item in TraceReader(trace).messages({"/drum/acceleration"})
        ]
    )
    force = np.concatenate(
        [
            np.asarray(decode(item.data, item.type_name).soil_force)
            for item in TraceReader(trace).messages({"/truth"})
        ]
    )
    for window in windows:
        row = int(np.argmin(np.abs(record.meter["time_s"] - window.time_s)))
        last = int(record.meter["last_sample"][row])
        assert record.meter["mode"][row] == window.mode
        np.testing.assert_array_equal(window.vertical, vertical[last - 2047 : last + 1])
        np.testing.assert_array_equal(window.truth["soil_force"], force[last - 2047 : last + 1])


def test_columns_are_the_messages_decoded_one_by_one(trace: Path) -> None:
    record = read_run(trace, None)
    messages = [
        decode(item.data, item.type_name) for item in TraceReader(trace).messages({"/meter"})
    ]
    np.testing.assert_array_equal(record.meter["cmv"], [item.cmv for item in messages])
    np.testing.assert_array_equal(record.meter["mode"], [item.mode for item in messages])
    assert record.gaps == []


def test_gaps_are_found(trace: Path, tmp_path: Path) -> None:
    path = tmp_path / "gaps.mcap"
    reader = TraceReader(trace)
    with TraceWriter(path, {}) as writer:
        for info in reader.topics.values():
            writer.register(info.name, info.type_name, info.schema_text, "")
        number = 0
        for item in reader.messages():
            if item.topic == "/drum/acceleration":
                number += 1
                if 100 <= number < 103:
                    continue
            writer.put(item.topic, item.data, item.log_time_ns, item.publish_time_ns)
    (gap,) = read_run(path, None).gaps
    samples = len(
        decode(
            next(reader.messages({"/drum/acceleration"})).data,
            "roller_sim_ros/msg/DrumAcceleration",
        ).vertical
    )
    assert gap.samples == 3 * samples


def test_the_verdict_on_a_meter_is_in_it(trace: Path) -> None:
    page = report(trace, "--meter", "/meter")
    assert "Verdict" in page.texts["h2"]
    assert page.texts["span"][0] in ("passed", "failed")


def test_a_damaged_trace_is_shown_as_far_as_it_goes(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = trace.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data[: len(data) // 2])
    page = report(cut, code=1)
    assert "roller-sim recover" in capsys.readouterr().err
    assert any("roller-sim recover" in text for text in page.texts["p"])


def test_what_cannot_be_reported_is_said_in_a_line(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, said in (
        ([str(tmp_path / "none.mcap")], "none.mcap"),
        ([str(trace), "--topic", "/nobody"], "on /nobody"),
        ([str(trace), "-o", str(tmp_path / "missing" / "page.html")], "cannot be written"),
        ([str(trace), "-o", str(tmp_path)], "is a folder"),
        ([str(trace), "-o", str(tmp_path / "page.pdf")], "--pdf"),
        ([str(trace), "-o", str(tmp_path / "a"), "--pdf", str(tmp_path / "a")], "both"),
        ([str(trace), "-o", str(tmp_path / "a"), "--pdf", str(tmp_path / "b" / "c")], "no such"),
    ):
        capsys.readouterr()
        assert commands.main(["report", *arguments]) == 1
        error = capsys.readouterr().err
        assert said in error
        assert error.count("\n") == 1


def test_without_a_browser_there_is_no_pdf_and_a_way_out(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CHROMIUM", raising=False)
    page = tmp_path / "page.html"
    assert commands.main(["report", str(trace), "-o", str(page), "--pdf"]) == 1
    error = capsys.readouterr().err
    assert "apt-get install chromium" in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_ended_while_it_prints_it_leaves_nothing_half_done(
    trace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    browser, page = tmp_path / "browser", tmp_path / "out" / "page.html"
    browser.write_text("#!/bin/sh\nkill -TERM $PPID\nexec sleep 600\n", encoding="utf-8")
    browser.chmod(0o755)
    page.parent.mkdir()
    monkeypatch.setenv("CHROMIUM", str(browser))
    monkeypatch.setattr("roller_sim_ros.report.page.page", lambda *_: "<p>drawn elsewhere")
    assert commands.main(["report", str(trace), "-o", str(page), "--pdf"]) == 130
    assert list(page.parent.iterdir()) == [page]
    assert page.read_text(encoding="utf-8") == "<p>drawn elsewhere"


def test_displacement_is_the_acceleration_integrated_twice() -> None:
    rate_hz, hz = 3584.0, 28.0
    time_s = np.arange(2048) / rate_hz
    turn = 2.0 * np.pi * hz
    acceleration = -(turn**2) * (
        1e-3 * np.sin(turn * time_s) + 2e-4 * np.cos(turn * time_s / 2) / 4
    )
    expected = 1e-3 * np.sin(turn * time_s) + 2e-4 * np.cos(turn * time_s / 2)
    np.testing.assert_allclose(twice_integrated(acceleration, rate_hz), expected, atol=1e-12)


def test_sinking_is_told_from_jumping() -> None:
    turns = np.arange(2048) / 128
    jumping = 1e-3 * np.sin(np.pi * turns) + 5e-4 * np.sin(2.0 * np.pi * turns)
    height, sinking_m = without_sinking(jumping - 3e-4 * turns)
    assert sinking_m == pytest.approx(3e-4, rel=1e-9)
    np.testing.assert_allclose(height, jumping, atol=1e-12)
