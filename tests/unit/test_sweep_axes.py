# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Axes, grids and plans of a sweep, and the texts that give them."""

from __future__ import annotations

import numpy as np
import pytest

from roller_sim_ros.commands.axis_flags import axis_of_flag, parse_values
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.sweep import Axis, AxisError, Continuation, Grid, Plan

FREQUENCY = "exciter.frequency_hz"
AMPLITUDE = "exciter.amplitude_m"


def test_a_range_has_both_ends_and_numbers_that_can_be_typed() -> None:
    values = parse_values(AMPLITUDE, "0.1:2.5:101")
    assert len(values) == 101
    assert (values[0], values[2], values[-1]) == (0.1e-3, 0.148 / 1000, 2.5e-3)


@pytest.mark.parametrize(
    ("name", "text", "values"),
    [
        (FREQUENCY, "28,30", (28.0, 30.0)),
        (FREQUENCY, "28", (28.0,)),
        (FREQUENCY, "40:15:3", (40.0, 27.5, 15.0)),
        ("soil.shear_modulus_pa", "35,80", (35e6, 80e6)),
        ("exciter.tilt_rad", "-90,90", (-np.pi / 2, np.pi / 2)),
    ],
)
def test_numbers_lists_and_ranges(name: str, text: str, values: tuple[float, ...]) -> None:
    assert parse_values(name, text) == pytest.approx(values, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("15:40", "a range is first:last:count"),
        ("15:40:101:2", "a range is first:last:count"),
        ("15:40:0", "no points"),
        ("15:40:-3", "no points"),
        ("15:40:1", "1 values do not fit between the two ends"),
        ("15:15:4", "4 values do not fit"),
        ("15:40:ten", "'ten' is no whole number"),
        ("15:40:2.5", "'2.5' is no whole number"),
        ("15:40:99999999", "at most"),
        ("28kHz", "'28kHz' is no number of Hz"),
        ("28,,30", "'' is no number of Hz"),
        ("", "'' is no number of Hz"),
    ],
)
def test_malformed_axes_are_refused(text: str, says: str) -> None:
    with pytest.raises(AxisError, match=says) as error:
        parse_values(FREQUENCY, text)
    assert str(error.value).startswith(f"--frequency-hz {text}: ")
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("text", ["28000", "15:4000:11", "28,nan", "-1,28"])
def test_values_in_another_unit_are_out_of_bounds(text: str) -> None:
    with pytest.raises(ParameterError, match=r"--frequency-hz = .*: must be 0 … 80 Hz"):
        parse_values(FREQUENCY, text)


def test_an_axis_is_sorted_and_has_nothing_twice() -> None:
    assert Axis(FREQUENCY, (30.0, 28.0)).values == (28.0, 30.0)
    assert Axis.of(FREQUENCY, np.array([20, 21])).values == (20.0, 21.0)
    with pytest.raises(AxisError, match="28.0 twice"):
        Axis(FREQUENCY, (28.0, 30.0, 28.0))
    with pytest.raises(AxisError, match="no points"):
        Axis(FREQUENCY, ())
    with pytest.raises(ParameterError, match="must be at most 80 Hz"):
        Axis(FREQUENCY, (28.0, 81.0))


@pytest.mark.parametrize(
    "name", ["half_space.model", "sampling.samples_per_revolution", "meter.noise_floor_m_s2"]
)
def test_only_numbers_of_roller_and_ground_are_axes(name: str) -> None:
    with pytest.raises(AxisError, match=f"{name} cannot be an axis"):
        Axis(name, (1.0,))


def test_unknown_axes_are_named() -> None:
    with pytest.raises(ParameterError, match=r"did you mean exciter.frequency_hz\?"):
        Axis("exciter.frequency", (1.0,))
    with pytest.raises(AxisError, match="--along frequency: there is no such axis"):
        axis_of_flag("frequency")
    assert axis_of_flag("amplitude-mm") == axis_of_flag("--amplitude-mm") == AMPLITUDE


