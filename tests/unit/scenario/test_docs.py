# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The example of the docs is a scenario."""

from __future__ import annotations

import re
from pathlib import Path

from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.scenario.shipped import shipped_scenarios

PAGE = Path(__file__).resolve().parents[3] / "docs" / "scenarios.md"


def test_the_example_can_be_run_and_every_scenario_is_named() -> None:
    page = PAGE.read_text(encoding="utf-8")
    (example,) = re.findall(r"```yaml\n(.*?)```", page, flags=re.DOTALL)
    scenario = parse_scenario(example, PAGE)
    assert start_of(scenario).site.position.chainage_m == 0.0
    assert len(scenario.exciter.programme) == 2
    named = re.findall(r"^\| `(\w+)` \|", page, flags=re.MULTILINE)
    assert sorted(named) == sorted(shipped_scenarios())
