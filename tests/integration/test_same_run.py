# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One session, many drivers: a scenario gives the same bits offline, in lock step, in simulated and in real time."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from geometry_msgs.msg import Twist
from std_srvs.srv import Trigger

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.streams import StreamHashes
from roller_sim_ros.msg import ExciterState
from roller_sim_ros.offline.replay import replay
from roller_sim_ros.scenario import read_scenario, start_of
from roller_sim_ros.srv import (
    ClearFaults,
    InjectFault,
    ResetSimulation,
    RestoreState,
    SaveState,
    StepSimulation,
)

# Slow run-up and turning point, a sensor with noise, faults of sensor and exciter, ground that remembers.
TEXT = """\
lane: {length_m: 1.5, cell_m: 0.1}
travel: {speed_m_s: 1.5, passes: 2, turn_s: 0.2}
ground:
  preset: paper-soft
  features: [{kind: random_field, coefficient_of_variation: 0.3, correlation_length_m: 0.5}]
  compaction: {kind: exponential}
exciter: {programme: [{from_s: 0.8, frequency_hz: 30, amplitude_mm: 1.2}]}
sensors: [{name: mems_50g}, {name: tacho, parameters: {jitter_s: 1.0e-5}}, {name: odometry}, {name: gnss}]
faults: [{id: spike, from_s: 0.5, to_s: 1.5}, {id: stuck_amplitude, from_s: 1.6}]
seed: 11
"""


@pytest.fixture(scope="module")
def lane(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("lane") / "lane.yaml"
    path.write_text(TEXT, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def expected(lane) -> tuple[dict[str, str], int]:
    """Return the hashes of the run without ROS, in blocks of a whole revolution, and how many samples it has."""
    emulator = Emulator(start_ns=0, **start_of(read_scenario(lane))._asdict())
    hashes = StreamHashes()
    while not emulator.session.site.position.finished:
        hashes.feed(emulator.advance(128))
    digests = {f"/{topic}": digest for topic, digest in hashes.digests().items()}
    assert {"/drum/acceleration", "/truth", "/fix", "/odom", "/tacho", "/meter"} <= set(digests)
    return digests, emulator.session.next_sample


@pytest.mark.parametrize("clock", ["real", "sim"])
def test_a_run_by_itself_has_the_hashes_of_the_one_without_ros(
    clock, lane, expected, start, tmp_path
):
    bag = tmp_path / "trace.mcap"
    arguments = ("--clock", clock, "--exit-at-end", "--record", str(bag))
    sim = start("--scenario", str(lane), *arguments)
    assert sim.wait() == 0
    found = replay(bag, hashes=True)
    assert found.difference is None
    (run,) = found.runs
    assert run.lost == 0
    assert (run.hashes, run.samples) == expected


def test_lock_step_has_the_same_hashes_and_whatever_comes_in_can_be_replayed(
    lane, expected, start, client, tmp_path
):
    sim = start("--scenario", str(lane), "--lock-step", "--record", str(tmp_path / "trace.mcap"))
    samples = expected[1]
    # Steps that cut revolutions into blocks of all sizes, then the rest.
    for steps in (1, 7, 127, 300):
        client.ask(StepSimulation, "step_simulation", steps=steps)
    first = client.advance(revolutions=1).next_sample
    client.ask(StepSimulation, "step_simulation", steps=samples - first)

    # Once more, with everything that may come in.
    client.ask(ResetSimulation, "reset_simulation")
    states = client.listen("exciter/state", ExciterState)
    client.advance(seconds=0.21)
    travel = client.node.create_publisher(Twist, "cmd_vel", 10)
    client.spin_until(travel.get_subscription_count)
    twist = Twist()
    twist.linear.x = 0.7
    travel.publish(twist)
    client.command(frequency=31.0, amplitude=1.1e-3)
    client.command(frequency=math.nan, amplitude=1.1e-3)

    def refused() -> bool:
        client.advance(revolutions=1)
        return bool(states and states[-1].refusal_code)

    client.spin_until(refused)
    assert client.set_parameter("exciter.amplitude_rate_m_per_s", 1e-3).successful
    fault = client.ask(
        *(InjectFault, "inject_fault"),
        fault_id="bias_step",
        names=["bias_m_s2"],
        values=["3.5"],
        duration_s=0.1,
    )
    assert fault.success, fault.message
    assert client.ask(InjectFault, "inject_fault", fault_id="noise_burst").success
    client.ask(StepSimulation, "step_simulation", steps=333)
    assert client.ask(ClearFaults, "clear_faults").success
    state = client.ask(SaveState, "save_state").state
    assert client.ask(Trigger, "release").success
    client.advance(revolutions=20)

    # And from the saved state on, without the release.
    client.ask(RestoreState, "restore_state", state=state)
    client.advance(revolutions=20)
    assert sim.end() == 0

    runs = []
    for bag in sorted(tmp_path.glob("*.mcap"), key=lambda path: path.stat().st_mtime_ns):
        found = replay(bag, hashes=True)
        assert found.difference is None, (bag, found.difference)
        runs += found.runs
    assert [run.lost for run in runs] == [0, 0, 0]
    assert (runs[0].hashes, runs[0].samples) == expected
    assert {"applied", "faults"} <= set(runs[1].messages)
    assert runs[2].first_sample > 1000
    assert runs[2].samples == 20 * 128
