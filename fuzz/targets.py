# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What is fed: each target takes an item, and says whether it was accepted; whatever else happens is a finding."""

from __future__ import annotations

import hashlib
import json
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from hypothesis import strategies as st
from rosbags.serde import SerdeError

from fuzz import items
from fuzz.items import Change, Clearing, Command, Injection, Travel
from roller_sim_ros.analysis.analyse import analyse
from roller_sim_ros.emulation import Emulator, snapshot
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.faults import Span
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.parameters.file import read_parameters
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.score.limits import Limits, read_limits
from roller_sim_ros.sensors import Choice
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.recover import recover
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode

LONGEST_REFUSAL = 1000
SENSORS = ("mems_50g", "tacho", "odometry", "gnss")


@dataclass(frozen=True)
class Target:
    """Something that takes hostile items.

    Attributes
    ----------
    says : str
        What it is, for the table of results.
    items : strategy
        Of sequences of items, all for one subject.
    feed : callable
        Feeds a sequence; returns for each item whether it was accepted.
    share : float
        Of all items.
    """

    says: str
    items: st.SearchStrategy[Sequence[Any]]
    feed: Callable[[Sequence[Any]], list[bool]]
    share: float


def check_refusal(error: RollerSimError, *words: str) -> None:
    """Check that a refusal is one line that says why.

    Parameters
    ----------
    error : RollerSimError
        The refusal.
    words : str
        At least one of them has to be in it: what the item named.
    """
    text = str(error)
    assert text.strip(), "the refusal says nothing"
    assert "\n" not in text, f"more than one line: {text!r}"
    assert len(text) <= LONGEST_REFUSAL, f"{len(text)} characters: {text[:200]!r}"
    assert not words or any(word in text for word in words), f"does not say what: {text!r}"


def _accepts(act: Callable[[], Any], *words: str) -> bool:
    try:
        act()
    except RollerSimError as error:
        check_refusal(error, *words)
        return False
    return True


def _each(one: Callable[[Any], bool]) -> Callable[[Sequence[Any]], list[bool]]:
    return lambda some: [one(item) for item in some]


def feed_roller(some: Sequence[Any]) -> list[bool]:
    """Feed commands, changes and faults to a running roller, which goes on giving numbers."""
    emulator = Emulator(
        Configuration(), start_ns=0, sensors=[Choice(name) for name in SENSORS], seed=1
    )
    accepted = []
    for item in some:
        accepted.append(_fed(emulator, item))
        emulator.advance(SAMPLES_PER_REVOLUTION)
        block = emulator.block
        assert block is not None
        assert np.isfinite(block.acceleration_vertical).all(), "the motion is no number"
        assert np.isfinite(block.acceleration_horizontal).all(), "the motion is no number"
    return accepted


def _fed(emulator: Emulator, item: Any) -> bool:
    if isinstance(item, Command):
        return _accepts(lambda: emulator.command(**vars(item)), "frequency", "amplitude")
    if isinstance(item, Travel):
        return _accepts(lambda: emulator.command_travel(item.speed_m_s), "speed")
    if isinstance(item, Change):
        return _accepts(lambda: emulator.change(item.values))
    if isinstance(item, Injection):
        return _accepts(
            lambda: emulator.inject(item.fault_id, item.parameters, span=Span(**item.span))
        )
    assert isinstance(item, Clearing)
    return _accepts(lambda: emulator.clear(item.handle), "handle")


def feed_configuration(values: dict[str, Any]) -> bool:
    """Try a set of parameters; what is accepted can be emulated."""
    try:
        configuration = Configuration().changed(values)
        emulator = Emulator(configuration, start_ns=0)
    except RollerSimError as error:
        check_refusal(error)
        return False
    for _ in range(2):
        emulator.advance(SAMPLES_PER_REVOLUTION)
        block = emulator.block
        assert block is not None
        assert np.isfinite(block.acceleration_vertical).all(), "the motion is no number"
    return True


