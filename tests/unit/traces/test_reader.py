# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Reading: everything of a whole trace, all that is left of a broken one, one clear line for what is none."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as BagWriter

from roller_sim_ros.traces.errors import Problem, TraceError
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import schema, typestore

KINDS = ("chunked", "zstd", "lz4", "uncompressed", "unchunked")


@pytest.fixture(scope="session")
def recordings(chunked, foreign):
    return {"chunked": chunked, **foreign}


def plain(messages) -> list[tuple]:
    return [
        (item.topic, item.type_name, item.log_time_ns, item.publish_time_ns, item.data)
        for item in messages
    ]


@pytest.mark.parametrize("kind", KINDS)
def test_whole_trace(recordings, kind: str) -> None:
    recording = recordings[kind]
    reader = TraceReader(recording.path)
    written = plain(recording.written)
    counts: dict[str, int] = {}
    for topic, *_ in written:
        counts[topic] = counts.get(topic, 0) + 1
    assert {name: info.messages for name, info in reader.topics.items() if info.messages} == counts
    times = [item.log_time_ns for item in recording.written]
    assert (reader.start_ns, reader.end_ns) == (min(times), max(times))
    assert plain(reader.messages()) == written
    assert plain(reader.messages({"/truth"})) == [item for item in written if item[0] == "/truth"]
    assert plain(reader.messages({"/nothing"})) == []
    assert reader.whole
    assert reader.damage_text() is None
    assert reader.position == reader.size == recording.path.stat().st_size
    info = reader.topics["/truth"]
    assert (info.type_name, info.encoding) == ("roller_sim_ros/msg/DrumSoilState", "cdr")
    assert info.schema_text == schema(info.type_name).text
    assert info.schema_encoding == "ros2msg"
    name = "roller_sim_ros" if kind == "chunked" else "site"
    assert name in reader.metadata


@pytest.mark.parametrize("kind", KINDS)
def test_trace_without_summary_tells_the_same(recordings, tmp_path: Path, kind: str) -> None:
    whole = recordings[kind]
    path = tmp_path / "a.mcap"
    path.write_bytes(whole.path.read_bytes()[:-30])
    shown: list[tuple[int, int]] = []
    reader = TraceReader(path, progress=lambda done, size: shown.append((done, size)))
    complete = TraceReader(whole.path)
    assert reader.topics == complete.topics
    assert reader.metadata == complete.metadata
    assert (reader.start_ns, reader.end_ns) == (complete.start_ns, complete.end_ns)
    assert plain(reader.messages()) == plain(whole.written)
    assert not reader.whole
    assert "the file ends without its last records" in str(reader.damage_text()) or (
        "the last record is cut off" in str(reader.damage_text())
    )
    assert "roller-sim recover" in str(reader.damage_text())
    assert shown == sorted(shown)
    assert shown[-1][1] == path.stat().st_size


@given(data=st.data())
@settings(deadline=None, max_examples=150)
@pytest.mark.parametrize("kind", KINDS)
def test_cut_anywhere(recordings, tmp_path_factory, kind: str, data) -> None:
    recording = recordings[kind]
    content = recording.path.read_bytes()
    cut = data.draw(st.integers(0, len(content) - 1))
    path = tmp_path_factory.mktemp("cut") / "a.mcap"
    path.write_bytes(content[:cut])
    got: list[tuple] = []
    try:
        reader = TraceReader(path)
        got = plain(reader.messages())
        assert not reader.whole
        assert reader.damage_text()
    except TraceError as error:
        problem = error.problem
        assert problem is Problem.EMPTY
    finally:
        path.unlink()
    written = plain(recording.written)
    assert got == written[: len(got)]
    # Not less than the summary of the whole file says stands before the cut.
    assert len(got) >= messages_before(recording.path, cut)


def messages_before(path: Path, cut: int) -> int:
    """Messages in the chunks, or plain ones, that end before a position, told by another reader."""
    from mcap.stream_reader import StreamReader

    count = 0
    with path.open("rb") as stream:
        for record in StreamReader(stream, emit_chunks=True).records:
            if stream.tell() > cut:
                break
            name = type(record).__name__
            if name == "MessageIndex":
                count += len(record.records)
            elif name == "Message":
                count += 1
    return count


