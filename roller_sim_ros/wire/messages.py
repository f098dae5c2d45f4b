# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Session results as ROS messages: pure functions from simulation objects to bytes.

Stamps count from the start of the run: `start_ns` (since the epoch) plus the accumulated sample periods;
nothing here asks a clock.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, NamedTuple, Protocol

import numpy as np

from roller_sim_ros.meters import MeterValue, TruthValue
from roller_sim_ros.parameters import Configuration, Value
from roller_sim_ros.sensors import Reading
from roller_sim_ros.session import (
    Applied,
    Block,
    ExciterCommand,
    ExciterStatus,
    Master,
    Refusal,
)
from roller_sim_ros.site import Position
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.types import encode, message_class

FRAME = "drum_axle"
"""Frame of all that is measured at the drum: x forward, z up."""


class Message(NamedTuple):
    """A message ready to be published and recorded.

    Attributes
    ----------
    topic : str
        Name as in the table of topics, not yet resolved in a namespace.
    type_name : str
        As in ``package/msg/Name``.
    data : bytes
        CDR.
    stamp_ns : int
        Time that the message is about, ns since the epoch.
    """

    topic: str
    type_name: str
    data: bytes
    stamp_ns: int


class Level(IntEnum):
    """Levels of a `Diagnostic`."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


@dataclass(frozen=True)
class Diagnostic:
    """One entry of the diagnostics.

    Attributes
    ----------
    name : str
        What it is about.
    level : Level
        How bad it is.
    message : str
        The state in a sentence.
    values : mapping
        Names, units in them, and values.
    hardware_id : str
        The device, here the node.
    """

    name: str
    level: Level = Level.OK
    message: str = ""
    values: Mapping[str, Value] = field(default_factory=dict)
    hardware_id: str = ""


class Timed(Protocol):
    """Samples that are equidistant: a block or a reading."""

    @property
    def time_s(self) -> float:
        """Time of the first sample since the start, s."""
        ...

    @property
    def sample_period_s(self) -> float:
        """Time from sample to sample, s."""
        ...


def sample_stamp(block: Timed, index: int, start_ns: int) -> int:
    """Return the stamp of a sample: the start plus the accumulated sample periods, in ns."""
    return start_ns + round((block.time_s + index * block.sample_period_s) * 1e9)


def drum_acceleration(reading: Reading, start_ns: int) -> Message:
    """Return ``drum/acceleration`` of what the sensor delivered."""
    stamp_ns = sample_stamp(reading, 0, start_ns)
    topic = topics.ACCELERATION
    return _message(
        topic,
        stamp_ns,
        _header(stamp_ns),
        int(reading.kind),
        reading.first_sample,
        reading.sample_period_s,
        reading.excitation_hz,
        reading.eccentric_phase_rad,
        reading.phase_increment_rad,
        reading.vertical,
        reading.horizontal,
        reading.scale,
        reading.raw_vertical,
        reading.raw_horizontal,
        int(reading.clipped.sum()) if len(reading.clipped) else 0,
        reading.sensor_time_s,
    )


def drum_soil_state(block: Block, truth: TruthValue, start_ns: int) -> Message:
    """Return ``truth`` of a block with the true meter values of the last full window.

    Heights go out in single precision over a datum, the surface that the drum meets at the first
    sample: they stay small however deep the drum sinks.
    """
    stamp_ns = sample_stamp(block, 0, start_ns)
    datum = -float(block.height_datum[0])
    single = np.float32
    return _message(
        topics.TRUTH,
        stamp_ns,
        _header(stamp_ns),
        block.first_sample,
        block.sample_period_s,
        block.excitation_hz,
        block.eccentric_phase_rad,
        block.phase_increment_rad,
        block.acceleration_vertical.astype(single),
        block.acceleration_horizontal.astype(single),
        block.soil_force.astype(single),
        (block.drum_height - datum).astype(single),
        block.soil_displacement.astype(single),
        block.plastic_depth.astype(single),
        block.contact_state,
        datum,
        block.shear_modulus_pa,
        block.plastic_parameter_m,
        truth.cmv,
        truth.rmv,
        truth.air_fraction,
        truth.force_ratio_max,
        truth.period,
        truth.blows_per_period,
        int(truth.mode),
    )


def compaction_meter(value: MeterValue, stamp_ns: int) -> Message:
    """Return ``meter``; the stamp is that of the window's last sample."""
    return _message(
        topics.METER,
        stamp_ns,
        _header(stamp_ns),
        value.last_sample,
        value.window_revolutions,
        value.cmv,
        value.rmv,
        value.excitation_frequency,
        value.fundamental_amplitude,
        value.fundamental_phase,
        value.period,
        int(value.mode),
        int(value.status),
    )


