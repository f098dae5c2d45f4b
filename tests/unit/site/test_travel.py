# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where the roller is: as planned, as driven, and handed back."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.site import Plan, UniformSite
from roller_sim_ros.site.site import Position
from roller_sim_ros.site.travel import Travel

LENGTH_M = 10.0


def travel(duration_s: float | None = None, **values: object) -> Travel:
    return Travel(Plan(**values), LENGTH_M, duration_s)  # type: ignore[arg-type]


def test_the_first_pass_begins_where_it_is_told() -> None:
    assert travel(speed_m_s=1.5).position == Position(0.0, 1, 1.5)
    assert travel(direction="backward").position == Position(LENGTH_M, 1, -1.0)
    assert travel(start_m=4.0).position.chainage_m == 4.0


def test_it_turns_at_the_lane_s_end_within_a_step() -> None:
    roller = travel(speed_m_s=2.0, passes=3)
    roller.move(4.9)
    assert roller.position.chainage_m == pytest.approx(9.8)
    legs = roller.move(0.3)
    # 0.2 m to the end, 0.4 m back.
    assert roller.position == Position(pytest.approx(9.6), 2, -2.0)
    assert [leg.ends_pass for leg in legs] == [True, False]
    assert sum(leg.duration_s for leg in legs) == pytest.approx(0.3)
    assert legs[0].to_m == legs[1].from_m == LENGTH_M


def test_it_stands_at_the_turning_point() -> None:
    roller = travel(passes=2, turn_s=2.0)
    roller.move(11.0)
    assert roller.position == Position(LENGTH_M, 2, 0.0)
    roller.move(1.5)
    assert roller.position == Position(pytest.approx(LENGTH_M - 0.5), 2, -1.0)


def test_it_is_finished_at_the_end_of_the_last_pass_and_stays_there() -> None:
    roller = travel(passes=2)
    roller.move(19.9)
    assert not roller.position.finished
    roller.move(0.2)
    assert roller.position == Position(0.0, 2, 0.0, finished=True)
    roller.move(5.0)
    assert roller.position == Position(0.0, 2, 0.0, finished=True)


def test_a_duration_ends_it_wherever_it_is() -> None:
    roller = travel(duration_s=3.0)
    roller.move(2.0)
    legs = roller.move(2.0)
    assert roller.position == Position(3.0, 1, 0.0, finished=True)
    assert sum(leg.duration_s for leg in legs) == 2.0


def test_it_may_stand_all_the_time() -> None:
    roller = travel(speed_m_s=0.0, duration_s=5.0)
    assert [leg.to_m for leg in roller.move(4.0)] == [0.0]
    assert not roller.position.finished


def test_driven_it_goes_at_the_speed_it_is_told_and_stops_at_the_end() -> None:
    roller = travel()
    roller.drive(3.0)
    roller.move(2.0)
    assert roller.position == Position(6.0, 1, 3.0)
    roller.move(5.0)
    assert roller.position == Position(LENGTH_M, 1, 0.0)
    roller.drive(-1.0)
    roller.move(1.0)
    assert roller.position == Position(9.0, 2, -1.0)
    roller.drive(0.0)
    roller.move(9.0)
    assert roller.position == Position(9.0, 2, 0.0)


def test_handed_back_it_goes_on_with_the_pass_it_is_in() -> None:
    roller = travel(passes=3)
    roller.move(2.0)
    roller.drive(-0.5)
    roller.move(1.0)
    roller.drive(None)
    assert roller.position == Position(1.5, 2, -1.0)
    roller.move(1.5 + 10.0)
    assert roller.position == Position(LENGTH_M, 3, 0.0, finished=True)


def test_driven_beyond_the_plan_it_is_finished_when_handed_back() -> None:
    roller = travel()
    for speed in (1.0, -1.0):
        roller.drive(speed)
        roller.move(3.0)
    assert not roller.position.finished
    roller.drive(None)
    assert roller.position.finished


def test_time_runs_also_while_somebody_drives() -> None:
    roller = travel(duration_s=5.0)
    roller.drive(0.5)
    roller.move(6.0)
    assert roller.position == Position(3.0, 1, 0.5)
    roller.drive(None)
    assert roller.position.finished


STEPS = st.lists(st.floats(0.001, 3.0), min_size=1, max_size=30)


@settings(max_examples=60, deadline=None)
@given(
    steps=STEPS,
    speed=st.floats(0.1, 5.0),
    passes=st.integers(1, 6),
    turn=st.sampled_from([0.0, 0.7]),
    direction=st.sampled_from(["forward", "backward"]),
)
def test_the_position_does_not_depend_on_the_steps(
    steps: list[float], speed: float, passes: int, turn: float, direction: str
) -> None:
    plan = {"speed_m_s": speed, "passes": passes, "turn_s": turn, "direction": direction}
    many, one = travel(**plan), travel(**plan)
    for step in steps:
        legs = many.move(step)
        assert sum(leg.duration_s for leg in legs) == pytest.approx(step)
    one.move(sum(steps))
    assert many.position.chainage_m == pytest.approx(one.position.chainage_m, abs=1e-6)
    # Closed form: whole passes, each with the standing after it.
    whole, rest = divmod(sum(steps), LENGTH_M / speed + turn)
    along = min(rest * speed, LENGTH_M) if whole < passes else LENGTH_M
    number = min(int(whole), passes - 1)
    if whole >= passes:
        along = LENGTH_M
    forward = (direction == "forward") == (number % 2 == 0)
    expected = along if forward else LENGTH_M - along
    assert many.position.chainage_m == pytest.approx(expected, abs=1e-6)


@settings(max_examples=60, deadline=None)
@given(
    before=STEPS,
    after=STEPS,
    driven=st.sampled_from([None, 0.0, 1.0, -2.0]),
    turn=st.sampled_from([0.0, 0.7]),
)
def test_restored_it_goes_on_to_the_last_bit(
    before: list[float], after: list[float], driven: float | None, turn: float
) -> None:
    roller, other = (travel(passes=4, turn_s=turn, duration_s=60.0) for _ in range(2))
    for step in before:
        roller.move(step)
    roller.drive(driven)
    other.restore(roller.state())
    for step in after:
        assert roller.move(step) == other.move(step)
        assert roller.position == other.position


def test_uniform_ground_can_be_driven_over() -> None:
    site = UniformSite()
    site.move(1.0, 1.0)
    assert site.position == Position(0.0, 1, 0.0)
    site.drive(1.5)
    site.move(2.0, 1.0)
    site.drive(-1.0)
    site.move(1.0, 1.0)
    assert site.position == Position(2.0, 2, -1.0)
    site.drive(None)
    assert site.position == Position(2.0, 2, 0.0)
    assert list(site.decides) == []
