# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the exciter does when, and when a window holds."""

from __future__ import annotations

from pathlib import Path

import pytest

from roller_sim_ros.scenario import Window, parse_scenario, start_of
from roller_sim_ros.session import ExciterCommand, Moment
from roller_sim_ros.site import Position


def moment(
    time_s: float = 0.0,
    chainage_m: float = 0.0,
    pass_number: int = 1,
    revolution: int = 0,
    finished: bool = False,
) -> Moment:
    return Moment(time_s, revolution, Position(chainage_m, pass_number, 1.0, finished))


@pytest.mark.parametrize(
    ("window", "holding", "not_holding"),
    [
        (Window(), [moment(), moment(99.0, 9.0, 9, 9)], []),
        (
            Window(from_s=1.0, to_s=2.0),
            [moment(1.0), moment(1.99)],
            [moment(0.99), moment(2.0)],
        ),
        (
            Window(from_m=1.0, to_m=2.0),
            [moment(chainage_m=1.0), moment(chainage_m=1.99, pass_number=2)],
            [moment(chainage_m=0.99), moment(chainage_m=2.0)],
        ),
        (
            Window(from_pass=2, to_pass=3),
            [moment(pass_number=2), moment(pass_number=3)],
            [moment(), moment(pass_number=4)],
        ),
        (
            Window(from_revolution=5, to_revolution=5),
            [moment(revolution=5)],
            [moment(revolution=4), moment(revolution=6)],
        ),
        (
            Window(from_s=1.0, from_pass=2),
            [moment(1.0, pass_number=2)],
            [moment(1.0), moment(0.5, pass_number=2)],
        ),
    ],
)
def test_a_window_holds_while_all_that_is_given_does(
    window: Window, holding: list[Moment], not_holding: list[Moment]
) -> None:
    assert all(window.holds(it) for it in holding)
    assert not any(window.holds(it) for it in not_holding)


def test_of_several_steps_the_last_counts_key_by_key() -> None:
    start = start_of(
        parse_scenario(
            """
lane: {length_m: 20}
exciter:
  frequency_hz: 30
  amplitude_mm: 1.6
  programme:
    - {from_s: 2, amplitude_mm: 0.8}
    - {from_pass: 2, frequency_hz: 35}
    - {from_m: 10, to_m: 12, vibrate: false}
    - {from_m: 11, to_m: 12, amplitude_mm: 1.2, vibrate: true}
""",
            Path("p.yaml"),
        )
    )
    command = start.programme.command
    assert command(moment()) == ExciterCommand(True, 30.0, 1.6e-3)
    assert command(moment(2.0)) == ExciterCommand(True, 30.0, 0.8e-3)
    assert command(moment(2.0, pass_number=2)) == ExciterCommand(True, 35.0, 0.8e-3)
    assert command(moment(1.0, 10.5)) == ExciterCommand(False, 30.0, 1.6e-3)
    assert command(moment(9.0, 11.5, 3)) == ExciterCommand(True, 35.0, 1.2e-3)
    assert command(moment(finished=True)) == ExciterCommand(False, 30.0, 1.6e-3)


def test_the_exciter_is_from_the_start_what_the_programme_has_there() -> None:
    text = (
        "lane: {length_m: 20}\ntravel: {direction: backward}\n"
        "exciter: {programme: [{from_m: 15, amplitude_mm: 0.5}]}"
    )
    start = start_of(parse_scenario(text, Path("p.yaml")))
    assert start.configuration.exciter.amplitude_m == 0.5e-3
    session = start.session()
    session.advance(128)
    assert session.applied() == []
    assert session.exciter_status().amplitude_m == 0.5e-3
