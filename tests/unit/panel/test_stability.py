# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

from __future__ import annotations

import numpy as np

from roller_sim_ros.panel import stability
from roller_sim_ros.panel.stability import compute, grid
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep import values_at

ON_THE_PAPERS_GROUND = Configuration().changed({"half_space.model": "two-pole"})


def test_the_map_is_what_a_sweep_finds() -> None:
    wanted = grid(ON_THE_PAPERS_GROUND, 28.0, 1.6e-3)
    found = compute(wanted, 0)
    assert (found["fine"], found["shear_modulus_pa"]) == (False, 50e6)
    columns, rows, revolutions = stability.LEVELS[0]
    assert np.shape(found["modes"]) == (rows, columns)
    for row, column in ((0, 0), (4, 4), (rows - 1, columns - 1)):
        point = ON_THE_PAPERS_GROUND.changed(
            {
                "exciter.frequency_hz": found["frequencies_hz"][column],
                "exciter.amplitude_m": found["amplitudes_m"][row],
            }
        )
        assert found["modes"][row][column] == values_at([point], revolutions)["mode"][0]


def test_it_holds_the_commanded_point() -> None:
    for frequency_hz, amplitude_m in ((28.0, 1.6e-3), (47.0, 2.7e-3), (80.0, 5e-3)):
        wanted = grid(Configuration(), frequency_hz, amplitude_m)
        assert frequency_hz <= wanted.highest_hz <= 80.0
        assert amplitude_m <= wanted.highest_m <= 5e-3


def test_it_is_computed_anew_where_the_ground_has_changed() -> None:
    def at(shear_modulus_pa: float, drum_mass_kg: float = 3200.0) -> stability.Grid:
        values = {"soil.shear_modulus_pa": shear_modulus_pa, "machine.drum_mass_kg": drum_mass_kg}
        return grid(Configuration().changed(values), 28.0, 1.6e-3)

    assert at(50e6).serves(at(54e6))
    assert not at(50e6).serves(at(56e6))
    assert not at(50e6).serves(at(50e6, 3300.0))