def feed_scenario(text: str) -> bool:
    """Read a scenario; what is read can be begun."""
    path = Path("any.yaml")
    try:
        scenario = parse_scenario(text, path)
    except RollerSimError as error:
        check_refusal(error)
        if not re.match(r"any\.yaml:\d+: \S", str(error)):
            raise AssertionError(f"does not say on which line: {error}") from None
        return False
    start = start_of(scenario)
    start.site.move(0.1, 1.0)
    start.site.soil(start.configuration.soil)
    return True


def feed_parameter_file(text: str) -> bool:
    """Read a parameter file."""
    with _file(text.encode("utf-8", "surrogatepass")) as path:
        return _accepts(lambda: read_parameters(path), str(path))


def feed_command_bytes(data: bytes) -> bool:
    """Decode what came as a command, as the node does."""
    try:
        decode(data, items.COMMAND.type_name)
    except SerdeError:
        return False
    return True


def feed_bag(data: bytes) -> bool:
    """Read a trace, recover it, and analyse it."""
    with _file(data) as path:

        def read() -> None:
            reader = TraceReader(path)
            for _ in reader.messages():
                pass
            reader.damage_text()

        def recovered() -> None:
            target = path.with_name("recovered.mcap")
            account = recover(path, target, overwrite=True)
            reader = TraceReader(target)
            assert sum(1 for _ in reader.messages()) <= account.kept
            assert reader.whole, reader.damage_text()

        _accepts(recovered, str(path.parent))
        _accepts(lambda: analyse(path), str(path))
        return _accepts(read, str(path))


def feed_limits(text: str) -> bool:
    """Read limits for a verdict."""
    with _file(text.encode("utf-8", "surrogatepass")) as path:
        return _accepts(lambda: read_limits(path), str(path))


def feed_state(data: bytes) -> bool:
    """Restore a saved state."""
    return _accepts(lambda: snapshot.restore(data), "state", "restored")


@contextmanager
def _file(data: bytes) -> Iterator[Path]:
    """Yield a file of some bytes in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="roller_sim_fuzz_") as folder:
        path = Path(folder) / "any.mcap"
        path.write_bytes(data)
        yield path


@cache
def small_trace(flush_period_s: float) -> bytes:
    """Return a whole trace of a few revolutions with all topics; a period of 0 makes a chunk of each message."""
    return written(_small_messages(), flush_period_s)


@cache
def _small_messages() -> tuple[Message, ...]:
    emulator = Emulator(Configuration(), start_ns=10**18, sensors=[Choice(it) for it in SENSORS])
    return tuple(message for _ in range(4) for message in emulator.advance(SAMPLES_PER_REVOLUTION))


def written(some: Iterable[Message], flush_period_s: float = 1e3) -> bytes:
    """Return a whole trace of some messages."""
    configuration = Configuration()
    with tempfile.TemporaryDirectory(prefix="roller_sim_fuzz_") as folder:
        path = Path(folder) / "trace.mcap"
        with TraceWriter(
            path, run_metadata(configuration, 0), flush_period_s=flush_period_s
        ) as trace:
            names = register_all(trace, configuration.pacing)
            for message in some:
                name = names[message.topic]
                trace.put(name, message.data, message.stamp_ns, message.stamp_ns)
        return path.read_bytes()


@st.composite
def odd_traces(draw: st.DrawFn) -> bytes:
    """Draw a trace that is damaged, or a whole one with damaged messages."""
    if draw(st.booleans()):
        return draw(items.broken(small_trace(draw(st.sampled_from([0.0, 1e3])))))
    some = list(_small_messages())
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(some) - 1))
        some[at] = some[at]._replace(data=draw(items.broken(some[at].data)))
    return written(some)


@cache
def _state() -> tuple[bytes, bytes, int]:
    """Return header, body and length of the body's text of a saved state."""
    emulator = Emulator(Configuration(), start_ns=0, sensors=[Choice(it) for it in SENSORS])
    emulator.inject("spike")
    emulator.advance(SAMPLES_PER_REVOLUTION)
    data = snapshot.save(emulator)
    end = data.index(b"\n", len(snapshot.MAGIC)) + 1
    return data[:end], data[end:], json.loads(data[len(snapshot.MAGIC) : end])["text_bytes"]


