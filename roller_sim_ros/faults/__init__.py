# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Faults: what breaks in sensors, messages, links and exciter; a new one is one file, one line in the catalogue."""

from roller_sim_ros.faults.catalogue import FAULTS, conflict, make_fault
from roller_sim_ros.faults.delivery import Delivery
from roller_sim_ros.faults.engine import ActiveFault, FaultEngine
from roller_sim_ros.faults.fault import (
    Behaviour,
    Expectation,
    Fault,
    FaultRefused,
    Installed,
    Stage,
)
from roller_sim_ros.faults.schedule import Scheduled, Span, When

__all__ = [
    "FAULTS",
    "ActiveFault",
    "Behaviour",
    "Delivery",
    "Expectation",
    "Fault",
    "FaultEngine",
    "FaultRefused",
    "Installed",
    "Scheduled",
    "Span",
    "Stage",
    "When",
    "conflict",
    "make_fault",
]
