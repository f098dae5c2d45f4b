# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Hostile clients over DDS: whatever they send, the node goes on, and each refusal says why."""

from __future__ import annotations

from rcl_interfaces.msg import Parameter, ParameterValue

from fuzz.dds import hostile_client, target
from fuzz.run import run


def test_hostile_messages_and_requests() -> None:
    with hostile_client() as client:
        result = run(target(client), 500, 0, shrink=False)
        assert 0 < result.accepted < result.items
        # Found that way: rclpy's own service ends the process for a type that there is none of.
        odd = Parameter(name="soil.density_kg_m3", value=ParameterValue(type=200))
        (answer,) = client.call("roller_sim/set_parameters", parameters=[odd]).results
        assert not answer.successful
        assert "there is no type of parameters 200" in answer.reason
        answer = client.call("roller_sim/set_parameters_atomically", parameters=[odd]).result
        assert "'soil.density_kg_m3'" in answer.reason
        answer = client.call("save_state", path="x" * 5000)
        assert len(answer.result.error_message) < 300
