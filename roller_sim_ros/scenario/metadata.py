# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a trace keeps of the scenario that was run."""

from __future__ import annotations

import hashlib

from roller_sim_ros.scenario.scenario import Scenario

SCENARIO = "roller_sim_ros.scenario"
"""Name of the record with the scenario's file: path, hash and all of its text, from which it can be run again."""


def scenario_metadata(scenario: Scenario) -> dict[str, dict[str, str]]:
    """Return the Metadata record of a scenario by its name."""
    return {
        SCENARIO: {
            "title": scenario.title,
            "path": scenario.path,
            "sha256": scenario_hash(scenario),
            "text": scenario.text,
        }
    }


def scenario_hash(scenario: Scenario) -> str:
    """Return the SHA-256 of the scenario's text."""
    return hashlib.sha256(scenario.text.encode("utf-8")).hexdigest()