@st.composite
def odd_states(draw: st.DrawFn) -> bytes:
    """Draw a saved state that is damaged, or one that was made up: its checksum is right."""
    header, body, text_bytes = _state()
    if draw(st.integers(0, 3)) == 0:
        return draw(items.broken(header + body))
    text = body[:text_bytes]
    if draw(st.booleans()):
        text = draw(items.broken(text))
    else:
        nodes = json.loads(text)
        for _ in range(draw(st.integers(1, 4))):
            at = draw(st.integers(0, len(nodes) - 1))
            act = draw(st.integers(0, 2))
            if act == 0:
                nodes[at] = nodes[draw(st.integers(0, len(nodes) - 1))]
            elif act == 1:
                nodes[at] = [nodes[at][0], *draw(st.lists(items.scalars | items.trees, max_size=3))]
            else:
                part = draw(st.integers(0, len(nodes[at]) - 1))
                nodes[at] = [*nodes[at][:part], draw(items.trees), *nodes[at][part + 1 :]]
        text = json.dumps(nodes).encode()
    body = text + body[text_bytes:]
    about = {
        **json.loads(header[len(snapshot.MAGIC) :]),
        "text_bytes": len(text),
        "bytes": len(body),
        "sha256": hashlib.sha256(body).hexdigest(),
    }
    return snapshot.MAGIC + json.dumps(about).encode() + b"\n" + body


limit_texts = st.text(max_size=40) | st.dictionaries(
    st.sampled_from([name for name, _, _ in declared(Limits)]) | items.texts,
    items.trees,
    max_size=3,
).map(lambda tree: yaml.safe_dump(tree, allow_unicode=True))


def _several(one: st.SearchStrategy[Any], most: int) -> st.SearchStrategy[Sequence[Any]]:
    return st.lists(one, min_size=1, max_size=most)


@cache
def targets() -> dict[str, Target]:
    """Return all targets by name."""
    mixed: Iterable[st.SearchStrategy[Any]] = (
        items.commands,
        items.travels,
        items.changes,
        items.fault_requests,
    )
    return {
        "commands": Target(
            "commands to a running roller",
            _several(items.commands | items.travels, 10),
            feed_roller,
            0.15,
        ),
        "changes": Target(
            "parameter sets to a running roller", _several(items.changes, 5), feed_roller, 0.1
        ),
        "faults": Target(
            "fault requests to a running roller",
            _several(items.fault_requests, 10),
            feed_roller,
            0.15,
        ),
        "mixed": Target("all of these in a row", _several(st.one_of(*mixed), 15), feed_roller, 0.1),
        "configurations": Target(
            "parameter sets that a roller is to begin with",
            _several(items.parameter_sets, 1),
            _each(feed_configuration),
            0.1,
        ),
        "parameter files": Target(
            "texts read as parameter files",
            _several(items.parameter_texts(), 5),
            _each(feed_parameter_file),
            0.1,
        ),
        "scenarios": Target(
            "texts read as scenarios",
            _several(items.scenario_texts, 3),
            _each(feed_scenario),
            0.14,
        ),
        "limits": Target(
            "texts read as limits of a verdict",
            _several(limit_texts, 5),
            _each(feed_limits),
            0.03,
        ),
        "states": Target(
            "damaged and made-up states to be restored",
            _several(odd_states(), 1),
            _each(feed_state),
            0.03,
        ),
        "command bytes": Target(
            "bytes that came as an exciter command",
            _several(items.command_bytes, 20),
            _each(feed_command_bytes),
            0.08,
        ),
        "bags": Target(
            "damaged traces, read, recovered and analysed",
            _several(odd_traces(), 1),
            _each(feed_bag),
            0.02,
        ),
    }
