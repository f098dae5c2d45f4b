# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What sensors beside the accelerometer deliver, and the faults, as ROS messages."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from roller_sim_ros.faults import ActiveFault
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.sensors import Fix, Pulse, Travelled
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import FRAME, Message
from roller_sim_ros.wire.types import encode, message_class

ODOMETRY_FRAME, BASE_FRAME = "odom", "base_link"
"""REP-105: dead reckoning has its own frame, in which the roller's base moves; x is forward along the lane."""
GNSS_FRAME = "gnss"
UNKNOWN_VARIANCE = 1e6
"""Of what is not measured, as robot_localization and others read it."""
_GBAS_FIX, _GPS, _DIAGONAL_KNOWN = 2, 1, 2


def tacho_pulse(pulse: Pulse, start_ns: int) -> Message:
    """Return ``tacho``."""
    stamp_ns = _stamp(pulse.time_s, start_ns)
    return _message(
        topics.TACHO,
        stamp_ns,
        _header(stamp_ns, FRAME),
        pulse.sequence,
        pulse.eccentric_phase_rad,
        pulse.interval_s,
    )


def odometry(travelled: Travelled, start_ns: int) -> Message:
    """Return ``odom``: way and speed forward; the variance of all that is not measured is very large."""
    stamp_ns = _stamp(travelled.time_s, start_ns)
    vector = message_class("geometry_msgs/msg/Vector3")
    pose = message_class("geometry_msgs/msg/Pose")(
        message_class("geometry_msgs/msg/Point")(travelled.distance_m, 0.0, 0.0),
        message_class("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0),
    )
    twist = message_class("geometry_msgs/msg/Twist")(
        vector(travelled.speed_m_s, 0.0, 0.0), vector(0.0, 0.0, 0.0)
    )
    return _message(
        topics.ODOMETRY,
        stamp_ns,
        _header(stamp_ns, ODOMETRY_FRAME),
        BASE_FRAME,
        message_class("geometry_msgs/msg/PoseWithCovariance")(
            pose, _covariance(travelled.distance_deviation_m)
        ),
        message_class("geometry_msgs/msg/TwistWithCovariance")(
            twist, _covariance(travelled.speed_deviation_m_s)
        ),
    )


def fix(found: Fix, start_ns: int) -> Message:
    """Return ``fix``: the status is that of a receiver with ground-based corrections."""
    stamp_ns = _stamp(found.time_s, start_ns)
    return _message(
        topics.FIX,
        stamp_ns,
        _header(stamp_ns, GNSS_FRAME),
        message_class("sensor_msgs/msg/NavSatStatus")(_GBAS_FIX, _GPS),
        found.place.latitude_deg,
        found.place.longitude_deg,
        found.place.altitude_m,
        np.diag(found.variances_m2).ravel(),
        _DIAGONAL_KNOWN,
    )


def fault_states(
    active: Sequence[ActiveFault], held_back: Sequence[str], sample: int, stamp_ns: int
) -> Message:
    """Return ``faults``: all that are active from a sample on."""
    return _message(
        topics.FAULTS,
        stamp_ns,
        _header(stamp_ns, ""),
        sample,
        [_fault_state(item) for item in active],
        list(held_back),
    )


def _fault_state(item: ActiveFault) -> Any:
    fault = item.fault
    names = [name for name, _, _ in declared(type(fault))]
    expected = fault.expectation()
    return message_class("roller_sim_ros/msg/FaultState")(
        item.handle,
        fault.group,
        fault.stage.value,
        item.live,
        item.since_sample,
        names,
        [str(getattr(fault, name)) for name in names],
        int(expected.behaviour),
        expected.tolerance_percent,
        expected.within_revolutions,
    )


def _covariance(deviation: float) -> Any:
    variances = np.full(6, UNKNOWN_VARIANCE)
    variances[0] = deviation**2
    return np.diag(variances).ravel()


def _stamp(time_s: float, start_ns: int) -> int:
    return start_ns + round(time_s * 1e9)


def _header(stamp_ns: int, frame: str) -> Any:
    time = message_class("builtin_interfaces/msg/Time")(*divmod(stamp_ns, 1_000_000_000))
    return message_class("std_msgs/msg/Header")(time, frame)


def _message(topic: topics.Topic, stamp_ns: int, *fields: Any) -> Message:
    message = message_class(topic.type_name)(*fields)
    return Message(topic.name, topic.type_name, encode(message, topic.type_name), stamp_ns)
