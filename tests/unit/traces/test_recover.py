# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Recovery: all that can be read is in a whole file again, and the account of the rest is right."""

from __future__ import annotations

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer
from rosbags.highlevel import AnyReader

from roller_sim_ros.traces.errors import Problem, TraceError
from roller_sim_ros.traces.metadata import RUN
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.recover import recover, recovered_path
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.types import schema

KINDS = ("chunked", "zstd", "lz4", "uncompressed", "unchunked")


@pytest.fixture(scope="session")
def recordings(chunked, foreign):
    return {"chunked": chunked, **foreign}


def plain(messages) -> list[tuple]:
    return [
        (item.topic, item.type_name, item.log_time_ns, item.publish_time_ns, item.data)
        for item in messages
    ]


def read_by_others(path: Path) -> list[tuple]:
    """Messages as mcap reads them by the index, checksums checked; rosbags must agree."""
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        got = [
            (channel.topic, known.name, message.log_time, message.publish_time, message.data)
            for known, channel, message in reader.iter_messages(log_time_order=False)
        ]
        assert reader.get_summary().statistics.message_count == len(got)
        assert reader.get_header().profile == "ros2"
    with AnyReader([path]) as bag:
        seen = sorted((item.topic, time_ns, data) for item, time_ns, data in bag.messages())
    assert seen == sorted((topic, time_ns, data) for topic, _, time_ns, _, data in got)
    return got


def chunk_places(path: Path) -> list[tuple[int, int]]:
    """Where the data of each chunk stands: first byte and the one after the last."""
    places = []
    with path.open("rb") as stream:
        for index in make_reader(stream).get_summary().chunk_indexes:
            end = index.chunk_start_offset + index.chunk_length
            places.append((end - index.compressed_size, end))
    return places


@given(data=st.data())
@settings(deadline=None, max_examples=100)
@pytest.mark.parametrize("kind", KINDS)
def test_cut_anywhere(recordings, tmp_path_factory, kind: str, data) -> None:
    recording = recordings[kind]
    content = recording.path.read_bytes()
    cut = data.draw(st.integers(0, len(content) - 1))
    folder = tmp_path_factory.mktemp("cut")
    path = folder / "a.mcap"
    path.write_bytes(content[:cut])
    try:
        readable = plain(TraceReader(path).messages())
    except TraceError:
        readable = []
    if not readable:
        with pytest.raises(TraceError):
            recover(path)
        assert list(folder.iterdir()) == [path]
        return
    account = recover(path)
    assert path.read_bytes() == content[:cut]
    assert not account.whole
    assert account.target == folder / "a.recovered.mcap"
    assert read_by_others(account.target) == readable
    assert account.kept == len(readable)
    assert sum(topic.missing_messages for topic in account.topics.values()) == 0
    assert not any(topic.sample_gaps for topic in account.topics.values())
    (damage,) = account.damages
    assert damage.offset + damage.length == cut == account.size
    with account.target.open("rb") as stream:
        metadata = {item.name: item.metadata for item in make_reader(stream).iter_metadata()}
    assert metadata == account.metadata == TraceReader(path).metadata
    # The recovered file needs no recovery.
    assert recover(account.target).whole


def test_whole_file_is_left_alone_or_copied(record, tmp_path: Path) -> None:
    recording = record()
    account = recover(recording.path)
    assert account.whole
    assert account.target is None
    assert account.kept == len(recording.written)
    assert list(tmp_path.iterdir()) == [recording.path]
    account = recover(recording.path, tmp_path / "copy.mcap")
    assert account.target == tmp_path / "copy.mcap"
    assert account.target.read_bytes() == recording.path.read_bytes()
    assert account.kept == len(recording.written)
    assert {item.name for item in tmp_path.iterdir()} == {"trace.mcap", "copy.mcap"}


