# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a report tells of a run, gathered from its trace in one pass over columns."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.decoding import Decoder
from roller_sim_ros.analysis.samples import ACCELERATION_TYPE, METER_TYPE, NANOSECONDS, TRUTH_TYPE
from roller_sim_ros.scenario.metadata import SCENARIO
from roller_sim_ros.traces.columns import Layout, Messages, read_messages
from roller_sim_ros.traces.metadata import PARAMETERS
from roller_sim_ros.traces.reader import TraceReader

SITE_TYPE = "roller_sim_ros/msg/SiteState"
EXCITER_TYPE = "roller_sim_ros/msg/ExciterState"
FAULTS_TYPE = "roller_sim_ros/msg/FaultStates"
APPLIED_TYPE = "roller_sim_ros/msg/AppliedChange"

STAMP = ("header.stamp.sec", "header.stamp.nanosec")
ACCELERATION_FIELDS = ("sequence", "sample_period", "excitation_frequency")
METER_FIELDS = ("last_sample", "cmv", "rmv", "mode", "status", "excitation_frequency")
SITE_FIELDS = (
    "chainage",
    "pass_number",
    "speed",
    "shear_modulus",
    "plastic_parameter",
    "cmv",
    "mode",
)
EXCITER_FIELDS = ("frequency", "amplitude", "commanded_frequency", "commanded_amplitude")

Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Gap:
    """Samples that are missing, or that come twice or late (negative)."""

    time_s: float
    samples: int


@dataclass(frozen=True)
class Event:
    """Something that happened: a change that took effect, a fault that began or ended."""

    time_s: float
    what: str


@dataclass
class RunRecord:
    """What a report tells of a run.

    Attributes
    ----------
    path : Path
        The trace.
    parameters : mapping
        Parameters of the run as it began, by dotted name.
    scenario : mapping
        Metadata of the scenario, empty without one.
    start_ns : int
        Stamp of the first sample, ns since the epoch.
    duration_s : float
        From the first sample to the last.
    samples, messages : int
        On the topic with the acceleration.
    gaps : list of Gap
        Where the samples' count jumps.
    envelope : dict of ndarray
        ``time_s``, ``low``, ``high`` of the vertical acceleration, m/s², a row a message.
    meter, site, exciter : dict of ndarray
        Fields of the messages by their names, ``time_s`` and ``log_time_ns``; empty without such a topic.
    events : list of Event
        In the order of time.
    damage : str
        What of the trace could not be read.
    topics : dict
        Messages of each topic.
    acceleration_topic, truth_topic : str
        Names of the topics; empty without one.
    """

    path: Path
    parameters: Mapping[str, str]
    scenario: Mapping[str, str]
    start_ns: int = 0
    duration_s: float = 0.0
    samples: int = 0
    messages: int = 0
    gaps: list[Gap] = field(default_factory=list)
    envelope: Columns = field(default_factory=dict)
    meter: Columns = field(default_factory=dict)
    site: Columns = field(default_factory=dict)
    exciter: Columns = field(default_factory=dict)
    events: list[Event] = field(default_factory=list)
    damage: str = ""
    topics: Mapping[str, int] = field(default_factory=dict)
    acceleration_topic: str = ""
    truth_topic: str = ""


class FieldReader:
    """Reads fields of the messages of one topic, whatever the lengths of their texts and arrays.

    Parameters
    ----------
    decoder : Decoder
        Knows the type.
    type_name : str
        The type.
    """

    MOST_LAYOUTS = 64

    def __init__(self, decoder: Decoder, type_name: str) -> None:
        self._definitions = decoder.definitions
        self._type_name = type_name
        self._layouts: list[Layout] = []

    def parts(self, messages: Messages) -> list[tuple[Layout, NDArray[np.int64], Messages]]:
        """Return the messages in groups that are alike: layout, their numbers, themselves."""
        left = np.arange(len(messages.starts), dtype=np.int64)
        found = []
        for number in range(self.MOST_LAYOUTS):
            if not len(left):
                break
            rest = messages.chosen(left)
            if number == len(self._layouts):
                self._layouts.append(Layout(self._definitions, self._type_name, rest.bytes_of(0)))
            layout = self._layouts[number]
            same = layout.alike(rest)
            if same.any():
                found.append((layout, left[same], rest.chosen(same)))
                left = left[~same]
        return found

    def columns(self, messages: Messages, names: tuple[str, ...]) -> Columns:
        """Return scalar fields, in the order of the messages."""
        parts = self.parts(messages)
        numbers = np.concatenate([number for _, number, _ in parts])
        order = np.argsort(numbers, kind="stable")
        return {
            name: np.concatenate([layout.field(part, name) for layout, _, part in parts])[order]
            for name in names
        }


