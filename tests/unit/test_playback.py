# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a trace is played, when, and what is refused before anything is published."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from roller_sim_ros.commands import play
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.traces.errors import TraceError
from roller_sim_ros.traces.playback import check_definition, select_topics, timeline
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.types import TypeUnknownError, schema

MILLISECOND = 1_000_000
START_NS = 1_700_000_000_000_000_000
FLOAT = "std_msgs/msg/Float64"
COMMAND = "roller_sim_ros/msg/ExciterCommand"

Write = Callable[..., TraceReader]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write a trace of (topic, log time, publish time) in ms since the start; return its reader."""

    def written(
        messages: list[tuple[str, float, float]], types: dict[str, tuple[str, str]] | None = None
    ) -> TraceReader:
        path = tmp_path / "trace.mcap"
        with TraceWriter(path, {}, overwrite=True) as trace:
            for topic in dict.fromkeys([*(item[0] for item in messages), *(types or {})]):
                name, text = (types or {}).get(topic, (FLOAT, schema(FLOAT).text))
                trace.register(topic, name, text, "")
            for topic, log, publish in messages:
                times = [START_NS + round(at * MILLISECOND) for at in (log, publish)]
                trace.put(topic, bytes(12), times[0], times[1] if publish >= 0 else 0)
        return TraceReader(path)

    return written


def names(reader: TraceReader, *wanted: str) -> list[str]:
    return [topic.name for topic in select_topics(reader, wanted)]


def test_all_with_messages_is_played_but_what_steers(write: Write) -> None:
    reader = write(
        [("/a", 0, 0), ("/b/a", 0, 0), ("/exciter/command", 0, 0)],
        {
            "/silent": (FLOAT, schema(FLOAT).text),
            "/exciter/command": (COMMAND, schema(COMMAND).text),
        },
    )
    assert names(reader) == ["/a", "/b/a"]
    assert names(reader, "/exciter/command") == ["/exciter/command"]
    assert names(reader, "/a") == ["/a"]
    assert names(reader, "a") == ["/a", "/b/a"]
    assert names(reader, "b/a", "a") == ["/b/a", "/a"]


@pytest.mark.parametrize("wanted", ["/c", "/silent", "A", ""])
def test_a_topic_without_messages_is_refused_with_those_that_have_some(
    write: Write, wanted: str
) -> None:
    reader = write([("/a", 0, 0)], {"/silent": (FLOAT, schema(FLOAT).text)})
    with pytest.raises(RollerSimError) as caught:
        select_topics(reader, [wanted])
    expected = f"{reader.path}: no messages on a topic {wanted}; topics with messages: /a"
    assert str(caught.value) == expected


def test_nothing_to_be_played_is_refused(write: Write) -> None:
    reader = write([("/c", 0, 0)], {"/c": (COMMAND, schema(COMMAND).text)})
    with pytest.raises(RollerSimError, match="holds no messages that could be played"):
        select_topics(reader)


def dues(reader: TraceReader, *wanted: str, loop: bool = False, count: int = 99) -> list[float]:
    source = timeline(reader, select_topics(reader, wanted), loop=loop)
    return [round(1e3 * due_s, 6) for (due_s, _), _ in zip(source, range(count), strict=False)]


def test_messages_are_due_as_they_were_published(write: Write) -> None:
    reader = write([("/a", 5, 0), ("/b", 6, 4), ("/a", 30, 20)])
    assert dues(reader) == [0.0, 4.0, 20.0]
    assert dues(reader, "/b") == [0.0]


def test_without_a_publish_time_the_log_time_counts(write: Write) -> None:
    assert dues(write([("/a", 5, -1), ("/a", 8, -1)])) == [0.0, 3.0]


def test_the_order_of_the_recording_stays(write: Write) -> None:
    # Published late, recorded early: it does not wait for its time and nothing overtakes it.
    assert dues(write([("/a", 0, 0), ("/b", 10, 9), ("/a", 11, 2), ("/a", 12, 12)])) == [
        0.0,
        9.0,
        9.0,
        12.0,
    ]


def test_a_loop_begins_anew_where_the_last_message_was(write: Write) -> None:
    reader = write([("/a", 0, 0), ("/a", 150, 150)])
    assert dues(reader, loop=True, count=5) == [0.0, 150.0, 150.0, 300.0, 300.0]
    # A single message does not flood the network.
    assert dues(write([("/a", 0, 0)]), loop=True, count=3) == [0.0, 100.0, 200.0]


def test_a_type_that_changed_since_is_refused(write: Write) -> None:
    reader = write([("/a", 0, 0)], {"/a": (FLOAT, "float32 data\n")})
    with pytest.raises(
        RollerSimError, match="/a: the type std_msgs/msg/Float64 in the trace is not"
    ):
        check_definition(reader.topics["/a"])


def test_comments_in_a_definition_do_not_matter(write: Write) -> None:
    reader = write([("/a", 0, 0)], {"/a": (FLOAT, "# of whatever\nfloat64 data # in its unit\n")})
    check_definition(reader.topics["/a"])


def test_a_type_that_nobody_knows_is_refused(write: Write) -> None:
    reader = write([("/a", 0, 0)], {"/a": ("my_meter/msg/Value", "float64 data\n")})
    with pytest.raises(TypeUnknownError, match="my_meter/msg/Value"):
        check_definition(reader.topics["/a"])


def test_a_type_that_is_not_installed_is_refused_in_one_line_with_its_topic(write: Write) -> None:
    reader = write([("/a", 0, 0)], {"/a": ("my_meter/msg/Value", "float64 data\n")})
    with pytest.raises(RollerSimError) as caught:
        play.main([str(reader.path)])
    message = str(caught.value)
    assert message.startswith("topic /a: message type my_meter/msg/Value: ")
    assert message.endswith("or leave the topic out with --topics")
    assert "\n" not in message


@pytest.mark.parametrize(
    ("data", "reason"),
    [(None, "there is no such file"), (b"", "is empty"), (b"no trace at all", "no MCAP file")],
)
def test_a_file_that_is_no_trace_is_refused(
    data: bytes | None, reason: str, tmp_path: Path
) -> None:
    path = tmp_path / "trace.mcap"
    if data is not None:
        path.write_bytes(data)
    with pytest.raises(TraceError, match=reason):
        play.main([str(path)])


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--rate", "0"], "0 is not a positive number"),
        (["--rate", "nan"], "nan is not a positive number"),
        (["--rate", "inf"], "inf is not a positive number"),
        (["--delay", "-1"], "-1 is not a number from 0 to 3600"),
        (["--subscribers", "-1"], "-1 is less than 0"),
        ([], "the following arguments are required: TRACE"),
    ],
)
def test_wrong_arguments_are_refused(
    arguments: list[str], reason: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        play.main([*arguments, *(["trace.mcap"] if arguments else [])])
    assert caught.value.code == 2
    assert reason in capsys.readouterr().err


def test_ros_arguments_that_ros_refuses(write: Write) -> None:
    reader = write([("/a", 0, 0)])
    with pytest.raises(RollerSimError, match="ROS 2 refuses its arguments"):
        play.main([str(reader.path), "--ros-args", "--not-one"])


def test_a_damaged_trace_is_played_as_far_as_it_goes_and_then_said_to_be_damaged(
    write: Write, capsys: pytest.CaptureFixture[str]
) -> None:
    reader = write([("/a", 0, 0), ("/a", 1, 1)])
    whole = reader.path.read_bytes()
    reader.path.write_bytes(whole[:-30])
    with pytest.raises(RollerSimError, match="roller-sim recover"):
        play.main([str(reader.path), "--delay", "0"])
    assert "played 2 messages" in capsys.readouterr().out