def cmv(value: MeterValue, stamp_ns: int) -> Message:
    """Return ``cmv``, the meter's value alone."""
    return _message(topics.CMV, stamp_ns, value.alone(value.cmv))


def further_meters(value: MeterValue, stamp_ns: int) -> list[Message]:
    """Return ``meters/…``, each of the meter's further values alone."""
    return [
        _message(topic, stamp_ns, value.alone(number))
        for topic, number in zip(topics.FURTHER_METERS, value.further.values(), strict=True)
    ]


def exciter_state(
    status: ExciterStatus,
    stamp_ns: int,
    refusal: Refusal = Refusal.NONE,
    refusal_reason: str = "",
) -> Message:
    """Return ``exciter/state``: what runs, what is commanded, and why the last command was refused."""
    return _message(
        topics.EXCITER_STATE,
        stamp_ns,
        _header(stamp_ns),
        status.vibrating,
        status.commanded_frequency_hz,
        status.commanded_amplitude_m,
        status.frequency_hz,
        status.amplitude_m,
        status.force_amplitude_n,
        status.applied_sample,
        int(refusal),
        refusal_reason,
        int(status.master),
    )


def exciter_command(command: ExciterCommand, stamp_ns: int) -> Message:
    """Return ``exciter/command``."""
    return _message(
        topics.EXCITER_COMMAND,
        stamp_ns,
        _header(stamp_ns, frame=""),
        command.vibrate,
        command.frequency_hz,
        command.amplitude_m,
    )


def applied_change(change: Applied, stamp_ns: int) -> Message:
    """Return ``applied``: a command or change that took effect; the stamp is that of its sample."""
    number, text = math.nan, ""
    if isinstance(change.value, bool | str):
        text = _text(change.value)
    else:
        number = float(change.value)
    return _message(
        topics.APPLIED,
        stamp_ns,
        _header(stamp_ns),
        change.sample,
        change.name,
        number,
        text,
        int(change.master),
    )


def run_input(sample: int, kind: str, arguments: str, state: bytes, stamp_ns: int) -> Message:
    """Return ``inputs``: what came into the run before a sample; the stamp is that sample's."""
    return _message(
        topics.INPUTS,
        stamp_ns,
        _header(stamp_ns, frame=""),
        sample,
        kind,
        arguments,
        np.frombuffer(state, dtype=np.uint8),
    )


def site_state(
    block: Block,
    position: Position,
    truth: TruthValue,
    masters: tuple[Master, Master],
    start_ns: int,
) -> Message:
    """Return ``site/state`` of the revolution that ends with a block.

    Parameters
    ----------
    block : Block
        Its last one.
    position : Position
        Where the revolution began.
    truth : TruthValue
        At its end.
    masters : tuple of Master
        Whom exciter and travel obeyed.
    start_ns : int
        Stamp of the first sample of the run.
    """
    stamp_ns = sample_stamp(block, len(block) - 1, start_ns)
    exciter_master, travel_master = masters
    return _message(
        topics.SITE_STATE,
        stamp_ns,
        _header(stamp_ns),
        block.first_sample + len(block) - 1,
        position.chainage_m,
        position.pass_number,
        position.speed_m_s,
        position.finished,
        block.shear_modulus_pa,
        block.plastic_parameter_m,
        truth.cmv,
        int(truth.mode),
        int(exciter_master),
        int(travel_master),
    )


