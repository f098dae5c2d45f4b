# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The hand-over keeps order and bytes, refuses when full, and forgets nothing that it accepted."""

from __future__ import annotations

import os
from collections import deque
from itertools import islice

from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.traces.ring import Kind, Ring, State


class Pair:
    """Both ends of a ring, as two processes have them."""

    def __init__(self, capacity: int) -> None:
        descriptor = Ring.create(capacity)
        self.producer, self.consumer = Ring(descriptor), Ring(descriptor)
        os.close(descriptor)

    def drain(self) -> list:
        return list(self.consumer.drain(self.consumer.head))


STEPS = st.lists(
    st.one_of(
        st.integers(0, 700).map(lambda size: ("push", size)),
        st.integers(1, 4).map(lambda count: ("drain", count)),
    ),
    max_size=60,
)


@given(steps=STEPS, capacity=st.integers(64, 1200))
@settings(deadline=None, max_examples=200)
def test_first_in_first_out_whatever_the_sizes(steps, capacity: int) -> None:
    pair = Pair(capacity)
    expected: deque = deque()
    for number, (what, size) in enumerate(steps):
        if what == "push":
            data = bytes([number % 256]) * size
            if pair.producer.push(Kind.MESSAGE, number, 2 * number, 10**18 + number, 7, data):
                expected.append((Kind.MESSAGE, number, 2 * number, 10**18 + number, 7, data))
        else:
            for got in islice(pair.consumer.drain(pair.consumer.head), size):
                assert got == expected.popleft()
    assert pair.drain() == list(expected)
    # All room is there again.
    room = (capacity // 8 * 8 - 64) // 2
    if room > 0:
        assert pair.producer.push(Kind.MESSAGE, 0, 0, 0, 0, bytes(room))
        assert [len(item.data) for item in pair.drain()] == [room]


def test_full_ring_refuses_and_takes_again_after_draining() -> None:
    pair = Pair(4096)
    accepted = 0
    while pair.producer.push(Kind.MESSAGE, 1, accepted, 0, 0, bytes(100)):
        accepted += 1
    assert accepted == 4096 // 136
    assert not pair.producer.push(Kind.MESSAGE, 1, 99, 0, 0, bytes(100))
    assert [item.sequence for item in pair.drain()] == list(range(accepted))
    assert pair.producer.push(Kind.MESSAGE, 1, 100, 0, 0, bytes(100))


def test_message_larger_than_the_ring_is_refused() -> None:
    pair = Pair(1024)
    assert not pair.producer.push(Kind.MESSAGE, 1, 1, 0, 0, bytes(1024))
    assert pair.drain() == []


def test_only_what_was_there_at_a_head_is_drained() -> None:
    pair = Pair(4096)
    pair.producer.push(Kind.MESSAGE, 1, 1, 0, 0, b"a")
    head = pair.consumer.head
    pair.producer.push(Kind.MESSAGE, 1, 2, 0, 0, b"b")
    assert [item.data for item in pair.consumer.drain(head)] == [b"a"]
    assert [item.data for item in pair.drain()] == [b"b"]


def test_report_goes_the_other_way() -> None:
    pair = Pair(4096)
    assert pair.producer.report().state is State.STARTING
    assert not pair.producer.recording
    pair.consumer.set_state(State.RECORDING)
    pair.consumer.set_counts(3, 2, 1000)
    assert pair.producer.recording
    assert pair.producer.report() == (State.RECORDING, 3, 2, 1000, "")
    pair.consumer.set_state(State.FAILED, "no space left: " + "ü" * 2000)
    report = pair.producer.report()
    assert report.state is State.FAILED
    assert report.reason.startswith("no space left: üü")
    # What follows the reason in memory is not overwritten.
    pair.producer.push(Kind.MESSAGE, 1, 1, 0, 0, b"a")
    assert [item.data for item in pair.drain()] == [b"a"]
