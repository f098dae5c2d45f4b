# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parameters over DDS: descriptors, refusals, live changes, read-only ones."""

from __future__ import annotations

import math

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from rcl_interfaces.msg import ParameterType
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile

from roller_sim_ros.msg import AppliedChange, DrumSoilState
from roller_sim_ros.parameters import PARAMETERS

LIVE = {name: item for name, item in PARAMETERS.items() if item[0].live}
STRUCTURAL = [name for name, item in PARAMETERS.items() if not item[0].changes]


def test_descriptors_are_those_of_the_declarations(visitor):
    for name, (quantity, default) in PARAMETERS.items():
        descriptor = visitor.describe_parameter(name)
        assert quantity.doc in descriptor.description
        assert quantity.unit in descriptor.description
        assert ("read-only" in descriptor.additional_constraints) != quantity.changes
        if isinstance(default, bool):
            assert descriptor.type == ParameterType.PARAMETER_BOOL
        elif isinstance(default, str):
            assert descriptor.type == ParameterType.PARAMETER_STRING
            for choice in quantity.choices:
                assert choice in descriptor.additional_constraints
        elif isinstance(default, int):
            assert descriptor.type == ParameterType.PARAMETER_INTEGER
            assert descriptor.integer_range[0].from_value == quantity.minimum
            assert descriptor.integer_range[0].to_value == quantity.maximum
        else:
            assert descriptor.type == ParameterType.PARAMETER_DOUBLE
            assert descriptor.floating_point_range[0].from_value == quantity.minimum
            assert descriptor.floating_point_range[0].to_value == quantity.maximum


def bad_values(name: str) -> list[object]:
    quantity, default = PARAMETERS[name]
    if isinstance(default, bool):
        return [1, "yes"]
    if isinstance(default, str):
        return [5] if quantity.of_node else [5, "rubbish"]
    below = quantity.minimum - max(1.0, abs(quantity.minimum))
    above = quantity.maximum * 2.0 + 1.0
    if isinstance(default, int):
        return [int(below), int(above), 1.5, "text"]
    return [below, above, math.nan, math.inf, "text", True]


@pytest.mark.parametrize("name", PARAMETERS)
def test_bad_value_is_refused_with_the_reason(visitor, name):
    applied = visitor.listen("applied", AppliedChange)
    before = visitor.get_parameter(name)
    quantity, default = PARAMETERS[name]
    for value in bad_values(name):
        result = visitor.set_parameter(name, value)
        assert not result.successful, value
        assert f"{name} = {value!r}" in result.reason
        finite_number = isinstance(value, int | float) and math.isfinite(value)
        if quantity.live and finite_number and type(value) is type(default):
            bound = quantity.minimum if value < quantity.minimum else quantity.maximum
            assert f"{bound:g} {quantity.unit}".strip() in result.reason
    assert visitor.get_parameter(name) == before
    assert applied == []


def test_recording_to_where_nothing_can_be_written_is_refused(visitor, tmp_path):
    path = str(tmp_path / "nowhere" / "trace.mcap")
    result = visitor.set_parameter("recording.path", path)
    assert not result.successful
    assert f"recording.path = {path!r}" in result.reason
    assert visitor.get_parameter("recording.path") == ""


@pytest.mark.parametrize("name", STRUCTURAL)
def test_structural_parameter_is_read_only_while_active(visitor, name):
    value = visitor.get_parameter(name)
    result = visitor.set_parameter(name, value)
    assert not result.successful
    assert name in result.reason
    assert "active" in result.reason


def test_parameter_cannot_be_deleted_or_invented(visitor):
    for name in ("soil.shear_modulus_pa", "soil.shear_modulus_mpa"):
        request = Parameter(name, Parameter.Type.NOT_SET)
        result = visitor.set_parameter_message(request.to_parameter_msg())
        assert not result.successful
    assert visitor.get_parameter("soil.shear_modulus_pa") > 0.0
    assert not visitor.set_parameter("soil.shear_modulus_mpa", 80.0).successful


def test_whole_number_is_taken_for_a_float(visitor):
    applied = visitor.listen("applied", AppliedChange)
    before = visitor.get_parameter("soil.shear_modulus_pa")
    result = visitor.set_parameter("soil.shear_modulus_pa", 60000000)
    assert result.successful, result.reason
    assert visitor.get_parameter("soil.shear_modulus_pa") == 60e6
    # Taken back within the same revolution, it would never apply.
    visitor.spin_until(lambda: applied and applied[-1].value == 60e6)
    assert visitor.set_parameter("soil.shear_modulus_pa", before).successful
    visitor.spin_until(lambda: applied[-1].value == before)


def other_value(name: str) -> object:
    quantity, default = LIVE[name]
    if isinstance(default, bool):
        return not default
    return float(min(quantity.maximum, 1.25 * default) if default else 0.25 * quantity.maximum)


@pytest.mark.parametrize("name", LIVE)
def test_live_change_is_applied_at_a_multiple_of_128(visitor, name):
    applied = visitor.listen("applied", AppliedChange)
    truth = visitor.listen("truth", DrumSoilState)
    lasting = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    facts = visitor.listen(
        "soil" if name.startswith("soil.") else "machine", DiagnosticStatus, lasting
    )
    visitor.spin_until(lambda: truth and facts)
    before, value = visitor.get_parameter(name), other_value(name)

    result = visitor.set_parameter(name, value)
    assert result.successful, result.reason
    change = visitor.spin_until(lambda: applied and applied[-1])
    assert change.name == name
    assert change.sample % 128 == 0
    if isinstance(value, bool):
        assert change.text == str(value).lower()
    else:
        assert change.value == value
    # The facts tell it to those who come later.
    told = visitor.spin_until(
        lambda: {item.key: item.value for item in facts[-1].values}.get(name) == _text(value)
    )
    assert told
    visitor.spin_until(lambda: truth[-1].sequence >= change.sample)
    field = {
        "soil.shear_modulus_pa": "shear_modulus",
        "soil.plastic_parameter_m": "plastic_parameter",
    }
    if name in field:
        for block in truth:
            expected = value if block.sequence >= change.sample else before
            assert getattr(block, field[name]) == expected

    assert visitor.set_parameter(name, before).successful
    visitor.spin_until(lambda: len(applied) == 2)


def _text(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
