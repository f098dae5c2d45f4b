# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Scenario files: what the roller drives over, what its exciter does, how it is measured and what fails.

>>> from pathlib import Path
>>> scenario = parse_scenario("lane: {length_m: 20}", Path("short.yaml"))
>>> session = start_of(scenario).session()
>>> session.advance(128).shear_modulus_pa
50000000.0
"""

from roller_sim_ros.scenario.build import Start, configuration_of, has_own_section, start_of
from roller_sim_ros.scenario.journal import Journal, SiteMap
from roller_sim_ros.scenario.nodes import ScenarioError
from roller_sim_ros.scenario.reading import parse_scenario, read_scenario
from roller_sim_ros.scenario.scenario import FaultPart, Scenario, SensorPart
from roller_sim_ros.scenario.window import Window

__all__ = [
    "FaultPart",
    "Journal",
    "Scenario",
    "ScenarioError",
    "SensorPart",
    "SiteMap",
    "Start",
    "Window",
    "configuration_of",
    "has_own_section",
    "parse_scenario",
    "read_scenario",
    "start_of",
]
