# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim play``: the example meter on played data says what it said live; the network sees the trace."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64

from roller_sim_ros.msg import CompactionMeter, DrumAcceleration, ExciterCommand, ExciterState
from roller_sim_ros.traces.reader import TraceReader
from tests.integration.harness import PATIENCE_S, Client, recorded, roller_sim

ROOT = Path(__file__).resolve().parents[2]
PLAY = (sys.executable, "-m", "roller_sim_ros.commands", "play")
METER = (sys.executable, str(ROOT / "examples" / "meter_client.py"))


def environment(domain: int, folder: Path) -> dict[str, str]:
    return {
        **os.environ,
        "ROS_DOMAIN_ID": str(domain),
        "ROS_LOG_DIR": str(folder),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }


@contextmanager
def process(domain: int, folder: Path, *command: str) -> Iterator[subprocess.Popen[str]]:
    started = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment(domain, folder),
        start_new_session=True,
    )
    try:
        yield started
    finally:
        if started.poll() is None:
            started.kill()
        started.communicate()


def play(domain: int, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*PLAY, *arguments],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        env=environment(domain, folder),
        check=False,
    )


def said(meter: subprocess.Popen[str]) -> dict[int, str]:
    """End the example meter and return {last sample: CMV} in its own words."""
    meter.send_signal(signal.SIGINT)
    output, errors = meter.communicate(timeout=PATIENCE_S)
    assert meter.returncode == 0, errors
    return {int(line.split()[0]): line.split()[1] for line in output.splitlines()}


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a trace of 60 revolutions of double jump."""
    path = tmp_path_factory.mktemp("trace") / "trace.mcap"
    soil = ("--shear-modulus-mpa", "80", "--plastic-mm", "0.5")
    roller_sim("run", *soil, "--revolutions", "60", "--record", str(path))
    return path


@pytest.mark.timeout(120)
def test_example_meter_says_the_same_live_and_on_played_data(
    start, own_domain: int, client: Client, tmp_path: Path
) -> None:
    bag = tmp_path / "live.mcap"
    published = client.listen("my_cmv", Float64)
    with process(own_domain, tmp_path, *METER) as meter:
        client.spin_until(lambda: client.node.count_publishers("my_cmv"))
        rates = ("-p", "exciter.frequency_rate_hz_per_s:=100.0")
        sim = start("--record", str(bag), "--ros-args", *rates)
        client.spin_until(lambda: len(published) >= 30)
        assert sim.end() == 0
        live = said(meter)
    with process(own_domain, tmp_path, *METER) as meter:
        before = len(published)
        client.spin_until(lambda: client.node.count_publishers("my_cmv"))
        played = play(own_domain, tmp_path, str(bag), "--subscribers", "1")
        assert played.returncode == 0, played.stderr
        client.spin_until(lambda: len(published) >= before + 30)
        again = said(meter)
    # Every digit, and at all revolutions but those for which a process was not there yet.
    common = live.keys() & again.keys()
    assert len(common) >= 30
    assert [live[sample] for sample in common] == [again[sample] for sample in common]
    # They are the node's own values, too.
    own = {value.last_sample: value.cmv for value in recorded(bag, "/meter") if not value.status}
    assert len(own.keys() & common) >= 15
    for sample in own.keys() & common:
        assert float(again[sample]) == pytest.approx(own[sample], abs=1e-6)


@pytest.mark.timeout(120)
def test_bytes_order_spacing_and_quality_of_service_are_those_of_the_trace(
    own_domain: int, client: Client, tmp_path: Path, trace: Path
) -> None:
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    values = client.listen("meter", CompactionMeter)
    sent_ns: list[int] = []

    def note(_block: DrumAcceleration, info: dict[str, Any]) -> None:
        sent_ns.append(info["source_timestamp"])

    client.node.create_subscription(DrumAcceleration, "drum/acceleration", note, 1000)
    with process(own_domain, tmp_path, *PLAY, str(trace), "--subscribers", "3") as player:
        client.spin_until(lambda: len(values) == 60 and len(blocks) == len(sent_ns) == 480)
        topics = {name: info[0] for name, info in described(client).items() if info}
        assert player.wait(PATIENCE_S) == 0
        output, _ = player.communicate()
    expected = recorded(trace, "/drum/acceleration")
    assert [block.sequence for block in blocks] == [block.sequence for block in expected]
    for block, original in zip(blocks, expected, strict=True):
        assert block.vertical.tobytes() == original.vertical.tobytes()
        assert (block.header.stamp.sec, block.header.stamp.nanosec) == (
            original.header.stamp.sec,
            original.header.stamp.nanosec,
        )
        assert block.eccentric_phase == original.eccentric_phase
    # Each was sent when it was due after the first, or as much later as the player says.
    late = re.search(r", at most ([\d.]+) ms late", output)
    assert late is not None
    slack_ns = 1e6 * float(late[1]) + 50e6
    due_ns = [item.publish_time_ns for item in TraceReader(trace).messages(["/drum/acceleration"])]
    # 60 revolutions at 28 Hz, less one block.
    assert due_ns[-1] - due_ns[0] == pytest.approx((60 - 1 / 8) / 28.0 * 1e9, rel=1e-6)
    for sent, due in zip(sent_ns, due_ns, strict=True):
        assert abs((sent - sent_ns[0]) - (due - due_ns[0])) <= slack_ns
    assert topics["/drum/acceleration"] == ("RELIABLE", "VOLATILE")
    assert topics["/machine"] == ("RELIABLE", "TRANSIENT_LOCAL")
    assert "held back: 1 commands and parameter events" in output
    assert re.search(r"^played 1\d{3} messages in \d+\.\d s, at most ", output, flags=re.MULTILINE)


def described(client: Client) -> dict[str, list[tuple[str, str]]]:
    """Return reliability and durability of the publishers on some topics."""
    return {
        topic: [
            (info.qos_profile.reliability.name, info.qos_profile.durability.name)
            for info in client.node.get_publishers_info_by_topic(topic)
        ]
        for topic in ("/drum/acceleration", "/machine")
    }


@pytest.mark.timeout(120)
def test_chosen_topics_in_a_namespace_at_a_rate_in_a_loop_until_ctrl_c(
    own_domain: int, client: Client, tmp_path: Path, trace: Path
) -> None:
    lasting = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    soils = client.listen("/replay/soil", DiagnosticStatus, lasting)
    blocks = client.listen("/replay/drum/acceleration", DrumAcceleration)
    chosen = ("--topics", "drum/acceleration", "/soil", "--namespace", "replay")
    arguments = (str(trace), *chosen, "--rate", "2", "--loop")
    with process(own_domain, tmp_path, *PLAY, *arguments) as player:
        client.spin_until(lambda: sum(block.sequence == 0 for block in blocks) >= 3 and soils)
        assert client.node.count_publishers("/replay/truth") == 0
        assert client.node.count_publishers("/drum/acceleration") == 0
        player.send_signal(signal.SIGINT)
        output, errors = player.communicate(timeout=PATIENCE_S)
    assert player.returncode == 0
    assert errors == ""
    assert re.search(r"^interrupted after \d+ messages", output, flags=re.MULTILINE)
    # From turn to turn nothing is left out: the first sample follows the last one.
    sequences = [block.sequence for block in blocks]
    turns = [after for before, after in pairwise(sequences) if after != before + 16]
    assert set(turns) == {0}


@pytest.mark.timeout(120)
def test_ros_arguments_remap_and_commands_are_played_when_named(
    start, own_domain: int, client: Client, tmp_path: Path
) -> None:
    bag = tmp_path / "commanded.mcap"
    sim = start("--record", str(bag))
    states = client.listen("exciter/state", ExciterState)
    client.command(amplitude=1.2e-3)
    client.spin_until(lambda: states and states[-1].commanded_amplitude == 1.2e-3)
    assert sim.end() == 0
    assert len(recorded(bag, "/exciter/command")) == 1
    heard = client.listen("/old/command", ExciterCommand)
    done = play(
        own_domain,
        tmp_path,
        *(str(bag), "--topics", "exciter/command", "--subscribers", "1"),
        *("--ros-args", "-r", "/exciter/command:=/old/command"),
    )
    assert done.returncode == 0, done.stderr
    client.spin_until(lambda: heard)
    assert heard[0].amplitude == 1.2e-3
