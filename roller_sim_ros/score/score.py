# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Reads a trace once and judges the meter in it."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from roller_sim_ros.analysis.bag import Bag, BagError, Topic, open_bag
from roller_sim_ros.analysis.samples import TRUTH_TYPE
from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.latency import find_latency
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.score.matching import by_log, by_stamp, laid_out
from roller_sim_ros.score.meter_topic import Choice, Given, MeterTopic
from roller_sim_ros.score.row import Row, Verdict
from roller_sim_ros.score.rows import judge
from roller_sim_ros.score.truth import FaultWindow, Truth, TruthReader, sound

FAULTS_TYPE = "roller_sim_ros/msg/FaultStates"
WINDOW = "meter.window_revolutions"
LONGEST_LATENCY_S = 3.0
"""Longest lag looked for; twice the limit where that is more."""

PROGRESS_MESSAGES = 1000
MATCHING = ("auto", "stamp", "log")


@dataclass(frozen=True)
class Options:
    """What is judged.

    Attributes
    ----------
    topic : str
        The meter's.
    choice : Choice
        Which of its fields are meant.
    matching : str
        ``stamp``: values are of the time of their header; ``log``: of when they came; ``auto``: by
        stamp where there is one.
    truth : str
        Topic with the truth; empty: the only one of its type.
    """

    topic: str
    choice: Choice = field(default_factory=Choice)
    matching: str = "auto"
    truth: str = ""


@dataclass(frozen=True)
class Score:
    """The verdict on a meter.

    Attributes
    ----------
    path : Path
        The trace.
    meter : MeterTopic
        What was read of it.
    stamped : bool
        Whether values were matched by their own stamps.
    revolutions, messages, unmatched : int
        Revolutions of the truth, messages of the meter, and those of them that are of no revolution.
    duration_s : float
        Of the truth.
    limits : Limits
        What was held against.
    rows : tuple of Row
        What was found.
    """

    path: Path
    meter: MeterTopic
    stamped: bool
    revolutions: int
    messages: int
    unmatched: int
    duration_s: float
    limits: Limits
    rows: tuple[Row, ...]

    @property
    def passed(self) -> bool:
        """Whether no row failed."""
        return not self.failed

    @property
    def failed(self) -> tuple[Row, ...]:
        """The rows that failed."""
        return tuple(row for row in self.rows if row.verdict is Verdict.FAIL)


def score(
    path: Path,
    options: Options,
    limits: Limits | None = None,
    on_progress: Callable[[float], None] | None = None,
) -> Score:
    """Judge the meter whose messages are in a trace beside the truth.

    Parameters
    ----------
    path : Path
        MCAP file or rosbag2 folder.
    options : Options
        What is judged.
    limits : Limits, optional
        What it may do; the defaults when left out.
    on_progress : callable, optional
        Called now and then with the share that is done, 0 to 1.

    Raises
    ------
    RollerSimError
        If there is no truth, no such topic, or nothing in it that can be judged.
    """
    limits = limits or Limits()
    bag = open_bag(path)
    try:
        return _score(path, bag, options, limits, on_progress or (lambda _: None))
    except BagError as error:
        text = str(error)
        raise BagError(text if text.startswith(str(path)) else f"{path}: {text}") from None


def _score(
    path: Path, bag: Bag, options: Options, limits: Limits, on_progress: Callable[[float], None]
) -> Score:
    found = _read(bag, options, on_progress)
    truth, faults, meter = found.truth, found.faults, found.meter
    # A header that nobody fills in says nothing.
    filled = meter.stamped and any(item.stamp_ns for item in found.messages)
    stamped = filled and options.matching != "log"
    if options.matching == "stamp" and not filled:
        raise BagError(f"{meter.name} ({meter.type_name}) has no stamp; match it by log")
    arrived = by_log(truth, np.array(found.logs_ns, dtype=np.int64))
    values = laid_out(found.messages, arrived, len(truth))
    usable = np.where(values.flagged, np.nan, values.value)
    clear = sound(faults, len(truth), limits.settle_revolutions)
    longest_s = max(LONGEST_LATENCY_S, 2.0 * limits.latency_s)
    latency = find_latency(np.where(clear, usable, np.nan), truth.cmv, truth.period_s, longest_s)
    places = arrived
    if stamped:
        stamps = np.array([item.stamp_ns for item in found.messages], dtype=np.int64)
        places = by_stamp(truth, stamps)
        values = laid_out(found.messages, places, len(truth))
    else:
        values = values.shifted(latency.revolutions)
    evidence = Evidence(
        truth=truth,
        faults=faults,
        values=values,
        stamped=stamped,
        alarm_is_rmv=meter.alarm_is_rmv,
        latency=latency,
        window=_window(bag.parameters),
        limits=limits,
    )
    return Score(
        path=path,
        meter=meter,
        stamped=stamped,
        revolutions=len(truth),
        messages=len(found.messages),
        unmatched=int(np.count_nonzero(places < 0)),
        duration_s=len(truth) * truth.period_s,
        limits=limits,
        rows=(_whole(bag), *judge(evidence)),
    )


