# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A trace computed again from what came into its runs, and compared with what it holds, byte by byte."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.inputs import Input, InputKind, input_of
from roller_sim_ros.emulation.streams import RUN_TOPICS, StreamHashes
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.offline.alignment import Alignment, Mismatch, Place, Replayed
from roller_sim_ros.offline.difference import Difference, differing_field
from roller_sim_ros.offline.repeat import apply, begun
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.session import Refusal
from roller_sim_ros.traces.reader import TraceMessage, TraceReader
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.types import decode

_POOL = 16 * SAMPLES_PER_REVOLUTION
"""Per-sample messages among which a recorded one is looked for; they are only published while someone listens."""

Progress = Callable[[float], None]


class ReplayError(RollerSimError):
    """A trace cannot be replayed."""


@dataclass
class ReplayedRun:
    """What came of one run of a trace.

    Attributes
    ----------
    first_sample : int
        With which it begins; above 0 where it goes on from a saved state.
    samples : int
        Samples that were compared.
    duration_s : float
        Their time.
    messages : dict
        {topic: messages that were the same}.
    lost, lost_inputs : int
        Messages that the trace does not hold; of those that say what came in, which may make a difference.
    difference : Difference or None
        The first one; nothing after it was looked at.
    hashes : dict
        {topic: SHA-256} of what was recorded, see `StreamHashes`; empty where they were not asked for.
    """

    first_sample: int = 0
    samples: int = 0
    duration_s: float = 0.0
    messages: dict[str, int] = field(default_factory=dict)
    lost: int = 0
    lost_inputs: int = 0
    difference: Difference | None = None
    hashes: dict[str, str] = field(default_factory=dict)


def replay(
    path: Path,
    namespace: str = "",
    progress: Progress = lambda _: None,
    *,
    hashes: bool = False,
) -> Replay:
    """Compute all runs of a trace again, up to the first difference.

    Parameters
    ----------
    path : pathlib.Path
        A trace of the node, of ``roller-sim run`` or of anyone who recorded all topics of the node from its start.
    namespace : str
        Of the roller, where the trace has several; the only one's when left out.
    progress : callable
        Told the share that is done.
    hashes : bool
        Hash what was recorded, too.

    Raises
    ------
    ReplayError
        If the trace lacks what a replay needs.
    RollerSimError
        If it cannot be read, or a run of it not be begun by this version.
    """
    found = Replay(TraceReader(path), namespace, hashes=hashes)
    found.run(progress)
    return found


class Replay:
    """The replay of a trace.

    Parameters
    ----------
    reader : TraceReader
        The trace.
    namespace, hashes
        As in `replay`.

    Attributes
    ----------
    runs : list of ReplayedRun
        In their order.
    """

    def __init__(self, reader: TraceReader, namespace: str = "", *, hashes: bool = False) -> None:
        self.runs: list[ReplayedRun] = []
        self._hash = hashes
        self._reader = reader
        prefix = _prefix(reader, namespace)
        self._names = {
            topic.resolved(prefix): topic
            for topic in RUN_TOPICS
            if topic.resolved(prefix) in reader.topics
        }
        if not self._messages_of(topics.TRUTH):
            raise ReplayError(
                f"{reader.path}: holds no {topics.TRUTH.resolved(prefix)}, which says how the run was cut into blocks"
            )
        self._alignments = {topic.name: Alignment() for topic in RUN_TOPICS}
        self._inputs = Alignment()

    @property
    def difference(self) -> Difference | None:
        """The first difference."""
        return self.runs[-1].difference

    @property
    def damage_text(self) -> str | None:
        """What of the trace could not be read, in one line."""
        return self._reader.damage_text()

    def run(self, progress: Progress) -> None:
        """Go through the trace up to its end or the first difference."""
        run: _Run | None = None
        share = 0.0
        messages = self._reader.messages(self._names)
        for message in messages:
            topic = self._names[message.topic]
            if topic is topics.INPUTS:
                lost = self._inputs.count(message.sequence)
                item = input_of(decode(message.data, message.type_name))
                if item.kind in (InputKind.BEGIN, InputKind.RESTORE):
                    if run is not None and run.end():
                        return
                    # Per-sample messages are there only while someone listened, or asked for them.
                    imu = self._messages_of(topics.IMU) > 0
                    run = _Run(begun(item), self._alignments, imu=imu, hashes=self._hash)
                    self.runs.append(run.result)
                elif run is not None:
                    run.inputs.append(item)
                    run.result.lost_inputs += lost
            elif run is not None:
                if run.take(topic, message):
                    run.result.lost_inputs += self._lost_inputs(messages)
                    run.end()
                    return
            elif topic is topics.TRUTH:
                break
            if self._reader.position / self._reader.size >= share + 0.01:
                share = self._reader.position / self._reader.size
                progress(share)
        if run is None:
            raise ReplayError(
                f"{self._reader.path}: does not hold the beginning of a run on "
                f"{topics.INPUTS.name}, from which it could be computed again"
            )
        run.end()
        progress(1.0)

    def _lost_inputs(self, messages: Iterator[TraceMessage]) -> int:
        """Return how many inputs are lost before the next one that is there."""
        for message in messages:
            if self._names[message.topic] is topics.INPUTS:
                return self._inputs.count(message.sequence)
        return 0

    def _messages_of(self, topic: topics.Topic) -> int:
        """Return how many messages of a topic the trace holds."""
        return sum(
            self._reader.topics[name].messages
            for name, known in self._names.items()
            if known is topic
        )


