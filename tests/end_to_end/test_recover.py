# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim recover`` as the user meets it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.records import ChunkIndex

from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sensors import IdealAccelerometer
from roller_sim_ros.session import Session
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire import messages

START_NS = 1_700_000_000_000_000_000
BLOCKS = 64


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    """A short run of the roller, in many chunks."""
    path = tmp_path_factory.mktemp("run") / "whole.mcap"
    configuration = Configuration()
    session, sensor = Session(configuration), IdealAccelerometer()
    with TraceWriter(path, run_metadata(configuration, START_NS), flush_period_s=0.0) as trace:
        names = register_all(trace, configuration.pacing)
        for _ in range(BLOCKS):
            block = session.advance(16)
            message = messages.drum_acceleration(sensor.read(block)[0], START_NS)
            stamp = message.stamp_ns
            trace.put(names[message.topic], message.data, stamp, stamp)
    return path


def chunks(path: Path) -> list[ChunkIndex]:
    with path.open("rb") as stream:
        return make_reader(stream).get_summary().chunk_indexes


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", "recover", *map(str, arguments)],
        capture_output=True,
        text=True,
    )


def one_clear_line(result: subprocess.CompletedProcess[str], *words: str) -> None:
    assert result.returncode == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith("roller-sim recover: error: ")
    for word in words:
        assert word in line
    assert result.stdout == ""


def test_cut_trace_becomes_a_whole_one_and_the_account_is_printed(whole, tmp_path: Path) -> None:
    broken, target = tmp_path / "broken.mcap", tmp_path / "out.mcap"
    # In the middle of a chunk, as when the process was killed.
    cut = chunks(whole)[40].chunk_start_offset + 100
    broken.write_bytes(whole.read_bytes()[:cut])
    result = run(broken, "-o", target)
    assert (result.returncode, result.stderr) == (0, "")
    text = result.stdout
    kept = len(list(TraceReader(target).messages()))
    assert kept == 40
    # The first lines say what counts as loss and what as failure.
    assert text.startswith("Lost is a message that the file no longer holds with all its bytes")
    introduction, _, rest = text.partition("\n\n")
    assert "failure (exit code 1)" in " ".join(introduction.split())
    assert "up to 0.5 s, its flush period" in " ".join(introduction.split())
    assert f"100 of {cut} bytes cannot be used" in rest
    assert f"{target}: {kept} messages, " in rest
    (row,) = (line for line in rest.splitlines() if line.startswith("/drum/acceleration "))
    assert row.split()[1] == str(kept)
    assert row.split()[4:] == ["0", "none"]


def test_lost_samples_are_named(whole, tmp_path: Path) -> None:
    content = bytearray(whole.read_bytes())
    index = chunks(whole)[10]
    content[index.chunk_start_offset + index.chunk_length - 3] ^= 0x55
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(bytes(content))
    result = run(broken)
    assert result.returncode == 0
    assert "1 message lost" in result.stdout
    assert "16 samples: 160 to 175" in result.stdout
    assert (tmp_path / "broken.recovered.mcap").is_file()


def test_whole_trace_is_left_alone(whole, tmp_path: Path) -> None:
    before = sorted(whole.parent.iterdir())
    result = run(whole)
    assert result.returncode == 0
    assert result.stdout.startswith(f"{whole} is whole: {BLOCKS} messages, ")
    assert "nothing was written" in result.stdout
    assert sorted(whole.parent.iterdir()) == before
    copy = tmp_path / "copy.mcap"
    result = run(whole, "-o", copy)
    assert f"{copy} is a copy of it" in result.stdout
    assert copy.read_bytes() == whole.read_bytes()


def test_what_goes_wrong_is_one_clear_line(whole, tmp_path: Path) -> None:
    one_clear_line(run(tmp_path / "no.mcap"), "no.mcap: there is no such file")
    text = tmp_path / "text.mcap"
    text.write_text("no trace")
    one_clear_line(run(text), "it is no MCAP file")
    text.write_bytes(whole.read_bytes()[:200])
    one_clear_line(run(text), "its 200 bytes hold not one message", "nothing was written")
    text.write_bytes(whole.read_bytes()[:-1])
    one_clear_line(run(text, "-o", whole), "there already is such a file", "-o")
    one_clear_line(run(text, "-o", tmp_path / "no" / "a.mcap"), "there is no folder")
    one_clear_line(run(tmp_path), "cannot be read: is a directory")


def test_help_is_worth_reading() -> None:
    result = run("--help")
    assert result.returncode == 0
    for word in ("never changed", "exit code 1", "default: ", "example:", "-o whole.mcap"):
        assert word in result.stdout