@dataclass
class _Found:
    """What a trace holds of truth and meter."""

    truth: Truth
    faults: tuple[FaultWindow, ...]
    meter: MeterTopic
    messages: list[Given]
    logs_ns: array[int]


def _read(bag: Bag, options: Options, on_progress: Callable[[float], None]) -> _Found:
    """Read all messages that matter."""
    truth_topic = _truth_topic(bag, options.truth)
    topic = find_topic(bag.topics, options.topic)
    if topic.name == truth_topic.name:
        raise BagError(f"{topic.name} is the truth itself")
    names = {truth_topic.name, topic.name}
    faults = bag.topics.get(f"{truth_topic.name.rpartition('/')[0]}/faults")
    if faults is not None and faults.type == FAULTS_TYPE:
        names.add(faults.name)
    reader = TruthReader()
    meter: MeterTopic | None = None
    messages: list[Given] = []
    logs = array("q")
    for number, received in enumerate(bag.messages(names)):
        if received.topic == topic.name:
            if meter is None:
                meter = MeterTopic(topic.name, topic.type, received.message, options.choice)
            messages.append(meter.read(received.message))
            logs.append(received.time_ns)
        elif received.topic == truth_topic.name:
            reader.on_truth(received.message, received.time_ns)
        else:
            reader.on_faults(received.message)
        if number % PROGRESS_MESSAGES == 0:
            on_progress(bag.progress)
    on_progress(1.0)
    if meter is None:
        raise BagError(f"there are no messages on {topic.name}")
    truth = reader.truth()
    if len(truth) < 2:
        raise BagError(f"there are no two whole revolutions on {truth_topic.name}")
    return _Found(truth, reader.windows(), meter, messages, logs)


def _truth_topic(bag: Bag, name: str) -> Topic:
    if name:
        topic = find_topic(bag.topics, name)
        if topic.type != TRUTH_TYPE:
            raise BagError(f"{topic.name} holds {topic.type}, not {TRUTH_TYPE}")
        return topic
    found = [topic for topic in bag.topics.values() if topic.type == TRUTH_TYPE]
    if not found:
        raise BagError(
            f"holds no truth ({TRUTH_TYPE}) to judge by; record the roller's topic truth"
        )
    if len(found) > 1:
        names = ", ".join(sorted(topic.name for topic in found))
        raise BagError(f"several topics hold {TRUTH_TYPE}; choose one with --truth: {names}")
    return found[0]


def find_topic(topics: Mapping[str, Topic], name: str) -> Topic:
    """Return a topic by its name, with or without the leading slash.

    Raises
    ------
    BagError
        If it is not there.
    """
    for spelling in (name, f"/{name}"):
        if spelling in topics:
            return topics[spelling]
    listed = ", ".join(f"{topic.name} ({topic.type})" for topic in topics.values())
    raise BagError(f"there is no topic {name}; its topics: {listed or 'none'}")


def _window(parameters: Mapping[str, str]) -> int:
    """Return the window of the true values as the trace states it, or its default."""
    try:
        return int(parameters.get(WINDOW, PARAMETERS[WINDOW][1]))
    except ValueError:
        return int(PARAMETERS[WINDOW][1])


def _whole(bag: Bag) -> Row:
    """Return whether the trace could be read to its end."""
    return Row("trace", Verdict.FAIL if bag.damage else Verdict.PASS, detail=bag.damage or "whole")
