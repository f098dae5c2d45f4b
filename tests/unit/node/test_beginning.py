# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a run begins with: parameters and scenario, which do not contradict each other."""

from __future__ import annotations

import pytest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.beginning import beginning

SCENARIO = """\
lane: {length_m: 5}
exciter: {amplitude_mm: 1.0}
ground: {shear_modulus_mpa: 40}
parameters: {meter.period_tolerance: 0.05}
seed: 3
"""


@pytest.fixture
def path(tmp_path) -> str:
    file = tmp_path / "short.yaml"
    file.write_text(SCENARIO, encoding="utf-8")
    return str(file)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"pacing.speed": 5.0}, ["pacing.speed = 5.0", "--clock sim"]),
        ({"pacing.clock": "sim", "pacing.speed": 0.05}, ["pacing.speed = 0.05", "0.1"]),
        ({"pacing.clock": "sun"}, ["pacing.clock", "real, sim"]),
        ({"scenario.path": "nowhere.yaml"}, ["nowhere.yaml"]),
        ({"scenario.path": "soft_to_stif"}, ["soft_to_stiff"]),
    ],
)
def test_what_cannot_be_is_refused_with_the_way_out(given, words):
    with pytest.raises(RollerSimError) as refused:
        beginning(given)
    for word in words:
        assert word in str(refused.value)


def test_what_the_scenario_says_is_not_said_again(path):
    with pytest.raises(RollerSimError, match="soil.shear_modulus_pa.* is said by the scenario"):
        beginning({"scenario.path": path, "soil.shear_modulus_pa": 60e6})
    # A parameter file at its defaults contradicts nothing.
    begins = beginning({"scenario.path": path, "soil.shear_modulus_pa": 50e6})
    assert begins.configuration.soil.shear_modulus_pa == 40e6
    assert begins.configuration.exciter.amplitude_m == 1e-3
    assert begins.configuration.meter.period_tolerance == 0.05


def test_every_run_begins_as_the_scenario_says_whatever_was_commanded(path):
    begins = beginning({"scenario.path": path, "recording.path": "x.mcap"})
    later = begins.configuration.changed(
        {"exciter.amplitude_m": 2e-3, "exciter.command_timeout_s": 1.0, "pacing.lock_step": True}
    )
    again = begins.with_parameters(later)
    assert again.configuration.exciter.amplitude_m == 1e-3
    assert again.configuration.exciter.command_timeout_s == 1.0
    assert again.configuration.pacing.lock_step
    assert again.configuration.recording.path == "x.mcap"
    first, second = begins.emulator(0), again.emulator(0)
    assert first.advance(128)[1].data == second.advance(128)[1].data
    assert begins.metadata(0)["roller_sim_ros"]["seed"] == "3"


def test_without_a_scenario_it_begins_as_it_was_left():
    begins = beginning({})
    later = begins.configuration.changed({"exciter.amplitude_m": 2e-3})
    assert begins.with_parameters(later).configuration.exciter.amplitude_m == 2e-3
    assert begins.metadata(0)["roller_sim_ros"]["seed"] == ""
