# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Bytes of messages as the library writes them, whatever is in the messages."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.interfaces import Nodetype

from roller_sim_ros.wire.packing import Packer
from roller_sim_ros.wire.topics import TOPICS
from roller_sim_ros.wire.types import encode, message_class, typestore

LISTS = (
    "diagnostic_msgs/msg/DiagnosticArray",
    "roller_sim_ros/msg/FaultStates",
    "sensor_msgs/msg/JointState",
)
TYPES = sorted(
    {topic.type_name for topic in TOPICS} | {*LISTS, "roller_sim_ros/msg/ExciterCommand"}
)


def _number(draw: Any, what: str) -> Any:
    if what == "bool":
        return draw(st.booleans())
    if what.startswith("float"):
        return draw(st.floats(width=int(what[5:])))
    if what in ("byte", "char", "octet"):
        return draw(st.integers(0, 127))
    limits = np.iinfo(what)
    return draw(st.integers(int(limits.min), int(limits.max)))


def _message(draw: Any, type_name: str) -> Any:
    values = []
    for _, (node, what) in typestore().fielddefs[type_name][1]:
        if node == Nodetype.NAME:
            values.append(_message(draw, what))
        elif node == Nodetype.BASE:
            values.append(
                draw(st.text(max_size=9)) if what[0] == "string" else _number(draw, what[0])
            )
        else:
            (inner, of), length = what
            count = length if node == Nodetype.ARRAY else draw(st.integers(0, 3))
            if inner == Nodetype.NAME:
                values.append([_message(draw, of) for _ in range(count)])
            elif of[0] == "string":
                values.append([draw(st.text(max_size=9)) for _ in range(count)])
            else:
                seed = draw(st.integers(0, 2**32 - 1))
                data = np.random.default_rng(seed).bytes(count * np.dtype(of[0]).itemsize)
                values.append(np.frombuffer(data, dtype=of[0]))
    return message_class(type_name)(*values)


@pytest.mark.parametrize("type_name", TYPES)
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_bytes_are_those_of_the_library(type_name: str, data: st.DataObject) -> None:
    message = _message(data.draw, type_name)
    assert encode(message, type_name) == bytes(typestore().serialize_cdr(message, type_name))


@pytest.mark.parametrize("type_name", LISTS)
def test_lists_of_messages_and_strings_have_no_layout(type_name: str) -> None:
    with pytest.raises(ValueError, match="has no layout"):
        Packer(type_name, typestore().fielddefs)


def test_a_fixed_array_of_another_length_is_refused() -> None:
    name = "geometry_msgs/msg/PoseWithCovariance"
    message = message_class(name)(
        message_class("geometry_msgs/msg/Pose")(
            message_class("geometry_msgs/msg/Point")(0.0, 0.0, 0.0),
            message_class("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0),
        ),
        np.zeros(35),
    )
    with pytest.raises(ValueError, match="35 elements: the message has 36"):
        Packer(name, typestore().fielddefs)(message)