def read_run(
    path: Path, topic: str | None, progress: Callable[[float], None] = lambda _share: None
) -> RunRecord:
    """Gather what a report tells.

    Parameters
    ----------
    path : Path
        MCAP file or rosbag2 folder of MCAP files.
    topic : str, optional
        Topic with the acceleration; needed when there are several rollers.
    progress : callable
        Told the share that is read.

    Raises
    ------
    TraceError
        If it cannot be read.
    BagError
        If it holds no drum acceleration of this package, or of several rollers.
    """
    reader = TraceReader(path)
    record = RunRecord(
        path,
        reader.metadata.get(PARAMETERS, {}),
        reader.metadata.get(SCENARIO, {}),
        topics={name: info.messages for name, info in reader.topics.items() if info.messages},
        damage=reader.damage_text() or "",
    )
    record.acceleration_topic = _source(path, reader, topic)
    base = record.acceleration_topic.rpartition("/")[0].rpartition("/")[0]
    wanted = {
        record.acceleration_topic: ACCELERATION_TYPE,
        f"{base}/meter": METER_TYPE,
        f"{base}/site/state": SITE_TYPE,
        f"{base}/exciter/state": EXCITER_TYPE,
        f"{base}/faults": FAULTS_TYPE,
        f"{base}/applied": APPLIED_TYPE,
    }
    names = {
        type_name: name
        for name, type_name in wanted.items()
        if name in reader.topics and reader.topics[name].type_name == type_name
    }
    truth = reader.topics.get(f"{base}/truth")
    record.truth_topic = truth.name if truth and truth.type_name == TRUTH_TYPE else ""
    decoder = Decoder()
    for name in names.values():
        decoder.add(reader.topics[name].type_name, reader.topics[name].schema_text)
    _Gathering(record, decoder, names).read(path, progress)
    return record


def _source(path: Path, reader: TraceReader, topic: str | None) -> str:
    found = [
        info.name
        for info in reader.topics.values()
        if info.type_name == ACCELERATION_TYPE and info.messages
    ]
    if topic is not None:
        given = [name for name in found if name in (topic, f"/{topic}")]
        if not given:
            raise BagError(f"{path}: there is no {ACCELERATION_TYPE} on {topic}; it is on {found}")
        return given[0]
    if len(found) != 1:
        what = f"several topics hold it; choose one with --topic: {found}" if found else "none"
        raise BagError(f"{path}: a report is about a topic with {ACCELERATION_TYPE}: {what}")
    return found[0]


