# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a message is the value, the flag and the alarm."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import pytest

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.score.meter_topic import Choice, MeterTopic
from roller_sim_ros.wire.types import message_class


def header(stamp_s: int) -> Any:
    return message_class("std_msgs/msg/Header")(
        message_class("builtin_interfaces/msg/Time")(stamp_s, 500), "drum"
    )


@dataclass
class Reading:
    """A meter's own message as the decoder makes it."""

    header: Any
    raw: int
    stiffness: float
    valid_until: float
    jumping: bool
    KIND: int = 3


@dataclass
class Nested:
    result: Reading
    double_jump: bool


READING = Reading(header(3), 7, 41.5, 9.0, jumping=True)


def topic(message: Any, **choice: str) -> MeterTopic:
    return MeterTopic("/mine", "mine/msg/Reading", message, Choice(**choice))


def test_a_plain_number_has_neither_stamp_nor_flag_nor_alarm() -> None:
    message = message_class("std_msgs/msg/Float64")(41.5)
    meter = topic(message)
    given = meter.read(message)
    assert (meter.field, meter.flag, meter.alarm, meter.stamped) == ("data", "", "", False)
    assert (given.value, given.flagged, given.stamp_ns) == (41.5, False, None)
    assert math.isnan(given.alarm)


@pytest.mark.parametrize("name", ["Float32", "Int32", "UInt8"])
def test_any_number_of_std_msgs_will_do(name: str) -> None:
    message = message_class(f"std_msgs/msg/{name}")(41)
    assert topic(message).read(message).value == 41.0


def test_the_meter_s_own_message_has_all() -> None:
    message = message_class("roller_sim_ros/msg/CompactionMeter")(
        header(3), 2047, 16, 41.5, 60.0, 28.0, 20.0, 0.1, 2, 3, 8
    )
    meter = topic(message)
    given = meter.read(message)
    assert (meter.field, meter.flag, meter.alarm) == ("cmv", "status", "rmv")
    assert meter.alarm_is_rmv
    assert (given.value, given.flagged, given.alarm) == (41.5, True, 60.0)
    assert given.stamp_ns == 3_000_000_500


def test_a_field_of_a_usual_name_may_mean_something_else() -> None:
    message = message_class("roller_sim_ros/msg/CompactionMeter")(
        header(3), 2047, 16, 41.5, 60.0, 28.0, 20.0, 0.1, 2, 3, 8
    )
    meter = topic(message, flag="-", alarm="-")
    assert (meter.flag, meter.alarm) == ("", "")
    assert not meter.read(message).flagged


def test_fields_can_be_chosen_and_nested() -> None:
    meter = topic(READING, value="stiffness", alarm="jumping", flag="raw")
    given = meter.read(READING)
    assert (given.value, given.flagged, given.alarm) == (41.5, True, 1.0)
    assert not meter.alarm_is_rmv
    nested = Nested(READING, double_jump=False)
    meter = topic(nested, value="result.stiffness")
    assert meter.alarm == "double_jump"
    assert meter.read(nested).value == 41.5


def test_what_cannot_be_told_is_asked_for() -> None:
    with pytest.raises(BagError, match="Choose one with --field: raw, stiffness, valid_until"):
        topic(READING)
    with pytest.raises(BagError, match="no number 'cmv'; it has raw, stiffness"):
        topic(READING, value="cmv")
    with pytest.raises(BagError, match="no number 'header'"):
        topic(READING, value="header")
