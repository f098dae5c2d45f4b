# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parameters, each declared once with unit, bounds and doc; a new one is one field of one group."""

from roller_sim_ros.parameters.configuration import (
    PARAMETERS,
    Configuration,
    all_parameters,
    lookup,
)
from roller_sim_ros.parameters.exciter import Exciter
from roller_sim_ros.parameters.half_space import HalfSpace
from roller_sim_ros.parameters.machine import GRAVITY_M_S2, Machine
from roller_sim_ros.parameters.operation import (
    SAMPLES_PER_REVOLUTION,
    Meter,
    Pacing,
    Recording,
    Sampling,
    ScenarioFile,
    Travel,
)
from roller_sim_ros.parameters.quantity import ParameterError, ParameterGroup, Quantity, Value
from roller_sim_ros.parameters.soil import Soil, covarying_plastic_parameter

__all__ = [
    "GRAVITY_M_S2",
    "PARAMETERS",
    "SAMPLES_PER_REVOLUTION",
    "Configuration",
    "Exciter",
    "HalfSpace",
    "Machine",
    "Meter",
    "Pacing",
    "ParameterError",
    "ParameterGroup",
    "Quantity",
    "Recording",
    "Sampling",
    "ScenarioFile",
    "Soil",
    "Travel",
    "Value",
    "all_parameters",
    "covarying_plastic_parameter",
    "lookup",
]
