# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What happens on a network: clients die, readers do not read, a node dies, there are two of one name."""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
import time
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from std_msgs.msg import Float64

from roller_sim_ros.msg import DrumAcceleration
from tests.integration.harness import Sim, recorded, roller_sim

if TYPE_CHECKING:
    # pytest wants to be the first to import it.
    from roller_sim_ros.testing import Roller

pytest_plugins = ["roller_sim_ros.testing"]

ROOT = Path(__file__).resolve().parents[2]
METER = (sys.executable, str(ROOT / "examples" / "meter_client.py"))


def is_whole(roller: Roller) -> bool:
    """Tell whether every sample came since the start."""
    blocks = roller.received("drum/acceleration")
    return blocks[0].sequence == 0 and all(
        after.sequence == before.sequence + len(before.vertical)
        for before, after in pairwise(blocks)
    )


def take(reader: Any) -> list[DrumAcceleration]:
    """Return what waits at a subscription."""
    taken = []
    with reader.handle:
        while (got := reader.handle.take_message(DrumAcceleration, True)) is not None:
            taken.append(deserialize_message(got[0], DrumAcceleration))
    return taken


def test_client_that_is_killed_and_started_again(roller: Roller) -> None:
    roller.listen("my_cmv", Float64)
    roller.step(seconds=3.0)
    for number in (1, 2):
        before = len(roller.received("my_cmv"))
        meter = roller.start(f"meter_{number}", *METER)
        # What comes before it is there it misses.
        while len(roller.received("my_cmv")) < before + 5:
            roller.step(revolutions=1)
        roller.kill(meter)
        # More than any queue holds, and nobody waits for who is gone.
        roller.step(revolutions=60)
    assert is_whole(roller)


def test_reader_that_does_not_read_holds_nobody_up(roller: Roller) -> None:
    context = Context()
    rclpy.init(context=context, domain_id=roller.domain)
    lazy = Node("lazy", context=context)
    try:
        readers = [
            lazy.create_subscription(
                DrumAcceleration,
                "drum/acceleration",
                print,
                QoSProfile(depth=depth, reliability=reliability),
                raw=True,
            )
            for depth, reliability in (
                (5, ReliabilityPolicy.BEST_EFFORT),
                (5, ReliabilityPolicy.RELIABLE),
            )
        ]
        # Each reader has to be there for the roller.
        for reader in readers:
            while not take(reader):
                roller.step(revolutions=1)
        end = roller.step(revolutions=150)
        assert is_whole(roller)
        for reader in readers:
            taken = take(reader)
            # What was dropped shows in the index of the samples.
            assert 0 < len(taken) <= 5
            assert taken[0].sequence > 0
            assert taken[-1].sequence < end
    finally:
        lazy.destroy_node()
        context.try_shutdown()


def test_reader_that_gets_no_processor_for_a_while_gets_every_sample(start, own_domain) -> None:
    script = """
        from soak.client import Client

        client = Client(int(input()), lambda: True)
        for _ in range(4):
            wanted = client.truth.next_sample + 3000
            client.spin_until(lambda: client.truth.next_sample > wanted, "samples")
            print("stop me", flush=True)
        client.spin_for(4.0)
        print(client.truth.lost, client.acceleration.lost, flush=True)
        client.close()
        """
    reader = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(script)],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert reader.stdin is not None
    assert reader.stdout is not None
    with reader:
        print(own_domain, file=reader.stdin, flush=True)
        start("--frequency-hz", "40", "--ros-args", "-p", "exciter.frequency_rate_hz_per_s:=100.0")
        for _ in range(4):
            assert reader.stdout.readline() == "stop me\n"
            reader.send_signal(signal.SIGSTOP)
            time.sleep(1.5)
            reader.send_signal(signal.SIGCONT)
        assert reader.stdout.readline() == "0 0\n"


def test_node_that_is_killed_while_it_records_and_started_again(start, client, tmp_path) -> None:
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    bag = str(tmp_path / "trace.mcap")
    sim = start("--record", bag)
    client.spin_until(lambda: len(blocks) > 100)
    sim.process.send_signal(signal.SIGKILL)
    sim.process.wait()
    heard = len(blocks)
    # Its trace is not overwritten.
    refused = start("--record", bag)
    assert refused.wait() == 1
    assert any("is not overwritten" in line for line in refused.complaints)
    sim = start("--record", str(tmp_path / "other.mcap"))
    client.spin_until(lambda: len(blocks) > heard + 100)
    # A client that was there before hears it, and sees by the index that it is another run.
    jumps = [
        after.sequence - before.sequence - len(before.vertical)
        for before, after in pairwise(blocks[heard - 1 :])
    ]
    assert any(jumps)
    assert sim.end() == 0
    # The recording's process finished the trace of the dead node by itself.
    assert "is whole" in roller_sim("recover", bag)
    for trace in (bag, tmp_path / "other.mcap"):
        assert recorded(Path(trace), "/drum/acceleration")[0].sequence == 0


def test_two_nodes_of_one_name_go_on_and_say_so(start, client) -> None:
    blocks = client.listen("drum/acceleration", DrumAcceleration)

    def warned(sim: Sim) -> bool:
        return any("another node is called /roller_sim, too" in it for it in sim.complaints)

    first, second = start("--shear-modulus-mpa", "35"), start("--shear-modulus-mpa", "80")
    client.spin_until(lambda: warned(first) and warned(second))
    heard = len(blocks)
    client.spin_until(lambda: len(blocks) > heard + 200)
    assert first.end() == 0
    heard = len(blocks)

    def alone() -> bool:
        # What the first one sent last may still be on its way.
        last = [block.sequence for block in blocks[-50:]]
        return all(after > before for before, after in pairwise(last))

    client.spin_until(lambda: len(blocks) > heard + 100 and alone())
    assert second.end() == 0
    for sim in (first, second):
        assert sum("another node" in line for line in sim.complaints) == 1
