# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

from __future__ import annotations

from dataclasses import replace

import pytest

from roller_sim_ros.node import command_input
from roller_sim_ros.node.command_input import CommandInput
from roller_sim_ros.parameters import Exciter
from roller_sim_ros.session import Refusal


@pytest.fixture
def clock(monkeypatch):
    class Clock:
        now = 100.0

        def monotonic(self) -> float:
            return self.now

    clock = Clock()
    monkeypatch.setattr(command_input, "time", clock)
    return clock


def test_the_same_refusal_is_logged_once_a_second(clock):
    commands = CommandInput(clock.monotonic)
    assert commands.refuse(Refusal.NEGATIVE, "a")
    assert not commands.refuse(Refusal.NEGATIVE, "a")
    assert commands.refuse(Refusal.NEGATIVE, "b")
    clock.now += 1.5
    assert commands.refuse(Refusal.NEGATIVE, "b")
    assert commands.refused == 4


def test_watchdog_acts_once_the_time_is_over_and_only_while_vibrating(clock):
    exciter = Exciter(command_timeout_s=2.0)
    commands = CommandInput(clock.monotonic)
    commands.accepted()
    clock.now += 2.0
    assert commands.overdue(exciter) == ""
    clock.now += 0.1
    assert "at most 2 s (exciter.command_timeout_s)" in commands.overdue(exciter)
    assert commands.overdue(replace(exciter, vibrate=False)) == ""
    assert commands.overdue(replace(exciter, command_timeout_s=0.0)) == ""
    commands.accepted()
    assert commands.overdue(exciter) == ""


def test_what_the_watchdog_does_is_told_but_is_no_refused_command(clock):
    commands = CommandInput(clock.monotonic)
    commands.refuse(Refusal.TIMEOUT, "silence")
    assert (commands.refused, commands.reason, commands.refusing) == (0, "silence", True)
    commands.accepted()
    assert not commands.refusing
    assert commands.reason == "silence"
