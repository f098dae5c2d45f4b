# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The table's quality of service as rclpy has it, and back."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import QoSOverridingOptions

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Pacing
from roller_sim_ros.wire.qos import Qos
from roller_sim_ros.wire.topics import Topic

_RELIABILITY = {
    "reliable": ReliabilityPolicy.RELIABLE,
    "best_effort": ReliabilityPolicy.BEST_EFFORT,
}
_DURABILITY = {
    "volatile": DurabilityPolicy.VOLATILE,
    "transient_local": DurabilityPolicy.TRANSIENT_LOCAL,
}


@contextmanager
def overrides_of(topic: Topic) -> Iterator[None]:
    """Name the topic when rclpy refuses what a parameter ``qos_overrides.…`` asks for.

    Raises
    ------
    RollerSimError
        Then.
    """
    try:
        yield
    except (AssertionError, RuntimeError, TypeError, ValueError) as error:
        reason = " ".join(str(error).split()) or "not understood"
        raise RollerSimError(
            f"qos_overrides of {topic.name}: {reason}; without them it is {topic.qos(Pacing())}"
        ) from error


def overridable() -> QoSOverridingOptions:
    """Return the options that let parameters ``qos_overrides.…`` change history, depth and reliability."""
    return QoSOverridingOptions.with_default_policies()


def profile(qos: Qos) -> QoSProfile:
    """Return what rclpy wants for a row of the table."""
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=qos.depth,
        reliability=_RELIABILITY[qos.reliability],
        durability=_DURABILITY[qos.durability],
    )


def row(profile: QoSProfile) -> Qos:
    """Return the row for what rclpy made of it, overrides included."""
    best_effort = profile.reliability == ReliabilityPolicy.BEST_EFFORT
    lasting = profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return Qos(
        reliability="best_effort" if best_effort else "reliable",
        durability="transient_local" if lasting else "volatile",
        depth=int(profile.depth),
    )
