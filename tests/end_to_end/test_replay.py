# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim replay``: identical for every trace that was not touched, and the very place where one was."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.snapshot import restore, save
from roller_sim_ros.emulation.streams import StreamHashes
from roller_sim_ros.faults import Span
from roller_sim_ros.offline.recording import record
from roller_sim_ros.offline.replay import Replay, replay
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.sensors import Choice
from roller_sim_ros.session import CommandRefused, Refusal
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.reader import TraceMessage, TraceReader
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.messages import Message, exciter_state
from roller_sim_ros.wire.topics import TOPICS
from roller_sim_ros.wire.types import decode, encode

TEXT = """
lane: {length_m: 9}
travel: {speed_m_s: 3, passes: 2}
ground:
  preset: paper-soft
  features: [{kind: random_field, coefficient_of_variation: 0.3, correlation_length_m: 1.0}]
exciter: {run_up: true}
sensors: [{name: mems_50g}, {name: tacho, parameters: {jitter_s: 1.0e-5}}, {name: odometry}, {name: gnss}]
faults: [{id: spike, from_m: 3, to_m: 6}, {id: duplicate, from_revolution: 20}]
parameters: {half_space.model: two-pole, sampling.floor_hz: 5.0}
seed: 4
"""
START_NS = 1_700_000_000_123_456_789
FILES = {topic.name: topic for topic in TOPICS}

Edit = Callable[[int, TraceMessage], TraceMessage | None]


def scenario_emulator() -> Emulator:
    start = start_of(parse_scenario(TEXT, Path("test.yaml")))
    return Emulator(start_ns=START_NS, **start._asdict())


def plain_emulator(**values: Any) -> Emulator:
    configuration = Configuration().changed(
        {"half_space.model": "two-pole", "pacing.samples_per_message": 32, **values}
    )
    return Emulator(configuration, start_ns=START_NS, sensors=(Choice("mems_10g"),), seed=9)


def drive(emulator: Emulator, blocks: int = 400) -> Iterator[int]:
    """Let everything come in that can, each between two blocks, also in the middle of revolutions."""
    for block in range(blocks):
        if block == 37:
            emulator.command(vibrate=True, frequency_hz=31.0, amplitude_m=1.3e-3)
            emulator.command_travel(-0.7)
        if block == 61:
            with suppress(CommandRefused):
                emulator.command(vibrate=True, frequency_hz=-1.0, amplitude_m=0.1)
        if block == 90:
            emulator.change({"exciter.amplitude_rate_m_per_s": 3e-3, "exciter.frequency_hz": 29})
        if block == 121:
            emulator.inject("bias_step", {"bias_m_s2": 2}, span=Span(duration_s=0.3))
        if block == 122:
            handle = emulator.inject("frozen_command_link")
        if block == 150:
            emulator.command(vibrate=False, frequency_hz=20.0, amplitude_m=1e-3)
        if block == 160:
            emulator.clear(handle)
        if block == 170:
            emulator.inject("frequency_droop")
        if block == 200:
            emulator.release()
        if block == 222:
            emulator.clear()
            emulator.refuse(Refusal.TIMEOUT, "no command for a while")
        yield block


def write(path: Path, emulator: Emulator, blocks: int = 400) -> Path:
    configuration = emulator.session.configuration
    with record(emulator, path, run_metadata(configuration, START_NS)) as step:
        for _ in drive(emulator, blocks):
            step()
    return path


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("trace") / "trace.mcap", scenario_emulator())


def edited(source: Path, target: Path, edit: Edit) -> Path:
    """Write a trace anew with some of its messages changed or, as a recorder does that loses them, left out."""
    reader = TraceReader(source)
    with TraceWriter(target, reader.metadata) as writer:
        for info in reader.topics.values():
            writer.register(info.name, info.type_name, info.schema_text, info.offered_qos_profiles)
        for index, message in enumerate(reader.messages()):
            changed = edit(index, message)
            if changed is not None:
                writer.put(
                    changed.topic,
                    changed.data,
                    changed.log_time_ns,
                    changed.publish_time_ns,
                    changed.sequence,
                )
    return target


def told(capsys: pytest.CaptureFixture[str], *arguments: object) -> tuple[int, str]:
    capsys.readouterr()
    code = commands.main(["replay", *map(str, arguments)])
    output = capsys.readouterr()
    return code, output.out + output.err


