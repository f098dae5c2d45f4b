# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""128 samples per revolution are enough: periodic motion is that of 512."""

from __future__ import annotations

import pytest

from roller_sim_ros.parameters import HalfSpace
from tests.physics.rollers import random_points, settled

POINTS = 200
REVOLUTIONS = 600


@pytest.mark.parametrize("model", ["exact", "two-pole"])
def test_128_samples_give_the_periodic_motion_of_512(model: str) -> None:
    half_space = HalfSpace(model=model)
    periodic = same = 0
    off = []
    for point in random_points(POINTS, seed=20261124):
        fine = settled(point, half_space, per_revolution=512, revolutions=REVOLUTIONS).summary()
        if not fine.period:
            continue
        periodic += 1
        coarse = settled(point, half_space, revolutions=REVOLUTIONS).summary()
        if coarse.period != fine.period:
            continue
        same += 1
        if abs(coarse.force_ratio_max / fine.force_ratio_max - 1.0) > 0.01:
            off.append((point, "force", coarse.force_ratio_max, fine.force_ratio_max))
        if abs(coarse.cmv - fine.cmv) > max(0.5, 0.025 * fine.cmv):
            off.append((point, "cmv", coarse.cmv, fine.cmv))
    assert periodic > POINTS // 2
    assert same >= 0.98 * periodic
    assert off == []