class _Gathering:
    """One pass over a trace."""

    def __init__(self, record: RunRecord, decoder: Decoder, names: Mapping[str, str]) -> None:
        self._record = record
        self._decoder = decoder
        self._names = names
        self._readers = {type_name: FieldReader(decoder, type_name) for type_name in names}
        self._parts: dict[str, list[Columns]] = {type_name: [] for type_name in names}
        self._active: dict[int, str] = {}
        self._held = ""

    def read(self, path: Path, progress: Callable[[float], None]) -> None:
        """Fill the record."""
        fields = {
            METER_TYPE: METER_FIELDS,
            SITE_TYPE: SITE_FIELDS,
            EXCITER_TYPE: EXCITER_FIELDS,
        }
        events: list[tuple[int, str]] = []
        for chunk in read_messages(path, set(self._names.values()), progress):
            for type_name, name in self._names.items():
                messages = chunk.get(name)
                if messages is None or not len(messages.starts):
                    continue
                if type_name == ACCELERATION_TYPE:
                    self._parts[type_name].append(self._acceleration(messages))
                elif type_name in fields:
                    found = self._readers[type_name].columns(messages, (*STAMP, *fields[type_name]))
                    found["log_time_ns"] = messages.log_time_ns.astype(np.int64)
                    self._parts[type_name].append(found)
                else:
                    events += self._events(type_name, messages)
        self._finish(events)

    def _acceleration(self, messages: Messages) -> Columns:
        reader = self._readers[ACCELERATION_TYPE]
        parts = reader.parts(messages)
        found: dict[str, list[NDArray[Any]]] = {}
        for layout, _, alike in parts:
            vertical = layout.field(alike, "vertical")
            columns = {name: layout.field(alike, name) for name in (*STAMP, *ACCELERATION_FIELDS)}
            columns["count"] = np.full(len(vertical), vertical.shape[1])
            empty = vertical.shape[1] == 0
            columns["low"] = np.full(len(vertical), np.nan) if empty else vertical.min(axis=1)
            columns["high"] = np.full(len(vertical), np.nan) if empty else vertical.max(axis=1)
            for name, column in columns.items():
                found.setdefault(name, []).append(column)
        order = np.argsort(np.concatenate([numbers for _, numbers, _ in parts]), kind="stable")
        return {name: np.concatenate(columns)[order] for name, columns in found.items()}

    def _events(self, type_name: str, messages: Messages) -> list[tuple[int, str]]:
        found = []
        for number in range(len(messages.starts)):
            message = self._decoder.decode(messages.bytes_of(number), type_name)
            stamp = message.header.stamp.sec * NANOSECONDS + message.header.stamp.nanosec
            if type_name == APPLIED_TYPE:
                value = message.text or f"{message.value:g}"
                found.append((stamp, f"{message.name} = {value}"))
                continue
            active = {int(fault.handle): str(fault.id) for fault in message.faults}
            found += [
                (stamp, f"fault {name} begins")
                for handle, name in active.items()
                if handle not in self._active
            ]
            found += [
                (stamp, f"fault {name} ends")
                for handle, name in self._active.items()
                if handle not in active
            ]
            self._active = active
        return found

    def _finish(self, events: list[tuple[int, str]]) -> None:
        record = self._record
        whole = {
            type_name: {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
            for type_name, parts in self._parts.items()
            if parts
        }
        acceleration = whole.get(ACCELERATION_TYPE)
        if acceleration is None:
            raise BagError(f"{record.path}: no message of {record.acceleration_topic} can be read")
        stamps = _stamps(acceleration)
        record.start_ns = int(stamps[0])
        counts, sequence = acceleration["count"], acceleration["sequence"].astype(np.int64)
        record.samples, record.messages = int(counts.sum()), len(counts)
        last_s = float(counts[-1] * acceleration["sample_period"][-1])
        times = self._times(acceleration)
        record.duration_s = float(times.max()) + last_s
        missing = sequence[1:] - (sequence[:-1] + counts[:-1])
        record.gaps = [
            Gap(float(times[place + 1]), int(missing[place])) for place in np.flatnonzero(missing)
        ]
        record.envelope = {
            "time_s": times,
            "low": acceleration["low"],
            "high": acceleration["high"],
            "excitation_frequency": acceleration["excitation_frequency"],
        }
        for type_name, place in (
            (METER_TYPE, "meter"),
            (SITE_TYPE, "site"),
            (EXCITER_TYPE, "exciter"),
        ):
            if type_name in whole:
                setattr(
                    record, place, {**whole[type_name], "time_s": self._times(whole[type_name])}
                )
        record.events = [
            Event((stamp - record.start_ns) / NANOSECONDS, what) for stamp, what in sorted(events)
        ]

    def _times(self, columns: Columns) -> NDArray[np.float64]:
        return (_stamps(columns) - self._record.start_ns) / NANOSECONDS


def _stamps(columns: Columns) -> NDArray[np.int64]:
    seconds, nanoseconds = (columns[name].astype(np.int64) for name in STAMP)
    return seconds * NANOSECONDS + nanoseconds
