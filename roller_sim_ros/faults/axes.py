# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which of the accelerometer's axes a fault is on."""

from __future__ import annotations

from typing import Any

from roller_sim_ros.parameters.quantity import parameter

AXES = ("both", "vertical", "horizontal")


def axis_parameter() -> Any:
    """Declare the parameter."""
    return parameter("both", "", "axis that it is on", choices=AXES)


def on(axis: str, name: str) -> bool:
    """Return whether the axis of a name is meant."""
    return axis in ("both", name)
