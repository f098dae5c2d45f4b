# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``drum/imu``: one message per sample, thousands a second, so its bytes are put together from a template."""

from __future__ import annotations

import struct
from functools import cache

import numpy as np

from roller_sim_ros.sensors import Kind, Reading, specific_force
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.messages import FRAME, Message, sample_stamp
from roller_sim_ros.wire.types import encode, message_class

_STAMP = struct.Struct("<iI")
_ACCELERATION = struct.Struct("<3d")


def imu(reading: Reading, start_ns: int, decimation: int = 1) -> list[Message]:
    """Return ``drum/imu`` of a reading: specific force, x forward, z up; y, which the model has not, is 0.

    Parameters
    ----------
    reading : Reading
        What the sensor delivered.
    start_ns : int
        Start of the run, ns since the epoch.
    decimation : int
        Only samples whose index is a multiple of this are taken.
    """
    vertical, horizontal = reading.vertical, reading.horizontal
    if reading.kind is Kind.COORDINATE_ACCELERATION:
        z, x = specific_force(vertical, horizontal)
    else:
        z, x = vertical.astype(np.float64), horizontal.astype(np.float64)
    head, middle, tail = _template()
    name, type_name = topics.IMU.name, topics.IMU.type_name
    messages = []
    for index in range(-reading.first_sample % decimation, len(reading), decimation):
        stamp_ns = sample_stamp(reading, index, start_ns)
        stamp = _STAMP.pack(*divmod(stamp_ns, 1_000_000_000))
        data = b"".join((head, stamp, middle, _ACCELERATION.pack(x[index], 0.0, z[index]), tail))
        messages.append(Message(name, type_name, data, stamp_ns))
    return messages


@cache
def _template() -> tuple[bytes, bytes, bytes]:
    """Return the message's bytes before the stamp, between it and the acceleration, and after that.

    Orientation and rates are not measured: by the message's convention their covariances begin with −1.
    That of the acceleration is zero, which means unknown.
    """
    not_measured = np.zeros(9)
    not_measured[0] = -1.0
    vector = message_class("geometry_msgs/msg/Vector3")
    # Marks that nothing else in the message equals, to find the two places.
    stamp, acceleration = (0x01020304, 0x05060708), (1.25, 2.5, 5.125)
    message = message_class(topics.IMU.type_name)(
        message_class("std_msgs/msg/Header")(
            message_class("builtin_interfaces/msg/Time")(*stamp), FRAME
        ),
        message_class("geometry_msgs/msg/Quaternion")(0.0, 0.0, 0.0, 1.0),
        not_measured,
        vector(0.0, 0.0, 0.0),
        not_measured,
        vector(*acceleration),
        np.zeros(9),
    )
    data = encode(message, topics.IMU.type_name)
    head, _, rest = data.partition(_STAMP.pack(*stamp))
    middle, _, tail = rest.partition(_ACCELERATION.pack(*acceleration))
    return head, middle, tail
