# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The session: one object that every driver steps, whether in real time, offline or in lock step."""

from roller_sim_ros.session.block import Block
from roller_sim_ros.session.command import (
    Applied,
    CommandRefused,
    ExciterCommand,
    ExciterStatus,
    Master,
    Refusal,
)
from roller_sim_ros.session.programme import Moment, Programme
from roller_sim_ros.session.session import Session, warm_up
from roller_sim_ros.session.supervision import Supervision

__all__ = [
    "Applied",
    "Block",
    "CommandRefused",
    "ExciterCommand",
    "ExciterStatus",
    "Master",
    "Moment",
    "Programme",
    "Refusal",
    "Session",
    "Supervision",
    "warm_up",
]
