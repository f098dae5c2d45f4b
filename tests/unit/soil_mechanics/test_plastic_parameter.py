# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plastic parameter against the bearing capacity of the strip that the drum rests on."""

from __future__ import annotations

import math

import pytest

from roller_sim_ros.parameters import Machine, ParameterError
from roller_sim_ros.soil_mechanics import (
    bearing_capacity,
    contact_half_width,
    line_load,
    n_gamma_vesic,
    plastic_parameter,
    scaled_plastic_parameter,
)

ANGLE, WEIGHT = math.radians(45.0), 20e3


def borne(machine: Machine, depth_m: float) -> float:
    """The load that the ground bears when the drum has sunk so deep: eqs (1) and (2)."""
    half_width = contact_half_width(depth_m, machine.drum_radius_m)
    stress = bearing_capacity(ANGLE, half_width, WEIGHT)
    return stress * 2.0 * half_width * machine.drum_width_m


@pytest.mark.parametrize(
    "machine",
    [Machine(), Machine(drum_radius_m=0.4, drum_width_m=1.2, drum_mass_kg=900, frame_mass_kg=300)],
)
def test_at_the_depth_p_the_ground_bears_the_static_load(machine: Machine) -> None:
    p = plastic_parameter(WEIGHT, n_gamma_vesic(ANGLE), line_load(machine), machine.drum_radius_m)
    assert borne(machine, p) == pytest.approx(machine.static_load_n, rel=1e-12)
    # Eq. (13) is linear because of it.
    for share in (0.1, 0.5, 2.0, 7.0):
        assert borne(machine, share * p) == pytest.approx(share * machine.static_load_n, rel=1e-12)


def test_value_by_hand() -> None:
    # 26160 N/m over 4 · 20 kN/m³ · 271.75 · 0.75 m
    assert line_load(Machine()) == pytest.approx(26160.0)
    assert plastic_parameter(WEIGHT, n_gamma_vesic(ANGLE), 26160.0, 0.75) == pytest.approx(
        1.6044e-3, rel=1e-4
    )


def test_parabola_is_the_circle_where_the_drum_touches() -> None:
    radius, depth = 0.75, 2e-3
    chord = math.sqrt(2.0 * radius * depth - depth**2)
    assert contact_half_width(depth, radius) == pytest.approx(chord, rel=depth / (3.9 * radius))
    assert contact_half_width(depth, radius) > chord


def test_two_degrees_take_a_third_of_p() -> None:
    for degrees in (40, 44, 48):
        loose = n_gamma_vesic(math.radians(degrees))
        dense = n_gamma_vesic(math.radians(degrees + 2))
        assert 0.25 < 1.0 - loose / dense < 0.45


def test_scaling_between_machines_is_that_of_the_strength() -> None:
    small = Machine(drum_radius_m=0.4, drum_width_m=1.2, drum_mass_kg=900, frame_mass_kg=300)
    factor = n_gamma_vesic(ANGLE)
    large_p, small_p = (
        plastic_parameter(WEIGHT, factor, line_load(item), item.drum_radius_m)
        for item in (Machine(), small)
    )
    assert large_p != pytest.approx(small_p, rel=0.02)
    assert scaled_plastic_parameter(large_p, Machine(), small) == pytest.approx(small_p)
    back = scaled_plastic_parameter(small_p, small, Machine())
    assert back == pytest.approx(large_p)
    assert scaled_plastic_parameter(5e-4, small, small) == 5e-4


def test_twice_the_radius_halves_p() -> None:
    wide = Machine(drum_radius_m=1.5)
    assert scaled_plastic_parameter(8e-4, Machine(), wide) == pytest.approx(4e-4)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ((0.0, 20.0, 26e3, 0.75), "unit_weight_n_m3"),
        ((2e4, 0.0, 26e3, 0.75), "n_gamma"),
        ((2e4, 20.0, math.nan, 0.75), "line_load_n_m"),
        ((2e4, 20.0, 26e3, -1.0), "drum_radius_m"),
    ],
)
def test_what_bears_nothing_is_refused(
    arguments: tuple[float, float, float, float], name: str
) -> None:
    with pytest.raises(ParameterError, match=f"{name} = .*must be positive"):
        plastic_parameter(*arguments)
