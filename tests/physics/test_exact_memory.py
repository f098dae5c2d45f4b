# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The exact half space remembers as long as its waves run, however often the soil changes."""

from __future__ import annotations

import math

import numpy as np

from roller_sim_ros.drum_soil import ExactGround, loaded_strip
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.half_space.transient import memory
from roller_sim_ros.parameters import Exciter, HalfSpace, Machine, Soil


def test_the_memory_does_not_grow_with_the_changes_of_the_soil() -> None:
    draw = np.random.default_rng(1)
    machine, half_space, exciter = Machine(), HalfSpace(), Exciter()
    ground = ExactGround(machine, Soil(), half_space, exciter, 128)
    drive = ExciterDrive(exciter, 10.0, run_up=False)
    longest = 0.0
    for _ in range(200):
        soil = Soil(
            shear_modulus_pa=draw.uniform(20e6, 90e6),
            plastic_parameter_m=draw.uniform(4e-4, 1e-3),
        )
        strip = loaded_strip(machine, soil, half_space)
        longest = max(longest, memory(strip.aspect_ratio, 0.25) * strip.time_unit_s)
        revolution = drive.next_revolution()
        ground.begin(revolution, soil)
        ground.advance(0, 128)
        assert ground.memory_samples <= math.ceil(longest / revolution.sample_period_s) + 1
    assert ground.unsettled_steps == 0
