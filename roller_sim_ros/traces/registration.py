# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Announces topics to a trace: schema, type hash and quality of service from the tables of `wire`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from roller_sim_ros.parameters import Pacing
from roller_sim_ros.wire.qos import Qos
from roller_sim_ros.wire.topics import TOPICS, Topic
from roller_sim_ros.wire.types import schema


class Registrar(Protocol):
    """What `TraceWriter` and `Recorder` have in common here."""

    def register(
        self,
        topic: str,
        type_name: str,
        schema_text: str,
        offered_qos_profiles: str,
        type_hash: str = "",
    ) -> None:
        """Announce a topic."""
        ...


def register(trace: Registrar, name: str, type_name: str, qos: Qos | None) -> None:
    """Announce one topic by its absolute name; `qos` None: unknown.

    Raises
    ------
    TypeUnknownError
        If the type's definition is not found.
    """
    known = schema(type_name)
    profiles = qos.offered_profiles() if qos else ""
    trace.register(name, type_name, known.text, profiles, known.type_hash)


def register_all(
    trace: Registrar, pacing: Pacing, namespace: str = "/", topics: Iterable[Topic] = TOPICS
) -> dict[str, str]:
    """Announce the node's topics in a namespace, but those that a node in simulated time alone has.

    Returns
    -------
    dict
        Names in the table of topics and the absolute names under which they are recorded.
    """
    wanted = [topic for topic in topics if not topic.of_simulated_time]
    names = {topic.name: topic.resolved(namespace) for topic in wanted}
    for topic in wanted:
        register(trace, names[topic.name], topic.type_name, topic.qos(pacing))
    return names
