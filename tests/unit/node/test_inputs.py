# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What clients want, without ROS: obeyed, refused, lost in a frozen link, missed by a watchdog."""

from __future__ import annotations

import math

import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.node.inputs import Inputs, upcoming
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import ExciterCommand, Refusal
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.types import encode, message_class

TWIST = "geometry_msgs/msg/Twist"


def travel(speed_m_s: float) -> bytes:
    vector = message_class("geometry_msgs/msg/Vector3")
    return encode(message_class(TWIST)(vector(speed_m_s, 0.0, 0.0), vector(0.0, 0.0, 0.0)), TWIST)


def exciter(frequency_hz: float) -> bytes:
    return messages.exciter_command(ExciterCommand(True, frequency_hz, 1e-3), 0).data


class Desk:
    """Inputs with a clock of their own, and what they said."""

    def __init__(self, **parameters: float) -> None:
        self.now_s = 0.0
        self.logged: list[str] = []
        self.answered: list[Refusal] = []
        self.inputs = Inputs(
            self.logged.append, lambda code, _: self.answered.append(code), lambda: self.now_s
        )
        values = {name.replace("__", "."): value for name, value in parameters.items()}
        self.emulator = Emulator(Configuration().changed(values), start_ns=0)

    def begin(self) -> None:
        self.inputs.begin(self.emulator)
        self.emulator.advance(128)


def test_commands_wait_for_the_next_revolution_and_show_before():
    desk = Desk()
    desk.begin()
    desk.inputs.take_exciter(exciter(30.0))
    desk.inputs.take_travel(travel(0.5))
    assert upcoming(desk.emulator).exciter.frequency_hz == 30.0
    assert desk.emulator.session.configuration.exciter.frequency_hz == 28.0
    desk.emulator.advance(128)
    assert desk.emulator.session.configuration.exciter.frequency_hz == 30.0
    assert desk.emulator.session.site.position.speed_m_s == 0.5
    assert desk.logged == []


def test_nobody_obeys_while_nothing_runs():
    desk = Desk()
    desk.inputs.take_exciter(exciter(30.0))
    desk.inputs.take_travel(travel(0.5))
    assert desk.answered == [Refusal.NOT_ACTIVE]
    assert all("not active" in line for line in desk.logged)
    assert len(desk.logged) == 2


@pytest.mark.parametrize(
    ("data", "word"),
    [
        (travel(math.nan), "finite"),
        (travel(5.5), "at most 5 m/s"),
        (b"", "is no Twist"),
        (travel(1.0)[:20], "is no Twist"),
    ],
)
def test_travel_that_cannot_be_is_refused(data, word):
    desk = Desk()
    desk.begin()
    desk.inputs.take_travel(data)
    assert word in desk.logged[0]
    assert word in desk.inputs.travel.reason
    assert desk.inputs.travel.refusing
    desk.emulator.advance(128)
    assert desk.emulator.session.site.position.speed_m_s == 0.0
    desk.inputs.take_travel(travel(1.0))
    assert not desk.inputs.travel.refusing


def test_damaged_exciter_command_is_refused():
    desk = Desk()
    desk.begin()
    desk.inputs.take_exciter(exciter(30.0)[:9])
    assert "is no ExciterCommand" in desk.logged[0]
    assert desk.emulator.refusal[0] is Refusal.DAMAGED


def test_roller_stops_when_travel_commands_fail_to_come():
    desk = Desk(travel__command_timeout_s=1.0)
    desk.begin()
    # Nobody drives: nothing is missed.
    desk.now_s = 5.0
    desk.inputs.watch()
    desk.inputs.take_travel(travel(0.5))
    desk.now_s = 6.0
    desk.inputs.watch()
    desk.emulator.advance(128)
    assert desk.emulator.session.site.position.speed_m_s == 0.5
    desk.now_s = 6.1
    desk.inputs.watch()
    desk.emulator.advance(128)
    assert desk.emulator.session.site.position.speed_m_s == 0.0
    assert "travel.command_timeout_s" in desk.logged[0]
    # It has stopped: that is said once, and is no refused command.
    desk.now_s = 9.0
    desk.inputs.watch()
    assert len(desk.logged) == 1
    assert desk.inputs.travel.refused == 0


def test_released_roller_is_not_watched():
    desk = Desk(travel__command_timeout_s=1.0)
    desk.begin()
    desk.inputs.take_travel(travel(0.5))
    desk.inputs.release()
    desk.now_s = 9.0
    desk.inputs.watch()
    assert desk.logged == []


def test_frozen_link_loses_commands_and_repeats_the_last():
    desk = Desk(exciter__command_timeout_s=1.0)
    desk.begin()
    handle = desk.emulator.inject("frozen_command_link")
    desk.emulator.advance(128)
    for data in (exciter(30.0), exciter(30.0)[:9]):
        desk.inputs.take_exciter(data)
    for now_s in (0.9, 1.8, 2.7):
        desk.now_s = now_s
        desk.inputs.watch()
    assert upcoming(desk.emulator).exciter.frequency_hz == 28.0
    assert upcoming(desk.emulator).exciter.vibrate
    assert desk.logged == []
    # The watchdog counts from its end.
    desk.emulator.clear(handle)
    desk.emulator.advance(128)
    desk.now_s = 3.6
    desk.inputs.watch()
    assert upcoming(desk.emulator).exciter.vibrate
    desk.now_s = 3.8
    desk.inputs.watch()
    assert not upcoming(desk.emulator).exciter.vibrate
    assert desk.emulator.refusal[0] is Refusal.TIMEOUT
