# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Controllers in the loop without ROS: what they keep the roller from, and at what cost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from examples.controllers.force_limiter import ForceLimiter
from examples.controllers.jump_guard import JumpGuard
from examples.controllers.model_based import ModelBased
from examples.controllers.offline import alone, drive, jumping
from examples.controllers.phase_tracker import PhaseTracker
from roller_sim_ros.scenario import Scenario, SiteMap, read_scenario
from roller_sim_ros.scenario.shipped import scenario_path
from roller_sim_ros.site.features import Gradient


def soft_to_stiff(length_m: float = 60.0, **exciter: float) -> Scenario:
    """The package's scenario, its ground pushed together to a shorter lane."""
    scenario = read_scenario(scenario_path("soft_to_stiff"))
    (gradient,) = scenario.ground.features
    assert isinstance(gradient, Gradient)
    return replace(
        scenario,
        lane=replace(scenario.lane, length_m=length_m),
        ground=replace(scenario.ground, features=(replace(gradient, to_m=length_m),)),
        exciter=replace(scenario.exciter, **exciter),
    )


def jumps(site_map: SiteMap) -> float:
    return float(jumping(site_map.mode, site_map.rmv).mean())


def test_jump_guard_keeps_the_drum_from_jumping_at_a_high_amplitude() -> None:
    scenario = soft_to_stiff()
    assert jumps(alone(scenario)) > 0.30
    guarded = drive(scenario, JumpGuard())
    assert jumps(guarded) < 0.02
    # Nor in a way that has no name: no more than a trace of every second revolution, anywhere after the start.
    assert guarded.rmv[32:].max() < 3.0
    # The best constant amplitude is less than 1.1 mm, with which the drum jumps.
    constant = alone(soft_to_stiff(amplitude_mm=1.1))
    assert jumping(constant.mode, constant.rmv)[32:].any()
    assert guarded.amplitude_m.mean() >= 0.8 * 1.1e-3


def test_jump_guard_does_so_at_another_frequency() -> None:
    scenario = soft_to_stiff(frequency_hz=32.0)
    assert jumps(alone(scenario)) > 0.30
    guarded = drive(scenario, JumpGuard())
    assert jumps(guarded) < 0.02
    assert guarded.amplitude_m.mean() > 1.1e-3


def test_force_limiter_holds_the_force_at_its_limit() -> None:
    limited = drive(soft_to_stiff(20.0), ForceLimiter(limit=2.8))
    assert limited.force_ratio_max[32:].max() < 2.8 * 1.05
    assert limited.force_ratio_max[-1] == pytest.approx(2.8, rel=0.05)
    assert limited.amplitude_m[-1] < 0.8e-3


def test_phase_tracker_follows_the_resonance_with_the_frequency() -> None:
    tracked = drive(soft_to_stiff(20.0, amplitude_mm=0.8, frequency_hz=24.0), PhaseTracker())
    assert np.ptp(tracked.amplitude_m) == 0.0
    settled = tracked.frequency_hz[len(tracked) // 3 :]
    assert settled.min() < 23.5
    assert settled[-1] > settled.min() + 2.0


class Noted:
    """A law whose last measurement is kept."""

    def __init__(self, law: PhaseTracker) -> None:
        self.law = law
        self.lags: list[float] = []

    def update(self, measurement):
        self.lags.append(measurement.lag_rad)
        return self.law.update(measurement)


def test_phase_tracker_holds_the_lag_on_constant_ground() -> None:
    scenario = soft_to_stiff(12.0, amplitude_mm=0.8)
    scenario = replace(scenario, ground=replace(scenario.ground, features=()))
    noted = Noted(PhaseTracker(setpoint_deg=150.0))
    drive(scenario, noted)
    assert np.degrees(noted.lags[-1]) == pytest.approx(150.0, abs=1.0)


def test_model_based_controller_finds_the_ground_and_does_not_jump() -> None:
    law = ModelBased()
    driven = drive(soft_to_stiff(20.0), law)
    assert jumps(driven) < 0.02
    assert driven.rmv[32:].max() < 3.0
    # The last decision is at most 40 revolutions old: what it took the ground for, it has just left.
    ground = driven.shear_modulus_pa[-57:]
    assert 0.95 * ground.min() < law.known.soil.shear_modulus_pa < 1.05 * ground.max()
    assert driven.frequency_hz[-1] > driven.frequency_hz.min() + 4.0
    np.testing.assert_allclose(
        driven.speed_m_s[100:-1], driven.frequency_hz[100:-1] / 28.0, rtol=0.1
    )
    assert driven.chainage_m[-1] == pytest.approx(20.0, abs=0.1)
