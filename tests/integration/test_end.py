# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How the node ends, and what becomes of the bag: signals, kills, full and unwritable disks."""

from __future__ import annotations

import resource
import signal
import time
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from roller_sim_ros.msg import DrumAcceleration
from tests.integration.harness import entry, recorded, roller_sim, values


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signal_ends_within_two_seconds_with_a_whole_bag(start, client, tmp_path, number):
    bag = tmp_path / "trace.mcap"
    sim = start("--record", str(bag))
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    client.spin_until(lambda: blocks and "rec" in sim.said)
    began = time.monotonic()
    assert sim.end(number) == 0
    assert time.monotonic() - began < 2.0
    *lines, summary, last = sim.said.splitlines()
    for word in ("Hz", "mm", "MPa", "CMV", "RMV", "late", "rec"):
        assert word in lines[-1]
    assert summary.startswith("ran ")
    assert str(bag) in last
    assert sim.complaints == []
    assert "is whole" in roller_sim("recover", bag)
    last = recorded(bag, "/drum/acceleration")[-1].sequence
    client.spin_until(lambda: blocks[-1].sequence >= last)
    assert blocks[-1].sequence == last


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signal_while_it_starts(start, number):
    sim = start()
    maps = Path(f"/proc/{sim.process.pid}/maps")
    while "llvmlite" not in maps.read_text():  # it is among the imports
        time.sleep(0.02)
    began = time.monotonic()
    assert sim.end(number) == 0
    assert time.monotonic() - began < 2.0
    assert sim.said == "stopped before the roller ran\n"
    assert sim.complaints == []


def test_kill_loses_less_than_two_seconds(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    sim = start("--record", str(bag))
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    client.spin_until(lambda: len(blocks) > 400)
    sim.process.send_signal(signal.SIGKILL)
    sim.process.wait()
    client.spin_for(0.5)
    mended = tmp_path / "mended.mcap"
    roller_sim("recover", bag, "-o", mended)
    kept = recorded(mended, "/drum/acceleration")
    lost_s = (blocks[-1].sequence - kept[-1].sequence) * blocks[-1].sample_period
    assert lost_s <= 2.0
    assert [block.sequence for block in kept] == [16 * index for index in range(len(kept))]


@pytest.mark.parametrize(
    ("name", "words"), [("missing/trace.mcap", "no folder"), ("there.mcap", "already")]
)
def test_unwritable_path_is_refused_in_one_line(start, tmp_path, name, words):
    (tmp_path / "there.mcap").write_bytes(b"of value")
    sim = start("--record", str(tmp_path / name))
    assert sim.wait() == 1
    assert len(sim.complaints) == 1
    assert name in sim.complaints[0]
    assert words in sim.complaints[0]
    assert sim.said == ""
    assert (tmp_path / "there.mcap").read_bytes() == b"of value"


def test_full_disk_ends_the_recording_not_the_roller(start, client, tmp_path):
    bag = tmp_path / "trace.mcap"
    sim = start("--record", str(bag))
    # To the process that writes, a file that must not grow is what a full disk is.
    resource.prlimit(client.spin_until(sim.child), resource.RLIMIT_FSIZE, (60_000, 60_000))
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    status = client.spin_until(
        lambda: (
            (found := entry(diagnostics, "recording"))
            and found.level == DiagnosticStatus.ERROR
            and int(values(found)["dropped"])
            and found
        )
    )
    assert str(bag) in status.message
    assert values(status)["state"] == "failed"
    count = len(blocks)
    client.spin_until(lambda: len(blocks) > count + 100)
    assert sim.end() == 0
    assert "recording failed" in sim.said
    mended = tmp_path / "mended.mcap"
    roller_sim("recover", bag, "-o", mended)
    assert mended.stat().st_size > 20_000
