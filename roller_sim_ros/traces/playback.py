# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a trace is played, and when."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.traces.contents import TopicInfo
from roller_sim_ros.traces.reader import TraceMessage, TraceReader
from roller_sim_ros.traces.writer import SCHEMA_ENCODING
from roller_sim_ros.wire.topics import TOPICS, Direction
from roller_sim_ros.wire.types import schema

LOOP_AT_LEAST_S = 0.1
"""How long one turn of a loop lasts at least."""

HELD_BACK = frozenset(
    topic.type_name for topic in TOPICS if topic.direction is not Direction.PUBLISHED
)
"""Types of what a roller hears but does not say: commands, above all. Played only when named."""


def select_topics(reader: TraceReader, wanted: Collection[str] = ()) -> list[TopicInfo]:
    """Return the topics that are to be played, all of them with messages.

    Parameters
    ----------
    reader : TraceReader
        The trace.
    wanted : collection of str
        Names of topics, absolute or as they end (``drum/acceleration``); none: all but commands and
        parameter events.

    Raises
    ------
    RollerSimError
        If there is no topic of a wanted name, or nothing to be played at all.
    """
    present = [topic for topic in reader.topics.values() if topic.messages]
    if not wanted:
        chosen = [topic for topic in present if topic.type_name not in HELD_BACK]
    else:
        chosen = []
        for name in wanted:
            found = [it for it in present if it.name == name or it.name.endswith(f"/{name}")]
            if not found:
                names = ", ".join(topic.name for topic in present) or "none"
                raise RollerSimError(
                    f"{reader.path}: no messages on a topic {name}; topics with messages: {names}"
                )
            chosen += [topic for topic in found if topic not in chosen]
    if not chosen:
        raise RollerSimError(f"{reader.path}: holds no messages that could be played")
    return chosen


def check_definition(topic: TopicInfo) -> None:
    """Refuse a topic whose type is not defined here as it was when the trace was written.

    Raises
    ------
    TypeUnknownError
        If the type is not installed.
    RollerSimError
        If the definitions differ: the recorded bytes would be misread.
    """
    installed = schema(topic.type_name)
    if topic.schema_encoding != SCHEMA_ENCODING or not topic.schema_text:
        return
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(topic.schema_text, topic.type_name))
    if store.hash_rihs01(topic.type_name) != installed.type_hash:
        raise RollerSimError(
            f"{topic.name}: the type {topic.type_name} in the trace is not the one that is installed; "
            "install the version that the trace was recorded with, or leave the topic out with --topics"
        )


def timeline(
    reader: TraceReader, topics: Sequence[TopicInfo], *, loop: bool = False
) -> Iterator[tuple[float, TraceMessage]]:
    """Yield (seconds after the first message, message) by the times at which they were published.

    Parameters
    ----------
    reader : TraceReader
        The trace.
    topics : sequence of TopicInfo
        What is played.
    loop : bool
        Begin anew after the last message, without end.
    """
    names = {topic.name for topic in topics}
    offset_s = 0.0
    while True:
        first_ns: int | None = None
        due_s = 0.0
        for message in reader.messages(names):
            # Some recorders leave the publish time open.
            time_ns = message.publish_time_ns or message.log_time_ns
            if first_ns is None:
                first_ns = time_ns
            due_s = max(due_s, (time_ns - first_ns) * 1e-9)
            yield offset_s + due_s, message
        if not loop or first_ns is None:
            return
        offset_s += max(due_s, LOOP_AT_LEAST_S)