def diagnostic_array(entries: Iterable[Diagnostic], stamp_ns: int) -> Message:
    """Return ``/diagnostics``."""
    statuses = [_status(entry) for entry in entries]
    return _message(topics.DIAGNOSTICS, stamp_ns, _header(stamp_ns, frame=""), statuses)


def machine_facts(configuration: Configuration, stamp_ns: int) -> Message:
    """Return ``machine``: every parameter of machine, exciter, travel, sampling and meter."""
    groups = ("machine", "exciter", "travel", "sampling", "meter")
    return _facts(topics.MACHINE, groups, configuration, stamp_ns)


def soil_facts(configuration: Configuration, stamp_ns: int) -> Message:
    """Return ``soil``: every parameter of the soil and of the half space's model."""
    return _facts(topics.SOIL, ("soil", "half_space"), configuration, stamp_ns)


def clock(time_ns: int) -> Message:
    """Return ``/clock``."""
    return _message(topics.CLOCK, time_ns, _time(time_ns))


def parameter_event(node: str, values: Mapping[str, Value], stamp_ns: int) -> Message:
    """Return ``/parameter_events``: parameters that a node has declared, with their first values."""
    parameter = message_class("rcl_interfaces/msg/Parameter")
    new = [parameter(name, _parameter_value(value)) for name, value in values.items()]
    return _message(topics.PARAMETER_EVENTS, stamp_ns, _time(stamp_ns), node, new, [], [])


def _message(topic: topics.Topic, stamp_ns: int, *fields: Any) -> Message:
    message = message_class(topic.type_name)(*fields)
    return Message(topic.name, topic.type_name, encode(message, topic.type_name), stamp_ns)


def _time(stamp_ns: int) -> Any:
    seconds, nanoseconds = divmod(stamp_ns, 1_000_000_000)
    return message_class("builtin_interfaces/msg/Time")(seconds, nanoseconds)


def _header(stamp_ns: int, frame: str = FRAME) -> Any:
    return message_class("std_msgs/msg/Header")(_time(stamp_ns), frame)


def _status(entry: Diagnostic) -> Any:
    pair = message_class("diagnostic_msgs/msg/KeyValue")
    pairs = [pair(name, _text(value)) for name, value in entry.values.items()]
    return message_class("diagnostic_msgs/msg/DiagnosticStatus")(
        int(entry.level), entry.name, entry.message, entry.hardware_id, pairs
    )


def _facts(
    topic: topics.Topic, groups: Sequence[str], configuration: Configuration, stamp_ns: int
) -> Message:
    values = {
        name: value
        for name, value in configuration.flat().items()
        if name.partition(".")[0] in groups
    }
    status = _status(Diagnostic(name=topic.name, values=values))
    return Message(topic.name, topic.type_name, encode(status, topic.type_name), stamp_ns)


def _text(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def _parameter_value(value: Value) -> Any:
    empty: dict[str, Any] = {
        "bool_value": False,
        "integer_value": 0,
        "double_value": 0.0,
        "string_value": "",
        "byte_array_value": np.zeros(0, np.uint8),
        "bool_array_value": np.zeros(0, np.bool_),
        "integer_array_value": np.zeros(0, np.int64),
        "double_array_value": np.zeros(0, np.float64),
        "string_array_value": [],
    }
    # ParameterType's numbers; bool first, for a bool is an int to Python.
    for kind, number, name in (
        (bool, 1, "bool_value"),
        (int, 2, "integer_value"),
        (float, 3, "double_value"),
        (str, 4, "string_value"),
    ):
        if isinstance(value, kind):
            fields = {"type": number, **empty, name: value}
            return message_class("rcl_interfaces/msg/ParameterValue")(**fields)
    raise TypeError(f"{value!r} is no parameter value")