@given(data=st.data())
@settings(deadline=None, max_examples=150)
@pytest.mark.parametrize("kind", ["chunked", "zstd", "lz4", "uncompressed"])
def test_damaged_byte_is_not_taken_in_silence(
    recordings, tmp_path_factory, kind: str, data
) -> None:
    recording = recordings[kind]
    content = bytearray(recording.path.read_bytes())
    place = data.draw(st.integers(8, len(content) - 1))
    content[place] ^= data.draw(st.integers(1, 255))
    path = tmp_path_factory.mktemp("damaged") / "a.mcap"
    path.write_bytes(bytes(content))
    written = {(item.log_time_ns, item.data) for item in recording.written}
    try:
        reader = TraceReader(path)
        got = list(reader.messages())
    except TraceError:
        return
    finally:
        path.unlink()
    # The checksums of the chunks cover every message; a record that turns into one is counted.
    intact = all((item.log_time_ns, item.data) in written for item in got)
    assert (intact and len(got) == len(written)) or not reader.whole


def test_chunk_that_became_another_record_is_missed(chunked, tmp_path: Path) -> None:
    with chunked.path.open("rb") as stream:
        index = make_reader(stream).get_summary().chunk_indexes[20]
    content = bytearray(chunked.path.read_bytes())
    assert content[index.chunk_start_offset] == 0x06
    content[index.chunk_start_offset] = 0x46
    path = tmp_path / "a.mcap"
    path.write_bytes(bytes(content))
    reader = TraceReader(path)
    count = len(chunked.written)
    assert len(list(reader.messages())) == count - 1
    assert f"it counts {count} messages in the file, there are {count - 1}" in reader.damage_text()


@pytest.mark.parametrize(
    ("content", "problem", "words"),
    [
        (b"", Problem.EMPTY, "it is empty"),
        (b"\x89MC", Problem.EMPTY, "it ends after 3 bytes"),
        (b"\x89MCAP0\r\n", Problem.EMPTY, "it holds no topic of ROS 2"),
        (b"just some text, no trace", Problem.FOREIGN, "it is no MCAP file; give"),
        (b"SQLite format 3\0....", Problem.FOREIGN, "no MCAP file; it is a rosbag2 bag in SQLite"),
        (b"#ROSBAG V2.0\n", Problem.FOREIGN, "no MCAP file; it is a bag of ROS 1"),
        (b"\x28\xb5\x2f\xfd1234", Problem.FOREIGN, "no MCAP file; it is compressed as a whole"),
        (b"\x89MCAP0\r\n" + bytes(500), Problem.EMPTY, "it holds no topic of ROS 2"),
        (b"\x89MCAP0\r\n" + b"\xff" * 500, Problem.EMPTY, "it holds no topic of ROS 2"),
    ],
)
def test_what_is_no_trace(tmp_path: Path, content: bytes, problem: Problem, words: str) -> None:
    path = tmp_path / "a.mcap"
    path.write_bytes(content)
    with pytest.raises(TraceError, match=words) as caught:
        TraceReader(path)
    assert caught.value.problem is problem
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


def test_missing_and_unreadable(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match="there is no such file") as caught:
        TraceReader(tmp_path / "a.mcap")
    assert caught.value.problem is Problem.MISSING
    (tmp_path / "file").write_text("")
    with pytest.raises(TraceError, match="it cannot be read: not a directory") as caught:
        TraceReader(tmp_path / "file" / "a.mcap")
    assert caught.value.problem is Problem.UNREADABLE
    # Memory of a process may be opened by it, but not read at 0.
    with pytest.raises(TraceError, match="it cannot be read: input/output error") as caught:
        TraceReader(Path("/proc/self/mem"))
    assert caught.value.problem is Problem.UNREADABLE


