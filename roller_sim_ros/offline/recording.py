# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A run that leaves the trace that the node would: the same topics with the same bytes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.offline.run import Step
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.parameters.file import NODE
from roller_sim_ros.session import Block
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.messages import Message, parameter_event
from roller_sim_ros.wire.topics import TOPICS


@contextmanager
def record_steps(
    configuration: Configuration, path: Path, *, start_ns: int, run_up: bool
) -> Iterator[Step]:
    """Yield what steps a new emulator block by block and records all of its messages.

    They are logged and published at the simulated end of their block, when the node would have them.

    Parameters
    ----------
    configuration : Configuration
        What is emulated; ``pacing`` gives the size of the blocks.
    path : pathlib.Path
        The trace; must not exist yet.
    start_ns : int
        Stamp of the first sample, ns since the epoch.
    run_up : bool
        Start the exciter from standstill.

    Raises
    ------
    ParameterError
        If the configuration has not 128 samples per revolution.
    TraceError
        If the trace cannot be written.
    """
    emulator = Emulator(configuration, start_ns=start_ns, run_up=run_up)
    with record(emulator, path, run_metadata(configuration, start_ns)) as step:
        yield step


@contextmanager
def record(
    emulator: Emulator, path: Path, metadata: Mapping[str, Mapping[str, str]]
) -> Iterator[Step]:
    """Yield what steps an emulator block by block and records all of its messages, from its start.

    A topic is in the trace when the first message of it comes: what nobody publishes here, as diagnostics, is not
    announced as if it had been listened to.

    Parameters
    ----------
    emulator : Emulator
        Not advanced yet; its configuration's ``pacing`` gives the size of the blocks.
    path : pathlib.Path
        The trace; must not exist yet.
    metadata : mapping
        Metadata records by their names.

    Raises
    ------
    TraceError
        If the trace cannot be written.
    """
    configuration, start_ns = emulator.session.configuration, emulator.start_ns
    samples = configuration.pacing.samples_per_message
    known = {topic.name: topic for topic in TOPICS}
    names: dict[str, str] = {}
    with TraceWriter(
        path, metadata, flush_period_s=configuration.recording.flush_period_s
    ) as trace:

        def put(message: Message, time_ns: int) -> None:
            if message.topic not in names:
                topic = known[message.topic]
                names.update(register_all(trace, configuration.pacing, topics=[topic]))
            trace.put(names[message.topic], message.data, time_ns, time_ns)

        put(parameter_event(f"/{NODE}", configuration.flat(), start_ns), start_ns)

        def step() -> Block:
            messages = emulator.advance(samples)
            block = emulator.block
            assert block is not None  # set by advance
            end_s = block.time_s + len(block) * block.sample_period_s
            end_ns = start_ns + round(end_s * 1e9)
            for message in messages:
                put(message, end_ns)
            return block

        yield step