def test_damaged_chunk_is_left_out_and_its_samples_are_named(record) -> None:
    recording = record(flush_period_s=0.0)
    content = bytearray(recording.path.read_bytes())
    index = next(
        number
        for number, item in enumerate(recording.written)
        if item.topic == "/drum/acceleration" and number > 60
    )
    first, end = chunk_places(recording.path)[index]
    content[(first + end) // 2] ^= 0xFF
    recording.path.write_bytes(bytes(content))
    account = recover(recording.path)
    expected = [item for number, item in enumerate(recording.written) if number != index]
    assert read_by_others(account.target) == plain(expected)
    assert account.indexed_losses == 1
    (damage,) = account.damages
    assert damage.offset < first < damage.offset + damage.length
    assert damage.offset + damage.length == end
    assert "a chunk is damaged" in damage.reason
    topic = account.topics["/drum/acceleration"]
    before = sum(item.topic == "/drum/acceleration" for item in recording.written[:index])
    assert topic.sample_gaps == [(before * 16, (before + 1) * 16)]
    assert topic.missing_messages == 1
    assert account.topics["/truth"].sample_gaps == []
    assert account.topics["/truth"].missing_messages == 0


def test_damaged_header_costs_no_message(record) -> None:
    recording = record()
    content = bytearray(recording.path.read_bytes())
    content[8] = 0x81  # the kind of the first record
    recording.path.write_bytes(bytes(content[:-40]))
    account = recover(recording.path)
    assert read_by_others(account.target) == plain(recording.written)


def test_topic_that_is_named_in_a_damaged_chunk_is_known_by_the_summary(foreign, tmp_path) -> None:
    whole = foreign["zstd"]
    with whole.path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    (truth,) = (item.id for item in summary.channels.values() if item.topic == "/truth")
    # Only the first chunk with the topic's messages says what the topic is.
    chunk = next(item for item in summary.chunk_indexes if truth in item.message_index_offsets)
    content = bytearray(whole.path.read_bytes())
    content[chunk.chunk_start_offset + chunk.chunk_length - 10] ^= 0xFF
    path = tmp_path / "a.mcap"
    path.write_bytes(bytes(content))
    account = recover(path)
    got = read_by_others(account.target)
    assert account.orphans == 0
    assert len(got) + account.indexed_losses == len(whole.written)
    assert account.topics["/truth"].kept >= 10
    assert set(got) < set(plain(whole.written))
    # Without the summary the topic is named nowhere.
    path.write_bytes(bytes(content[: chunk_places(whole.path)[-1][1]]))
    cut = recover(path, tmp_path / "b.mcap")
    assert "/truth" not in cut.topics
    assert cut.orphans >= 10
    assert cut.orphans + cut.kept + cut.indexed_losses == len(whole.written)


def test_messages_before_the_end_of_an_uncompressed_chunk_are_saved(foreign, tmp_path) -> None:
    whole = foreign["uncompressed"]
    (before, _), (_, end) = chunk_places(whole.path)[-2:]
    path = tmp_path / "a.mcap"
    path.write_bytes(whole.path.read_bytes()[: end - 1])
    account = recover(path)
    assert read_by_others(account.target) == plain(whole.written)[:-1]
    assert account.salvaged > 0
    path.write_bytes(whole.path.read_bytes()[: before - 1])
    assert recover(path, account.target, overwrite=True).salvaged == 0


def test_dropped_messages_show_as_missing(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with TraceWriter(path, {RUN: {}}, flush_period_s=0.0) as trace:
        trace.register("/x", "std_msgs/msg/Float64", "float64 data\n", "")
        for sequence in (1, 2, 5, 6, 9):
            trace.put("/x", bytes([0, 1, 0, 0]) + bytes(8), sequence, sequence, sequence)
    account = recover(path)
    assert account.topics["/x"].missing_messages == 4
    assert (account.topics["/x"].first_ns, account.topics["/x"].last_ns) == (1, 9)


def test_counters_of_other_recorders_are_not_trusted(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2")
        number = writer.register_schema("std_msgs/msg/Float64", "ros2msg", b"float64 data\n")
        channel = writer.register_channel("/x", "cdr", number)
        for sequence in (1, 100, 7):
            writer.add_message(channel, 1, bytes(12), 1, sequence)
        writer.finish()
    account = recover(path)
    assert account.topics["/x"].missing_messages == 0
    path.write_bytes(path.read_bytes()[:-1])
    target = recover(path).target
    assert [item.sequence for item in TraceReader(target).messages()] == [1, 100, 7]


def test_block_that_is_not_what_its_type_says_is_kept_and_told(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    name = "roller_sim_ros/msg/DrumAcceleration"
    with TraceWriter(path, {RUN: {}}) as trace:
        trace.register("/x", name, schema(name).text, "")
        trace.put("/x", b"no CDR at all", 1, 1)
    account = recover(path)
    assert (account.topics["/x"].kept, account.topics["/x"].odd_messages) == (1, 1)


def test_attachments_and_channel_metadata_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream, compression=CompressionType.NONE)
        writer.start(profile="ros2")
        number = writer.register_schema("std_msgs/msg/Float64", "ros2msg", b"float64 data\n")
        writer.register_channel("/x", "cdr", number, {"offered_qos_profiles": "- a", "k": "v"})
        writer.add_message(1, 1, bytes(12), 1)
        writer.add_attachment(3, 2, "photo", "image/png", b"pixels")
        writer.finish()
    path.write_bytes(path.read_bytes()[:-1])
    target = recover(path).target
    with target.open("rb") as stream:
        reader = make_reader(stream)
        (attachment,) = reader.iter_attachments()
        (channel,) = reader.get_summary().channels.values()
    assert (attachment.name, attachment.data) == ("photo", b"pixels")
    assert (attachment.create_time, attachment.log_time) == (3, 2)
    assert channel.metadata == {"offered_qos_profiles": "- a", "k": "v"}


def test_targets_that_are_refused(record, tmp_path: Path) -> None:
    recording = record()
    broken = recording.path
    broken.write_bytes(broken.read_bytes()[:-10])
    before = broken.read_bytes()
    (tmp_path / "there.mcap").write_text("precious")
    for target, options in (
        (tmp_path / "there.mcap", {}),
        (broken, {}),
        (broken, {"overwrite": True}),
    ):
        with pytest.raises(TraceError, match="there already is such a file") as caught:
            recover(broken, target, **options)
        assert caught.value.problem is Problem.EXISTS
    assert broken.read_bytes() == before
    assert (tmp_path / "there.mcap").read_text() == "precious"
    with pytest.raises(TraceError, match="there is no folder"):
        recover(broken, tmp_path / "no" / "a.mcap")
    with pytest.raises(TraceError, match="not a directory"):
        recover(broken, tmp_path / "there.mcap" / "a.mcap")
    assert recover(broken, tmp_path / "there.mcap", overwrite=True).kept == len(recording.written)
    assert {item.name for item in tmp_path.iterdir()} == {"trace.mcap", "there.mcap"}


def test_full_disk_leaves_no_half_of_a_target(record, tmp_path: Path) -> None:
    recording = record()
    recording.path.write_bytes(recording.path.read_bytes()[:-10])
    program = """
        import resource, sys
        from pathlib import Path
        from roller_sim_ros.traces.errors import TraceError
        from roller_sim_ros.traces.recover import recover

        resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
        try:
            recover(Path(sys.argv[1]))
        except TraceError as error:
            print(error.problem.name, error)
    """
    result = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program), str(recording.path)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert result.stdout.startswith("FULL ")
    assert "no more can be written: file too large" in result.stdout
    assert list(tmp_path.iterdir()) == [recording.path]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "it is empty"),
        (b"no trace at all", "it is no MCAP file"),
        (b"\x89MCAP0\r\n", "hold not one message"),
    ],
)
def test_what_cannot_be_recovered(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "a.mcap"
    path.write_bytes(content)
    with pytest.raises(TraceError, match=words):
        recover(path)
    assert list(tmp_path.iterdir()) == [path]


def test_trace_without_messages_is_a_failure(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    TraceWriter(path, {RUN: {}}).close()
    with pytest.raises(TraceError, match="hold not one message that can be recovered"):
        recover(path)


def test_default_name() -> None:
    assert recovered_path(Path("a/broken.mcap")) == Path("a/broken.recovered.mcap")
