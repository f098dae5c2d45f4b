# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Every statement, in the order of the paper; a new one is one function and one entry in its subject's file."""

from __future__ import annotations

from roller_sim_ros.validation import cases, ground, half_spaces, meter_values, planes
from roller_sim_ros.validation.statement import Statement

STATEMENTS: tuple[Statement, ...] = (
    *ground.STATEMENTS,
    *half_spaces.STATEMENTS,
    *cases.STATEMENTS,
    *planes.STATEMENTS,
    *meter_values.STATEMENTS,
)
"""All of them."""
