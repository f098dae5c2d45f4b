# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The two-pole roller against the same phases written plainly for scipy's `solve_ivp`, sample by sample."""

from __future__ import annotations

import numpy as np
import pytest

from benchmarks.plain_model import PlainRoller
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.meters import summarise
from roller_sim_ros.parameters import HalfSpace
from tests.physics.rollers import MACHINE, Point, settled

REVOLUTIONS = 100
KEPT = 16


@pytest.mark.parametrize(
    ("point", "period"),
    [
        (Point(28.0, 1.6e-3, 35e6, 0.8e-3), 1),
        (Point(28.0, 1.6e-3, 80e6, 0.5e-3), 2),
        (Point(28.0, 0.8e-3, 80e6, 0.5e-3), 1),
    ],
    ids=["partial-uplift", "double-jump", "partial-uplift-stiff"],
)
def test_motion_is_that_of_the_plain_equations(point: Point, period: int) -> None:
    run = settled(point, HalfSpace(model="two-pole"), revolutions=REVOLUTIONS, kept=KEPT)
    plain = PlainRoller(
        point.shear_modulus_pa, point.plastic_parameter_m, point.frequency_hz, point.amplitude_m
    )
    plain.run(REVOLUTIONS - KEPT, method="DOP853", rtol=1e-10)
    samples = plain.run(KEPT, method="DOP853", rtol=1e-10)

    found = run.summary()
    expected = summarise(
        samples.acceleration, samples.force, samples.phase, MACHINE.static_load_n, 128
    )
    assert found.period == expected.period == period
    for name in ("force_ratio_max", "cmv", "acceleration_max_g", "acceleration_min_g"):
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-5), name
    assert found.rmv == pytest.approx(expected.rmv, rel=1e-5, abs=1e-3)
    # Both start in static equilibrium and settle on the same orbit, so also their samples agree.
    assert np.array_equal(run.samples[at.OUT_PHASE], samples.phase)
    difference = np.abs(run.samples[at.OUT_FORCE] - samples.force)
    assert difference.max() < 1e-6 * samples.force.max()
