# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A scenario on the network: what it publishes, who is master, what breaks, what is told to the parameters."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import NavSatFix
from std_srvs.srv import Trigger

from roller_sim_ros.msg import AppliedChange, ExciterState, FaultStates, SiteState, TachoPulse
from roller_sim_ros.scenario.metadata import SCENARIO
from roller_sim_ros.srv import ClearFaults, InjectFault
from roller_sim_ros.traces.metadata import RUN
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import decode
from tests.integration.harness import Client, entry

LASTING = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def drive(client: Client, speed: float) -> None:
    """Command the travel, once the roller is there to hear it."""
    publisher = client.node.create_publisher(Twist, "cmd_vel", 10)
    client.spin_until(publisher.get_subscription_count)
    publisher.publish(Twist(linear=Vector3(x=speed)))
    # As a controller, it stays until it is heard.
    client.spin_for(0.2)
    client.state()
    client.node.destroy_publisher(publisher)


def test_scenario_in_real_time_is_all_on_the_network(start, client, scenario, tmp_path: Path):
    bag = tmp_path / "trace.mcap"
    site = client.listen("site/state", SiteState)
    tacho = client.listen("tacho", TachoPulse)
    odometry = client.listen("odom", Odometry)
    fix = client.listen("fix", NavSatFix)
    faults = client.listen("faults", FaultStates, LASTING)
    states = client.listen("exciter/state", ExciterState)
    sim = start("--scenario", str(scenario), "--record", str(bag))
    client.spin_until(lambda: site and tacho and odometry and fix)
    client.spin_until(lambda: faults)
    # The programme drives, and parameters and state say what it commands.
    client.spin_until(lambda: states[-1].commanded_amplitude == 1.0e-3)
    assert states[-1].master == ExciterState.MASTER_SCENARIO
    client.spin_until(lambda: client.get_parameter("exciter.amplitude_m") == 1.0e-3)
    assert client.get_parameter("scenario.path") == str(scenario)
    refused = client.set_parameter("soil.shear_modulus_pa", 70e6)
    assert not refused.successful
    assert "scenario" in refused.reason
    assert sim.end() == 0
    reader = TraceReader(bag)
    assert reader.metadata[SCENARIO]["text"] == scenario.read_text(encoding="utf-8")
    assert reader.metadata[RUN]["seed"] == "5"
    # It begins a second after the start, when a client may not have found the topic yet.
    told = [decode(item.data, item.type_name) for item in reader.messages({"/faults"})]
    assert [[fault.id for fault in item.faults] for item in told] == [[], ["bias_step"], []]
    assert " 1.000 mm " in sim.said.splitlines()[-3]


def test_live_commands_are_masters_until_they_are_released(stepper):
    site = stepper.listen("site/state", SiteState)
    states = stepper.listen("exciter/state", ExciterState)

    def after(revolutions: int) -> SiteState:
        last = stepper.advance(revolutions=revolutions).next_sample - 1
        return stepper.spin_until(lambda: site and site[-1].last_sample == last and site[-1])

    before = after(28)
    assert (before.exciter_master, before.travel_master) == (SiteState.MASTER_SCENARIO,) * 2
    assert before.speed == 1.0
    drive(stepper, -0.5)
    stepper.spin_until(lambda: after(1).travel_master == SiteState.MASTER_CMD_VEL)
    driven = after(28)
    assert driven.travel_master == SiteState.MASTER_CMD_VEL
    assert driven.exciter_master == SiteState.MASTER_SCENARIO
    assert driven.speed == -0.5
    assert driven.chainage < before.chainage
    stepper.command(frequency=28.0, amplitude=0.8e-3)
    # The parameters tell what waits for the next revolution.
    stepper.spin_until(lambda: stepper.get_parameter("exciter.amplitude_m") == 0.8e-3)
    assert after(2).exciter_master == SiteState.MASTER_COMMAND
    stepper.spin_until(lambda: states[-1].commanded_amplitude == 0.8e-3)
    assert stepper.ask(Trigger, "release").success
    released = after(2)
    assert (released.exciter_master, released.travel_master) == (SiteState.MASTER_SCENARIO,) * 2
    # By now the programme has another amplitude than at the start.
    stepper.spin_until(lambda: states[-1].commanded_amplitude == 1.0e-3)


@pytest.mark.parametrize("speed", [math.nan, math.inf, 5.5, -5.5])
def test_refused_travel_command_is_told(stepper, stepped_sim, speed):
    diagnostics = stepper.listen("/diagnostics", DiagnosticArray)
    before = len(stepped_sim[1].complaints)
    drive(stepper, speed)
    told = stepper.spin_until(
        lambda: (found := entry(diagnostics, "travel")) and f"{speed:g}" in found.message and found
    )
    assert told.level == b"\x01"
    assert "travel command refused" in stepped_sim[1].complaints[before]
    # Accepted again, it is forgotten.
    drive(stepper, 1.0)
    stepper.spin_until(lambda: entry(diagnostics, "travel").level == b"\x00")


