# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The node's life over DDS: transitions, what each state answers, structural parameters in between."""

from __future__ import annotations

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rclpy.qos import DurabilityPolicy, QoSProfile

from roller_sim_ros.msg import DrumAcceleration, DrumSoilState, ExciterState
from tests.integration.harness import Client, entry


def stands_still(client: Client, diagnostics: list[DiagnosticArray]) -> None:
    """Wait until the roller has said twice that it is not active: what it published before is heard by then."""
    diagnostics.clear()
    client.spin_until(
        lambda: sum(entry([item], "pacing").message == "not active" for item in diagnostics) == 2
    )


def test_life_from_unconfigured_to_its_end(start, client):
    sim = start("--ros-args", "-p", "autostart:=false")
    assert client.state() == "unconfigured"
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    states = client.listen("exciter/state", ExciterState)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)

    # What was set before is what is configured.
    assert client.set_parameter("half_space.model", "two-pole").successful
    assert not client.set_parameter("half_space.model", "three-pole").successful
    assert not client.change_state("activate")
    assert client.change_state("configure")
    assert client.state() == "inactive"

    # Inactive: diagnostics, no samples; commands are refused.
    status = client.spin_until(lambda: entry(diagnostics, "pacing"))
    assert status.message == "not active"
    client.command(frequency=30.0, amplitude=1e-3)
    refused = client.spin_until(lambda: states and states[-1])
    assert refused.refusal_code == ExciterState.NOT_ACTIVE
    for word in ("30 Hz", "0.001 m", "not active"):
        assert word in refused.refusal_reason
    assert not refused.vibrating
    assert blocks == []

    client.spin_until(lambda: client.node.count_publishers("/drum/acceleration"))
    client.spin_for(0.5)  # known, it is heard a little later
    assert client.change_state("activate")
    assert client.state() == "active"
    client.spin_until(lambda: len(blocks) > 20)
    assert blocks[0].sequence == 0
    status = client.spin_until(
        lambda: (found := entry(diagnostics, "pacing")) and found.message != "not active" and found
    )
    assert status.level in (DiagnosticStatus.OK, DiagnosticStatus.WARN)
    result = client.set_parameter("half_space.model", "exact")
    assert not result.successful
    assert "deactivate" in result.reason

    assert client.change_state("deactivate")
    stands_still(client, diagnostics)
    count = len(blocks)
    stands_still(client, diagnostics)
    assert len(blocks) == count

    # Active again it starts anew.
    assert client.change_state("activate")
    client.spin_until(lambda: len(blocks) > count + 5)
    assert blocks[count].sequence == 0

    assert client.change_state("deactivate")
    assert client.change_state("cleanup")
    assert client.state() == "unconfigured"
    client.spin_until(lambda: client.node.count_publishers("/drum/acceleration") == 0)
    assert client.change_state("shutdown")
    assert client.state() == "finalized"
    assert sim.end() == 0
    assert "Traceback" not in "\n".join(sim.complaints)


def test_structural_change_takes_effect_when_activated_again(start, client):
    sim = start()
    blocks = client.listen("drum/acceleration", DrumAcceleration)
    truth = client.listen("truth", DrumSoilState)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    machine = client.listen(
        "machine",
        DiagnosticStatus,
        QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL),
    )
    client.spin_until(lambda: blocks and machine)
    assert {len(block.vertical) for block in blocks} == {16}

    assert client.change_state("deactivate")
    for name, value in {
        "pacing.samples_per_message": 64,
        "machine.frame_mass_kg": 4800.0,
        "half_space.model": "two-pole",
    }.items():
        result = client.set_parameter(name, value)
        assert result.successful, result.reason
    # Together they must make sense, too.
    result = client.set_parameter("pacing.samples_per_message", 48)
    assert not result.successful
    assert "divisor of 128" in result.reason
    result = client.set_parameter("meter.window_revolutions", 7)
    assert not result.successful
    assert "even" in result.reason
    result = client.set_parameter("sampling.samples_per_revolution", 256)
    assert not result.successful
    assert "128" in result.reason

    stands_still(client, diagnostics)
    blocks.clear()
    truth.clear()
    machine.clear()
    assert client.change_state("activate")
    client.spin_until(lambda: len(blocks) > 4 and truth and machine)
    assert {len(block.vertical) for block in blocks} == {64}
    facts = {item.key: item.value for item in machine[-1].values}
    assert facts["machine.frame_mass_kg"] == "4800.0"
    static_load = (4800.0 + 3200.0) * 9.81
    assert truth[0].soil_force[0] == pytest.approx(static_load, rel=1e-6)
    assert sim.end() == 0
