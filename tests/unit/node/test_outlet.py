# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A message that the middleware refuses is counted and recorded, and the others go out."""

from __future__ import annotations

from roller_sim_ros.node import outlet
from roller_sim_ros.node.outlet import Outlet
from roller_sim_ros.parameters import Pacing
from roller_sim_ros.wire.messages import Message


class Publisher:
    def __init__(self, topic: str) -> None:
        self.topic_name = f"/{topic.lstrip('/')}"
        self.sent: list[bytes] = []
        self.readers = 1

    def get_subscription_count(self) -> int:
        return self.readers

    def publish(self, data: bytes) -> None:
        if data == b"too much":
            raise RuntimeError("Failed to publish")
        self.sent.append(data)


class Node:
    def create_publisher(self, _type, topic, _qos, event_callbacks, qos_overriding_options):
        assert event_callbacks
        assert qos_overriding_options
        return Publisher(topic)


class Trace:
    def __init__(self) -> None:
        self.taken: list[tuple[str, bytes]] = []

    def put(self, topic: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> bool:
        assert log_time_ns >= publish_time_ns > 0
        self.taken.append((topic, data))
        return True


def test_refused_message_is_counted_and_recorded(monkeypatch):
    monkeypatch.setattr(outlet, "message_type", lambda name: name)
    out = Outlet(Node(), Pacing())
    out.trace = Trace()
    out.send(Message("meter", "any", data, 1) for data in (b"a", b"too much", b"b"))
    assert out.unsent == 1
    assert out.publishers["meter"].sent == [b"a", b"b"]
    assert out.trace.taken == [("/meter", b"a"), ("/meter", b"too much"), ("/meter", b"b")]


def test_what_nobody_hears_is_recorded_and_what_lasts_is_sent(monkeypatch):
    monkeypatch.setattr(outlet, "message_type", lambda name: name)
    out = Outlet(Node(), Pacing())
    out.trace = Trace()
    for name in ("meter", "soil"):
        out.publishers[name].readers = 0
        out.send([Message(name, "any", b"a", 1)])
    assert out.publishers["meter"].sent == []
    assert out.publishers["soil"].sent == [b"a"]
    assert out.trace.taken == [("/meter", b"a"), ("/soil", b"a")]


def test_clock_is_there_in_simulated_time_and_refusable(monkeypatch):
    monkeypatch.setattr(outlet, "message_type", lambda name: name)
    assert "/clock" not in Outlet(Node(), Pacing()).publishers
    assert "/clock" in Outlet(Node(), Pacing(lock_step=True)).publishers
    refused = Outlet(Node(), Pacing(clock="sim", publish_clock=False))
    assert "/clock" not in refused.publishers
    refused.announce(Message("/clock", "any", b"a", 1))