class _Run:
    """One run: recorded messages come in, blocks are computed, both are compared."""

    def __init__(
        self, emulator: Emulator, alignments: dict[str, Alignment], *, imu: bool, hashes: bool
    ) -> None:
        self.inputs: deque[Input] = deque()
        self.result = ReplayedRun(first_sample=emulator.session.next_sample)
        self._emulator = emulator
        self._alignments = alignments
        self._before = {name: (it.compared, it.lost) for name, it in alignments.items()}
        self._imu: deque[Replayed] | None = deque(maxlen=_POOL) if imu else None
        self._imu_compared = 0
        self._start_s = self._place.time_s
        self._hashes = StreamHashes(emulator.start_ns) if hashes else None

    def take(self, topic: topics.Topic, message: TraceMessage) -> bool:
        """Take the next recorded message and return whether something differs."""
        if topic is topics.EXCITER_STATE and _is_of_no_run(message):
            self._alignments[topic.name].count(message.sequence)
            return False
        if self._hashes is not None:
            self._hashes.feed([message])
        if topic is topics.IMU:
            return self._take_imu(message)
        if topic is topics.TRUTH and self._go_on(message):
            return True
        self._alignments[topic.name].record(message.data, message.sequence)
        return self._differs(topic.name)

    def end(self) -> bool:
        """End the run, and return whether something differs."""
        # Where something differs, the rest was not looked at.
        for topic in RUN_TOPICS if self.result.difference is None else ():
            mismatch = self._alignments[topic.name].end_run()
            # Where the trace was cut off, samples may have come whose block did not.
            if mismatch is not None and topic is not topics.ACCELERATION:
                self._note(topic.name, self._place, "", "a message", "none")
                break
        counts = {
            name: (it.compared - self._before[name][0], it.lost - self._before[name][1])
            for name, it in self._alignments.items()
        }
        result = self.result
        result.messages = {name: compared for name, (compared, _) in counts.items() if compared}
        if self._imu_compared:
            result.messages[topics.IMU.name] = self._imu_compared
        result.lost = sum(lost for _, lost in counts.values())
        result.samples = self._place.sample - result.first_sample
        result.duration_s = self._place.time_s - self._start_s
        if self._hashes is not None:
            result.hashes = self._hashes.digests()
        return result.difference is not None

    @property
    def _place(self) -> Place:
        """Where the next block begins."""
        block = self._emulator.block
        if block is None:
            return Place(0, 0.0)
        return Place(
            block.first_sample + len(block), block.time_s + len(block) * block.sample_period_s
        )

    def _go_on(self, message: TraceMessage) -> bool:
        """Compute up to the end of a block that was recorded, and return whether something differs."""
        block = decode(message.data, message.type_name)
        first, place = int(block.sequence), self._place
        if first < place.sample:
            return self._note(topics.TRUTH.name, place, "sequence", str(first), str(place.sample))
        size = self._emulator.session.configuration.pacing.samples_per_message
        while (here := self._place.sample) < first:
            # Blocks that were lost were as long as blocks are, but for where something came in.
            end = min(first, here + size - here % size)
            if self.inputs and self.inputs[0].sample > here:
                end = min(end, self.inputs[0].sample)
            if self._advance(end - here):
                return True
        return self._advance(len(block.vertical))

    def _advance(self, samples: int) -> bool:
        """Compute the next block and return whether something differs."""
        emulator, place = self._emulator, self._place
        while self.inputs and self.inputs[0].sample <= place.sample:
            item = self.inputs.popleft()
            try:
                apply(item, emulator)
            except RollerSimError as error:
                told = (item.kind.value, "accepted", f"refused: {error}")
                return self._note(topics.INPUTS.name, place, *told)
        try:
            out = emulator.advance(samples)
        except RollerSimError as error:
            return self._note(topics.TRUTH.name, place, "", f"{samples} samples", str(error))
        for message in out:
            if message.topic == topics.INPUTS.name:
                continue
            self._alignments[message.topic].replay(Replayed(message, place))
            if self._differs(message.topic):
                return True
        if self._imu is not None:
            self._imu.extend(Replayed(it, place) for it in emulator.imu_messages())
        return False

    def _take_imu(self, message: TraceMessage) -> bool:
        """Look for a recorded per-sample message among those computed last."""
        pool = self._imu
        assert pool is not None  # for there are such messages
        for index, item in enumerate(pool):
            if item.message.data == message.data:
                for _ in range(index + 1):
                    pool.popleft()
                self._imu_compared += 1
                return False
        stamp = slice(4, 12)
        alike = (it for it in pool if it.message.data[stamp] == message.data[stamp])
        return self._note_mismatch(topics.IMU.name, Mismatch(message.data, next(alike, None)))

    def _differs(self, topic: str) -> bool:
        mismatch = self._alignments[topic].mismatch()
        return mismatch is not None and self._note_mismatch(topic, mismatch)

    def _note_mismatch(self, topic: str, mismatch: Mismatch) -> bool:
        replayed = mismatch.replayed
        if replayed is None:
            return self._note(topic, self._place, "", "a message", "none")
        message, (sample, time_s) = replayed
        name, one, other, place = differing_field(
            mismatch.recorded, message.data, message.type_name
        )
        return self._note(topic, Place(sample + place, time_s), name, one, other)

    def _note(self, topic: str, place: Place, name: str, recorded: str, replayed: str) -> bool:
        """Note the first difference."""
        if self.result.difference is None:
            self.result.difference = Difference(
                topic, place.sample, place.time_s, name, recorded, replayed
            )
        return True


def _is_of_no_run(message: TraceMessage) -> bool:
    """Whether an ``exciter/state`` is the node's, which was not active."""
    state = decode(message.data, message.type_name)
    return bool(state.refusal_code == Refusal.NOT_ACTIVE)


def _prefix(reader: TraceReader, namespace: str) -> str:
    """Return the namespace of the roller whose runs are wanted.

    Raises
    ------
    ReplayError
        If there is none, or several.
    """
    end = f"/{topics.INPUTS.name}"
    found = [
        name[: -len(end)] or "/"
        for name, info in reader.topics.items()
        if info.type_name == topics.INPUTS.type_name and name.endswith(end)
    ]
    if not found:
        raise ReplayError(
            f"{reader.path}: holds no {topics.INPUTS.name}, which says what came into the run; recorded by an older "
            "version, or without that topic"
        )
    wanted = f"/{namespace.strip('/')}"
    if not namespace and len(found) == 1:
        return found[0]
    if wanted in found and namespace:
        return wanted
    raise ReplayError(
        f"{reader.path}: holds rollers in {', '.join(found)}; give one of these with --namespace"
    )