def test_a_trace_of_everything_is_identical(
    trace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, text = told(capsys, trace)
    assert code == 0
    assert text.startswith("identical\n6400 samples, ")
    assert "not in the trace" not in text
    found = replay(trace)
    counts = {name: info.messages for name, info in TraceReader(trace).topics.items()}
    left_out = {"/inputs", "/parameter_events"}
    assert {f"/{name}": count for name, count in found.runs[0].messages.items()} == {
        name: count for name, count in counts.items() if name not in left_out
    }
    assert {"/tacho", "/odom", "/fix", "/applied", "/faults", "/site/state"} <= set(counts)
    kinds = [
        decode(item.data, item.type_name).kind for item in TraceReader(trace).messages(["/inputs"])
    ]
    assert set(kinds) == {
        *("begin", "command", "travel", "refuse", "change", "inject", "clear", "release")
    }


@pytest.mark.parametrize("size", [1, 16, 128])
def test_any_size_of_blocks_is_identical_and_has_the_same_hashes(size: int, tmp_path: Path) -> None:
    found = []
    for samples in (64, size):
        emulator = plain_emulator(**{"pacing.samples_per_message": samples})
        path = tmp_path / f"{samples}.mcap"
        with record(emulator, path, run_metadata(emulator.session.configuration, 0)) as step:
            for _ in range(20 * 128 // samples):
                step()
        result = replay(path, hashes=True)
        assert result.difference is None
        assert result.runs[0].samples == 20 * 128
        found.append(result.runs[0].hashes)
    assert found[0] == found[1]


def test_the_command_run_leaves_what_can_be_replayed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, arguments in {
        "plain": ["--revolutions", "50", "--half-space", "rational", "--run-up"],
        "scenario": ["sensor_failure_campaign", "--revolutions", "130", "--run-up"],
    }.items():
        path = tmp_path / f"{name}.mcap"
        assert commands.main(["run", *arguments, "--record", str(path)]) == 0
        code, text = told(capsys, path)
        assert (code, text.splitlines()[0]) == (0, "identical")
    assert "roller_sim_ros.scenario" in TraceReader(path).metadata


def test_hashes_are_those_of_the_run(trace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    emulator, hashes = scenario_emulator(), StreamHashes(START_NS)
    for _ in drive(emulator):
        hashes.feed(emulator.advance(16))
    lines = told(capsys, "--hashes", trace)[1].splitlines()[2:]
    printed = {topic: digest for digest, topic in (line.split() for line in lines)}
    assert printed == {f"/{topic}": digest for topic, digest in hashes.digests().items()}


def with_sample(field: str, index: int, value: float) -> Callable[[Any], None]:
    def change(message: Any) -> None:
        samples = getattr(message, field).copy()
        samples[index] = value
        setattr(message, field, samples)

    return change


CHANGED: dict[str, tuple[Callable[[Any], None], str, str]] = {
    "drum/acceleration": (with_sample("vertical", 5, 7.5), "vertical[5]", "7.5"),
    "truth": (with_sample("soil_force", 3, -1.0), "soil_force[3]", "-1.0"),
    "meter": (lambda it: setattr(it, "cmv", 12.25), "cmv", "12.25"),
    "cmv": (lambda it: setattr(it, "data", 12.25), "data", "12.25"),
    "meters/omega": (lambda it: setattr(it, "data", 12.25), "data", "12.25"),
    "exciter/state": (lambda it: setattr(it, "frequency", 1.5), "frequency", "1.5"),
    "site/state": (lambda it: setattr(it, "pass_number", 9), "pass_number", "9"),
    "tacho": (lambda it: setattr(it.header.stamp, "nanosec", 5), "header.stamp.nanosec", "5"),
    "odom": (lambda it: setattr(it.twist.twist.linear, "x", 1.25), "twist.twist.linear.x", "1.25"),
    "fix": (lambda it: setattr(it, "latitude", 1.25), "latitude", "1.25"),
    "applied": (lambda it: setattr(it, "name", "soil.x"), "name", "'soil.x'"),
    "faults": (lambda it: setattr(it.faults[0], "handle", 77), "faults[0].handle", "77"),
    "soil": (lambda it: setattr(it.values[0], "value", "1"), "values[0].value", "'1'"),
}


def changed(trace: Path, target: Path, topic: str) -> tuple[Path, int]:
    """Write a trace with one value changed; return it and the first sample of that value's block."""
    change, _, _ = CHANGED[topic]
    wanted = 1 if topic == "soil" else 3
    count, sample = 0, -1

    def edit(_: int, message: TraceMessage) -> TraceMessage:
        nonlocal count, sample
        if message.topic == "/truth" and count < wanted:
            sample = int(decode(message.data, message.type_name).sequence)
        count += message.topic == f"/{topic}"
        if message.topic != f"/{topic}" or count != wanted:
            return message
        content = decode(message.data, message.type_name)
        change(content)
        return message._replace(data=encode(content, message.type_name))

    return edited(trace, target, edit), sample


@pytest.mark.parametrize("topic", CHANGED)
def test_one_changed_value_is_found(topic: str, trace: Path, tmp_path: Path) -> None:
    path, sample = changed(trace, tmp_path / "changed.mcap", topic)
    difference = replay(path).difference
    assert difference is not None
    assert (difference.topic, difference.field, difference.recorded) == (topic, *CHANGED[topic][1:])
    assert difference.replayed != difference.recorded
    assert 0 <= difference.sample - sample <= 16 + 5
    # It runs up: the first revolutions come at the floor's rate, 5 Hz.
    assert difference.sample // 16 * 16 / 3840.0 <= difference.time_s <= difference.sample / 640.0


def test_the_command_says_where_it_differs(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, _ = changed(trace, tmp_path / "changed.mcap", "site/state")
    code, text = told(capsys, path)
    first, counted, last = text.splitlines()
    assert (code, first) == (1, "not identical")
    assert counted.startswith("384 samples, ")
    assert last.startswith("first differs: site/state, sample 368 (block of ")
    assert last.endswith(" pass_number: recorded 9, replayed 1")


def test_another_input_is_another_run(trace: Path, tmp_path: Path) -> None:
    def edit(_: int, message: TraceMessage) -> TraceMessage:
        if message.topic != "/inputs":
            return message
        content = decode(message.data, message.type_name)
        if content.kind == "command":
            arguments = json.loads(content.arguments)
            content.arguments = json.dumps({**arguments, "amplitude_m": 2**-10})
        return message._replace(data=encode(content, message.type_name))

    difference = replay(edited(trace, tmp_path / "changed.mcap", edit)).difference
    assert difference is not None
    assert (difference.topic, difference.field) == ("applied", "value")
    assert difference.recorded == "0.0013"
    assert difference.replayed == str(2**-10)


def test_lost_messages_are_counted_and_the_rest_compared(trace: Path, tmp_path: Path) -> None:
    random = np.random.default_rng(2)
    lost = 0

    def edit(_: int, message: TraceMessage) -> TraceMessage | None:
        nonlocal lost
        keep = message.topic in ("/inputs", "/parameter_events") or random.random() > 0.1
        lost += not keep
        return message if keep else None

    found = replay(edited(trace, tmp_path / "lossy.mcap", edit))
    assert found.difference is None
    # What is lost after the last message of a topic is not told by a counter, but is missing all the same.
    assert found.runs[0].lost == lost
    assert lost > 100


def test_lost_inputs_are_told(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def edit(_: int, message: TraceMessage) -> TraceMessage | None:
        kind = message.topic == "/inputs" and decode(message.data, message.type_name).kind
        return None if kind in ("command", "travel") else message

    code, text = told(capsys, edited(trace, tmp_path / "lossy.mcap", edit))
    assert code == 1
    assert "; of what came in, 2 are not in it: a difference may come of that" in text
    assert "first differs: " in text


def test_a_gap_of_all_topics_is_gone_over(trace: Path, tmp_path: Path) -> None:
    found = replay(
        edited(
            trace,
            tmp_path / "gap.mcap",
            lambda index, it: None if 700 < index < 900 and it.topic != "/inputs" else it,
        )
    )
    assert found.difference is None
    assert found.runs[0].samples == 6400
    assert found.runs[0].lost > 150


@pytest.mark.parametrize("share", [0.4, 0.77])
def test_a_trace_that_was_cut_off_is_identical_as_far_as_it_goes(
    share: float, trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, recovered = tmp_path / "cut.mcap", tmp_path / "recovered.mcap"
    data = trace.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    code, text = told(capsys, path)
    assert (code, text.splitlines()[0]) == (0, "identical")
    assert "roller-sim recover" in text
    assert commands.main(["recover", str(path), "-o", str(recovered)]) == 0
    assert told(capsys, recovered)[0] == 0
    assert 1000 < replay(recovered).runs[0].samples < 6400


def test_runs_one_after_the_other_and_states_in_between(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a node records that is reset, and goes on from a saved state."""
    path = tmp_path / "runs.mcap"
    first = plain_emulator()
    idle = first.session.exciter_status()
    with TraceWriter(path, {}) as trace:
        names = register_all(trace, first.session.configuration.pacing, "north")

        def put(messages: list[Message]) -> None:
            for message in messages:
                trace.put(names[message.topic], message.data, message.stamp_ns, message.stamp_ns)

        for _ in drive(first, 100):
            put(first.advance(32))
            put(first.imu_messages())
        state = save(first)
        put([exciter_state(idle, START_NS, Refusal.NOT_ACTIVE, "not active")])
        for emulator in (plain_emulator(), restore(state, told=True)):
            for block in range(60):
                put(emulator.advance(8 if block == 0 else 24 if block == 1 else 32))
    code, text = told(capsys, path)
    assert code == 0
    assert text.splitlines()[0] == "identical"
    assert len(text.splitlines()) == 4
    assert "run 3: 1888 samples from sample 3200 on" in text
    assert replay(path, "/north").runs[0].messages["drum/imu"] > 3000
    with pytest.raises(Exception, match="rollers in /north; give one"):
        replay(path, "south")


def without(topic: str) -> Edit:
    return lambda _, it: None if it.topic == topic else it


def foreign(_: int, message: TraceMessage) -> TraceMessage:
    """Return a message as recorders write it that do not count."""
    return message._replace(sequence=0)


def with_input(**fields: str) -> Edit:
    def edit(_: int, message: TraceMessage) -> TraceMessage:
        if message.topic != "/inputs":
            return message
        content = decode(message.data, message.type_name)
        for name, value in fields.items():
            setattr(content, name, value)
        return message._replace(data=encode(content, message.type_name))

    return edit


def with_begin(**values: Any) -> Edit:
    def edit(_: int, message: TraceMessage) -> TraceMessage:
        if message.topic != "/inputs":
            return message
        content = decode(message.data, message.type_name)
        if content.kind == "begin":
            content.arguments = json.dumps({**json.loads(content.arguments), **values})
        return message._replace(data=encode(content, message.type_name))

    return edit


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (without("/inputs"), "does not hold the beginning of a run on inputs"),
        (without("/truth"), "holds no /truth"),
        (with_input(kind="dance"), "the input 'dance' at sample 0 is not understood"),
        (with_input(arguments="{"), "the input 'begin' at sample 0 is not understood"),
        (with_input(arguments="[]"), "has no arguments"),
        (with_input(arguments="{}"), "is not understood by this version: KeyError, "),
        (with_begin(start_ns=2**63), "start_ns is 9223372036854775808"),
        (with_begin(start_ns="now"), "start_ns is 'now'"),
        (with_begin(parameters=[]), "AttributeError"),
        (with_begin(parameters={"soil.x": 1}), "soil.x = 1: there is no such parameter"),
        (with_begin(sensors=[["camera", {}]]), "there is no such sensor"),
        (with_begin(sensors=3), "TypeError"),
        (with_begin(seed=-1), "ValueError"),
        (with_begin(scenario="lane: {}"), "the trace's scenario:1: lane: length_m is missing"),
        (with_input(kind="restore"), "is no saved state"),
    ],
)
def test_what_cannot_be_replayed_is_told_in_one_line(
    edit: Edit, message: str, trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = edited(trace, tmp_path / "bad.mcap", edit)
    code, text = told(capsys, path)
    assert code == 1
    assert message in text
    assert text.startswith("roller-sim replay: error: ")
    assert text.count("\n") == 1


def test_a_foreign_recording_is_compared_in_its_order(trace: Path, tmp_path: Path) -> None:
    assert replay(edited(trace, tmp_path / "foreign.mcap", foreign)).difference is None


def test_other_files_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "there is no such file" in told(capsys, tmp_path / "none.mcap")[1]
    path = tmp_path / "other.mcap"
    with TraceWriter(path, {}) as writer:
        register_all(writer, Configuration().pacing, topics=[FILES["cmv"]])
    assert "holds no inputs" in told(capsys, path)[1]
    with TraceWriter(tmp_path / "few.mcap", {}) as writer:
        register_all(writer, Configuration().pacing, topics=[FILES["inputs"]])
    assert "holds no /truth" in told(capsys, tmp_path / "few.mcap")[1]


def test_a_run_of_parts_from_no_file_says_so(tmp_path: Path) -> None:
    start = start_of(parse_scenario(TEXT, Path("test.yaml")))._replace(scenario="")
    emulator = Emulator(start_ns=START_NS, **start._asdict())
    path = write(tmp_path / "parts.mcap", emulator, 3)
    with pytest.raises(Exception, match="made with site and programme and faults of no scenario"):
        replay(path)
    assert Replay(TraceReader(path)).runs == []
