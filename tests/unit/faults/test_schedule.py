# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""When faults are active: by time, chainage and revolution, together or not."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.faults import FaultEngine, Installed, Scheduled, Span
from roller_sim_ros.faults.schedule import surely_overlap
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.scenario.window import Window
from roller_sim_ros.sensors import Slot
from roller_sim_ros.session import Moment
from roller_sim_ros.site import Position

INSTALLED = Installed(frozenset({Slot.ACCELERATION}))


def drive() -> ExciterDrive:
    return ExciterDrive(Configuration().exciter, 10.0, run_up=False)


def moment(revolution: int, speed_m_s: float = 0.5) -> Moment:
    time_s = revolution / 28.0
    return Moment(time_s, revolution, Position(time_s * speed_m_s))


def active(engine: FaultEngine, revolutions: int) -> dict[int, set[str]]:
    found = {}
    for revolution in range(revolutions):
        engine.begin_revolution(moment(revolution), drive())
        found[revolution] = {item.fault.group for item in engine.active}
    return found


@pytest.mark.parametrize(
    ("window", "revolutions"),
    [
        (Window(from_s=1.0, to_s=2.0), range(28, 56)),
        (Window(from_m=0.5, to_m=1.0), range(28, 56)),
        (Window(from_revolution=30, to_revolution=40), range(30, 41)),
        (Window(to_revolution=3), range(4)),
        (Window(), range(80)),
    ],
)
def test_a_fault_is_active_where_its_window_holds(window: Window, revolutions: range) -> None:
    engine = FaultEngine(INSTALLED, [Scheduled("bias_step", window)])
    found = active(engine, 80)
    assert [revolution for revolution, ids in found.items() if ids] == list(revolutions)


@pytest.mark.parametrize(
    ("span", "last"),
    [
        (Span(duration_s=1.0), 33),
        (Span(revolutions=4), 9),
        (Span(distance_m=0.5), 33),
        (Span(), 79),
    ],
)
def test_an_injected_fault_lasts_for_its_span(span: Span, last: int) -> None:
    engine = FaultEngine(INSTALLED)
    active(engine, 6)
    engine.inject("bias_step", {}, span)
    found = []
    for revolution in range(6, 80):
        engine.begin_revolution(moment(revolution), drive())
        found += [revolution] if engine.active else []
    assert found == list(range(6, last + 1))


@pytest.mark.parametrize(
    "values", [{"duration_s": 0.0}, {"revolutions": -1}, {"distance_m": math.inf}]
)
def test_a_span_is_positive(values: dict[str, Any]) -> None:
    with pytest.raises(ParameterError, match="must be positive and finite"):
        Span(**values)


def test_faults_that_exclude_each_other_are_refused_when_they_are_sure_to_meet() -> None:
    early, late = Window(from_s=0.0, to_s=2.0), Window(from_s=1.0, to_s=3.0)
    with pytest.raises(ParameterError, match=r"faults\[1\].id = 'spike': overlaps with fault 1"):
        FaultEngine(INSTALLED, [Scheduled("stuck", early), Scheduled("spike", late)])
    FaultEngine(INSTALLED, [Scheduled("stuck", early), Scheduled("spike", Window(from_s=2.0))])
    with pytest.raises(ParameterError, match="cannot be active twice"):
        FaultEngine(INSTALLED, [Scheduled("stuck", Window()), Scheduled("stuck", late)])


def test_where_nobody_can_know_the_later_one_is_held_back_and_told() -> None:
    engine = FaultEngine(
        INSTALLED,
        [
            Scheduled("stuck", Window(from_s=1.0, to_s=2.0)),
            Scheduled("spike", Window(from_m=0.75, to_m=1.25)),
        ],
    )
    held: list[int] = []
    found = {}
    for revolution in range(80):
        engine.begin_revolution(moment(revolution), drive())
        found[revolution] = {item.fault.group for item in engine.active}
        held += [revolution] if engine.held_back else []
    assert [it for it in found if "stuck" in found[it]] == list(range(28, 56))
    assert [it for it in found if "spike" in found[it]] == list(range(56, 70))
    assert held == list(range(42, 56))
    engine.begin_revolution(moment(45), drive())


def test_a_scheduled_fault_that_cannot_be_is_refused_by_its_place() -> None:
    for item, message in (
        (Scheduled("stucc", Window()), r"faults\[0\].id = 'stucc': there is no fault"),
        (
            Scheduled("spike", Window(), {"probability": 2.0}),
            r"faults\[0\].parameters.probability = 2.0: must be at most 1",
        ),
        (Scheduled("lost_pulse", Window()), r"faults\[0\].id = 'lost_pulse': .*no sensor"),
    ):
        with pytest.raises(ParameterError, match=message):
            FaultEngine(INSTALLED, [item])


def test_ranges_of_different_kinds_need_not_meet() -> None:
    assert surely_overlap(Window(), Window(from_s=3.0))
    assert surely_overlap(Window(from_s=1.0), Window(from_s=3.0))
    assert not surely_overlap(Window(from_s=1.0), Window(from_m=3.0))
    assert not surely_overlap(Window(to_pass=1), Window(from_pass=2))
    assert surely_overlap(SimpleNamespace(), Window())
