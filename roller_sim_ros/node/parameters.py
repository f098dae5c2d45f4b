# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The declared parameters as ROS parameters: names, types, descriptors, ranges."""

from __future__ import annotations

import math
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from roller_sim_ros.node.beginning import Beginning, beginning
from roller_sim_ros.parameters import PARAMETERS, ParameterError, Quantity, Value
from roller_sim_ros.parameters import lookup as lookup_parameter

AUTOSTART = "autostart"
"""Parameter of the node itself: whether it configures and activates itself."""

# What rclpy declares in every node.
_OF_EVERY_NODE = ("use_sim_time", "start_type_description_service")
_QOS = "qos_overrides."


def declare(node: Node) -> Beginning:
    """Declare all parameters and return what the runs begin with, from what was given for them.

    Parameters
    ----------
    node : rclpy.node.Node
        Made with ``automatically_declare_parameters_from_overrides``, so that what was given shows,
        also under names that nobody declares.

    Raises
    ------
    RollerSimError
        If a name is unknown, a value refused, or the scenario cannot be read.
    """
    given = {name: item.value for name, item in node.get_parameters_by_prefix("").items()}
    for name, value in given.items():
        if name != AUTOSTART and name not in _OF_EVERY_NODE and not name.startswith(_QOS):
            lookup_parameter(name, value)
    begins = beginning({name: value for name, value in given.items() if name in PARAMETERS})
    for name, value in begins.configuration.flat().items():
        _declare(node, name, value, _descriptor(*PARAMETERS[name]))
    autostart = given.get(AUTOSTART, True)
    if not isinstance(autostart, bool):
        raise ParameterError(AUTOSTART, autostart, "must be true or false")
    text = "whether the node configures and activates itself when it starts"
    _declare(node, AUTOSTART, autostart, ParameterDescriptor(description=text, read_only=True))
    return begins


def floats_for_integers(parameters: list[Parameter[Any]]) -> list[Parameter[Any]]:
    """Return the parameters with 80000000 as 80000000.0 where the declaration is a float."""

    def suited(item: Parameter[Any]) -> Parameter[Any]:
        _, default = PARAMETERS.get(item.name, (None, None))
        if isinstance(default, float) and item.type_ == Parameter.Type.INTEGER:
            return Parameter(item.name, Parameter.Type.DOUBLE, float(item.value))
        return item

    return [suited(item) for item in parameters]


def as_overrides(values: dict[str, Value]) -> list[Parameter[Any]]:
    """Return values as the overrides that a node takes on construction."""
    return [Parameter(name, value=value) for name, value in values.items()]


def _declare(node: Node, name: str, value: Any, descriptor: ParameterDescriptor) -> None:
    if node.has_parameter(name):
        node.undeclare_parameter(name)
    node.declare_parameter(name, value, descriptor, ignore_override=True)


def _descriptor(quantity: Quantity, default: Value) -> ParameterDescriptor:
    unit = f" [{quantity.unit}]" if quantity.unit else ""
    when = "may change at any time" if quantity.changes else "read-only while the roller is active"
    bounds = "" if isinstance(default, bool) else f"{quantity.bounds_text()}; "
    descriptor = ParameterDescriptor(
        description=f"{quantity.doc}{unit}", additional_constraints=f"{bounds}{when}"
    )
    if isinstance(default, bool | str) or (quantity.minimum is None and quantity.maximum is None):
        return descriptor
    low = -math.inf if quantity.minimum is None else quantity.minimum
    high = math.inf if quantity.maximum is None else quantity.maximum
    if isinstance(default, float):
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    elif math.isfinite(low) and math.isfinite(high):
        descriptor.integer_range = [IntegerRange(from_value=int(low), to_value=int(high), step=1)]
    return descriptor
