# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which topics of a bag belong together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from roller_sim_ros.analysis.bag import BagError, Topic
from roller_sim_ros.analysis.samples import (
    ACCELERATION_TYPE,
    EXCITER_TYPE,
    FACTS_TYPE,
    IMU_TYPE,
    METER_TYPE,
    NUMBER_TYPE,
    TRUTH_TYPE,
)
from roller_sim_ros.meters.registry import FURTHER

_SOURCES = (ACCELERATION_TYPE, IMU_TYPE)


@dataclass(frozen=True)
class Selection:
    """Topics of one roller; empty names for those that are not there.

    Attributes
    ----------
    source : Topic
        DrumAcceleration or Imu.
    meter, cmv, truth : str
        Topics with recorded meter values, CMV alone, and the truth.
    exciter, machine : str
        Topics with what the exciter does, and with the machine's parameters.
    further : dict
        {topic: name} of further meter values, one on each topic.
    """

    source: Topic
    meter: str
    cmv: str
    truth: str
    exciter: str = ""
    machine: str = ""
    further: Mapping[str, str] = field(default_factory=dict)

    @property
    def names(self) -> set[str]:
        """All that are read from front to back."""
        found = (self.source.name, self.meter, self.cmv, self.truth, self.exciter, *self.further)
        return {name for name in found if name}


def select(
    path: Path, topics: Mapping[str, Topic], source: str | None = None, meter: str | None = None
) -> Selection:
    """Choose the acceleration and what is recorded beside it under the same namespace.

    Without `source` there must be one topic with DrumAcceleration, or none and one with Imu messages.

    Parameters
    ----------
    path : Path
        Bag, for messages.
    topics : mapping
        Topics of the bag.
    source : str, optional
        Topic with the acceleration.
    meter : str, optional
        Topic with the meter values to compare with, CompactionMeter or Float64 (taken for CMV).

    Raises
    ------
    BagError
        If there is no such topic, or several between which to choose.
    """
    chosen = _source(path, topics, source)
    base = chosen.name.rpartition("/")[0].rpartition("/")[0]
    found = Selection(
        source=chosen,
        meter=_beside(topics, METER_TYPE, f"{base}/meter"),
        cmv=_named(topics, NUMBER_TYPE, f"{base}/cmv"),
        truth=_beside(topics, TRUTH_TYPE, f"{base}/truth"),
        exciter=_beside(topics, EXCITER_TYPE, f"{base}/exciter/state"),
        machine=_named(topics, FACTS_TYPE, f"{base}/machine"),
        further={
            name: item.name
            for item in FURTHER
            if (name := _named(topics, NUMBER_TYPE, f"{base}/meters/{item.name}"))
        },
    )
    if meter is None:
        return found
    given = _find(path, topics, meter)
    if given.type == METER_TYPE:
        return replace(found, meter=given.name, cmv="", further={})
    if given.type == NUMBER_TYPE:
        return replace(found, meter="", cmv=given.name, further={})
    raise BagError(
        f"{path}: {given.name} holds {given.type}; meter values are {METER_TYPE} or {NUMBER_TYPE}"
    )


def _source(path: Path, topics: Mapping[str, Topic], name: str | None) -> Topic:
    if name is not None:
        topic = _find(path, topics, name)
        if topic.type not in _SOURCES:
            raise BagError(
                f"{path}: {topic.name} holds {topic.type or 'an unknown type'}, neither "
                f"{ACCELERATION_TYPE} nor {IMU_TYPE}"
            )
        if not topic.count:
            raise BagError(f"{path}: there are no messages on {topic.name}")
        return topic
    for wanted in _SOURCES:
        found = [topic for topic in topics.values() if topic.type == wanted]
        filled = [topic for topic in found if topic.count]
        if len(filled) == 1:
            return filled[0]
        if filled:
            names = ", ".join(sorted(topic.name for topic in filled))
            raise BagError(
                f"{path}: several topics hold {wanted}; choose one with --topic: {names}"
            )
    empty = [topic.name for topic in topics.values() if topic.type in _SOURCES]
    if empty:
        raise BagError(f"{path}: there are no messages on {', '.join(empty)}")
    raise BagError(
        f"{path}: holds neither {ACCELERATION_TYPE} nor {IMU_TYPE}; its topics: {_listed(topics)}"
    )


def _find(path: Path, topics: Mapping[str, Topic], name: str) -> Topic:
    for spelling in (name, f"/{name}"):
        if spelling in topics:
            return topics[spelling]
    raise BagError(f"{path}: there is no topic {name}; its topics: {_listed(topics)}")


def _beside(topics: Mapping[str, Topic], type_name: str, name: str) -> str:
    """Return the topic of a type by its name, or the only one of that type if it was renamed."""
    if named := _named(topics, type_name, name):
        return named
    found = [topic.name for topic in topics.values() if topic.type == type_name]
    sources = [topic for topic in topics.values() if topic.type == ACCELERATION_TYPE]
    return found[0] if len(found) == 1 and len(sources) <= 1 else ""


def _named(topics: Mapping[str, Topic], type_name: str, name: str) -> str:
    topic = topics.get(name)
    return name if topic is not None and topic.type == type_name else ""


def _listed(topics: Mapping[str, Topic]) -> str:
    if not topics:
        return "none"
    return ", ".join(f"{topic.name} ({topic.type})" for topic in topics.values())