def test_dimensions_of_all_axes_have_names_of_their_own() -> None:
    from roller_sim_ros.sweep.axis import axis_names

    dimensions = [name.partition(".")[2] for name in axis_names()]
    assert len(set(dimensions)) == len(dimensions)
    assert {"machine.drum_mass_kg", "half_space.area_factor", "half_space.quality_factor"} < set(
        axis_names()
    )


def test_every_point_has_its_parameters() -> None:
    base = Configuration().changed({"soil.poisson_ratio": 0.3})
    grid = Grid((Axis(FREQUENCY, (20.0, 30.0)), Axis(AMPLITUDE, (1e-3, 2e-3, 3e-3))), base)
    assert (grid.shape, grid.size) == ((2, 3), 6)
    expected = base.changed({FREQUENCY: 30.0, AMPLITUDE: 2e-3})
    assert grid.configuration(4) == expected
    assert base.exciter.frequency_hz == 28.0
    assert FREQUENCY not in grid.parameters
    assert grid.parameters["soil.poisson_ratio"] == 0.3


def test_grids_without_points_or_with_too_many_are_refused() -> None:
    with pytest.raises(AxisError, match="no axis"):
        Grid(())
    with pytest.raises(AxisError, match="two axes of one parameter"):
        Grid((Axis(FREQUENCY, (20.0,)), Axis(FREQUENCY, (21.0,))))
    many = tuple(np.linspace(20.0, 30.0, 4000))
    with pytest.raises(AxisError, match="16000000 points; at most"):
        Grid((Axis(FREQUENCY, many), Axis("soil.poisson_ratio", tuple(np.linspace(0, 0.4, 4000)))))


def points(plan: Plan) -> list[list[int]]:
    return [[int(point) for point in line] for line in plan.points(np.arange(plan.lines))]


def test_lines_follow_the_axis_that_is_continued_along() -> None:
    grid = Grid((Axis(FREQUENCY, (20.0, 30.0)), Axis(AMPLITUDE, (1e-3, 2e-3, 3e-3))))
    assert points(Plan(grid)) == [[n] for n in range(6)]
    up = Plan(grid, continuation=Continuation(FREQUENCY, "up"))
    assert points(up) == [[0, 3], [1, 4], [2, 5]]
    down = Plan(grid, continuation=Continuation(AMPLITUDE, "down"))
    assert points(down) == [[2, 1, 0], [5, 4, 3]]


def test_plans_that_cannot_be_are_refused() -> None:
    grid = Grid((Axis("machine.drum_mass_kg", (3000.0, 3200.0)), Axis(FREQUENCY, (20.0,))))
    with pytest.raises(
        AxisError, match="cannot change while the roller runs; exciter.frequency_hz can"
    ):
        Plan(grid, continuation=Continuation("machine.drum_mass_kg"))
    with pytest.raises(AxisError, match="no axis of this grid"):
        Plan(grid, continuation=Continuation(AMPLITUDE))
    with pytest.raises(AxisError, match="must be up or down"):
        Continuation(FREQUENCY, "left")
    with pytest.raises(AxisError, match="1 revolutions: must be at least 2"):
        Plan(grid, revolutions=1)


def test_a_plan_survives_being_written_and_says_what_is_different() -> None:
    grid = Grid((Axis(FREQUENCY, (20.0, 30.0)),))
    plan = Plan(grid, 100, Continuation(FREQUENCY, "down"), early_stop=False)
    assert Plan.of_object(plan.as_object()) == plan
    assert plan.difference(plan) == ""
    assert "revolutions: 500, asked for 100" in plan.difference(
        Plan(grid, 500, plan.continuation, early_stop=False)
    )
    other = Grid(grid.axes, Configuration().changed({"soil.poisson_ratio": 0.3}))
    assert plan.difference(Plan(other, 100)) == (
        "parameter soil.poisson_ratio: 0.3, asked for 0.25"
    )