def test_messages_that_are_not_cdr_are_left_out(tmp_path: Path) -> None:
    from mcap.writer import Writer

    path = tmp_path / "a.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="")
        json_channel = writer.register_channel("/json", "json", 0)
        number = writer.register_schema("std_msgs/msg/Float64", "ros2msg", b"float64 data\n")
        channel = writer.register_channel("/x", "cdr", number)
        for time_ns in range(3):
            writer.add_message(json_channel, time_ns, b"{}", time_ns)
            writer.add_message(channel, time_ns, bytes([0, 1, 0, 0]) + bytes(8), time_ns, 5)
        writer.finish()
    reader = TraceReader(path)
    assert list(reader.topics) == ["/x"]
    assert [(item.topic, item.log_time_ns, item.sequence) for item in reader.messages()] == [
        ("/x", time_ns, 5) for time_ns in range(3)
    ]


def make_bag(path: Path, storage: StoragePlugin = StoragePlugin.MCAP) -> list[tuple]:
    """A bag of rosbag2 as rosbags writes it."""
    written = []
    with BagWriter(path, version=9, storage_plugin=storage) as writer:
        connection = writer.add_connection("/x", "std_msgs/msg/Float64", typestore=typestore())
        for number in range(20):
            data = bytes([0, 1, 0, 0]) + number.to_bytes(8, "little")
            writer.write(connection, 1000 + number, data)
            written.append(("/x", "std_msgs/msg/Float64", 1000 + number, data))
    return written


def brief(reader: TraceReader) -> list[tuple]:
    return [(item.topic, item.type_name, item.log_time_ns, item.data) for item in reader.messages()]


def test_rosbag2_folder(tmp_path: Path) -> None:
    written = make_bag(tmp_path / "bag")
    reader = TraceReader(tmp_path / "bag")
    assert brief(reader) == written
    assert reader.topics["/x"].messages == 20
    assert (reader.start_ns, reader.end_ns) == (1000, 1019)
    assert reader.whole


def test_rosbag2_folder_that_lost_its_metadata_is_read(tmp_path: Path) -> None:
    written = make_bag(tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").unlink()
    assert brief(TraceReader(tmp_path / "bag")) == written


def test_rosbag2_folder_in_several_files(tmp_path: Path) -> None:
    first, second = make_bag(tmp_path / "bag"), make_bag(tmp_path / "more")
    (tmp_path / "more" / "more.mcap").rename(tmp_path / "bag" / "bag_1.mcap")
    metadata = tmp_path / "bag" / "metadata.yaml"
    information = yaml.safe_load(metadata.read_text())
    information["rosbag2_bagfile_information"]["relative_file_paths"].append("bag_1.mcap")
    metadata.write_text(yaml.safe_dump(information))
    reader = TraceReader(tmp_path / "bag")
    assert brief(reader) == first + second
    assert reader.topics["/x"].messages == 40
    assert reader.position == reader.size
    # The second file is cut off: the first is not the one that the complaint is about.
    os.truncate(tmp_path / "bag" / "bag_1.mcap", 700)
    broken = TraceReader(tmp_path / "bag")
    assert brief(broken)[:20] == first
    assert str(broken.damage_text()).startswith(str(tmp_path / "bag" / "bag_1.mcap"))
    (tmp_path / "bag" / "bag_1.mcap").unlink()
    with pytest.raises(TraceError, match=r"bag_1\.mcap: there is no such file"):
        TraceReader(tmp_path / "bag")


def test_other_folders(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match="the folder holds neither metadata.yaml nor a .mcap"):
        TraceReader(tmp_path)
    make_bag(tmp_path / "sqlite", StoragePlugin.SQLITE3)
    with pytest.raises(TraceError, match=r"it is a bag in sqlite3; `ros2 bag convert`"):
        TraceReader(tmp_path / "sqlite")
    make_bag(tmp_path / "bag")
    metadata = tmp_path / "bag" / "metadata.yaml"
    text = metadata.read_text()
    metadata.write_text(text.replace("compression_mode: ''", "compression_mode: FILE"))
    with pytest.raises(TraceError, match="it is compressed by rosbag2"):
        TraceReader(tmp_path / "bag")
    for nonsense in (b"{", b"a: b", b"\xff\xfe\x00", b"rosbag2_bagfile_information: 3", b""):
        metadata.write_bytes(nonsense)
        with pytest.raises(TraceError, match=r"metadata\.yaml: it is not rosbag2's metadata"):
            TraceReader(tmp_path / "bag")