def test_watchdogs_count_simulated_time_and_a_frozen_link_keeps_them_quiet(stepper):
    applied = stepper.listen("applied", AppliedChange)
    states = stepper.listen("exciter/state", ExciterState)
    for name in ("exciter.command_timeout_s", "travel.command_timeout_s"):
        assert stepper.set_parameter(name, 0.5).successful
    drive(stepper, 0.5)
    stepper.advance(seconds=0.4)
    stepper.spin_until(lambda: any(item.name == "travel.speed_m_s" for item in applied))

    # A frozen link goes on saying what was said last; what is said meanwhile is lost.
    injected = stepper.ask(
        InjectFault, "inject_fault", fault_id="frozen_command_link", duration_s=1.0
    )
    assert injected.success, injected.message
    stepper.advance(seconds=0.1)
    stepper.command(frequency=20.0, amplitude=1e-3)
    stepper.spin_for(0.2)
    stepper.advance(seconds=0.9)
    stepper.spin_until(lambda: states)
    assert {state.refusal_code for state in states} == {ExciterState.NONE}
    assert {state.commanded_frequency for state in states} == {28.0}

    # The watchdogs count from its end.
    response = stepper.advance(seconds=0.7)
    stepper.spin_until(lambda: states[-1].refusal_code == ExciterState.TIMEOUT)
    assert not states[-1].vibrating
    travel = "travel.speed_m_s"
    (stopped,) = stepper.spin_until(
        lambda: [item for item in applied if item.name == travel and item.value == 0.0]
    )
    at_s = stopped.header.stamp.sec + 1e-9 * stopped.header.stamp.nanosec
    end_s = response.stamp.sec + 1e-9 * response.stamp.nanosec
    assert end_s - 0.25 < at_s < end_s


def test_faults_are_injected_and_cleared(stepper):
    faults = stepper.listen("faults", FaultStates, LASTING)

    stepper.advance(revolutions=1)
    injected = stepper.ask(
        InjectFault,
        "inject_fault",
        fault_id="gain_change",
        names=["factor"],
        values=["0.5"],
        duration_s=0.1,
    )
    assert injected.success, injected.message
    stepper.advance(revolutions=1)
    (state,) = stepper.spin_until(lambda: faults and faults[-1].faults)
    assert state.handle == injected.handle
    assert state.live
    assert dict(zip(state.parameter_names, state.parameter_values, strict=True))["factor"] == "0.5"
    stepper.advance(revolutions=4)
    stepper.spin_until(lambda: not faults[-1].faults)

    spike = stepper.ask(InjectFault, "inject_fault", fault_id="spike")
    assert spike.success
    stuck = stepper.ask(InjectFault, "inject_fault", fault_id="lost_pulse")
    assert stuck.success
    stepper.advance(revolutions=1)
    stepper.spin_until(lambda: len(faults[-1].faults) == 2)
    assert stepper.ask(ClearFaults, "clear_faults", handle=spike.handle).success
    stepper.advance(revolutions=1)
    stepper.spin_until(lambda: [item.id for item in faults[-1].faults] == ["lost_pulse"])
    assert stepper.ask(ClearFaults, "clear_faults").success
    stepper.advance(revolutions=1)
    stepper.spin_until(lambda: not faults[-1].faults)
    refused = stepper.ask(ClearFaults, "clear_faults", handle=spike.handle)
    assert not refused.success
    assert str(spike.handle) in refused.message


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"fault_id": "stuk"}, ["stuk", "stuck"]),
        ({"fault_id": ""}, ["there is no fault"]),
        ({"fault_id": "gain_change", "names": ["factor"]}, ["1 names and 0 values"]),
        (
            {"fault_id": "gain_change", "names": ["factor"] * 2, "values": ["1", "2"]},
            ["given twice"],
        ),
        ({"fault_id": "gain_change", "names": ["faktor"], "values": ["1"]}, ["faktor", "factor"]),
        ({"fault_id": "gain_change", "names": ["factor"], "values": ["x"]}, ["'x'", "a number"]),
        ({"fault_id": "gain_change", "names": ["factor"], "values": ["nan"]}, ["factor", "finite"]),
        ({"fault_id": "gain_change", "duration_s": -1.0}, ["duration_s", "-1", "positive"]),
        ({"fault_id": "gain_change", "duration_s": math.nan}, ["duration_s", "nan"]),
    ],
)
def test_refused_fault_says_why(stepper, fields, words):
    response = stepper.ask(InjectFault, "inject_fault", **fields)
    assert not response.success
    assert response.handle == 0
    for word in words:
        assert word in response.message
