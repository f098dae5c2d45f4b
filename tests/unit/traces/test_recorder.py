# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Recording in a process of its own: nothing waits, nothing is lost in silence, the file is whole."""

from __future__ import annotations

import os
import random
import resource
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from mcap.reader import make_reader

from roller_sim_ros.parameters import Configuration
from roller_sim_ros.traces.errors import Problem, TraceError
from roller_sim_ros.traces.metadata import run_metadata
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.traces.recorder import Recorder
from roller_sim_ros.traces.recover import recover
from roller_sim_ros.traces.registration import register_all
from roller_sim_ros.traces.ring import State

START_NS = 1_700_000_000_000_000_000
FLOAT = ("std_msgs/msg/Float64", "float64 data\n", "")


def data(number: int) -> bytes:
    return b"\0\1\0\0" + number.to_bytes(8, "little")


def numbers(path: Path, topic: str) -> list[int]:
    return [
        int.from_bytes(item.data[4:12], "little") for item in TraceReader(path).messages({topic})
    ]


def users_of(path: Path) -> list[int]:
    """The processes that have a file open."""
    found = []
    for link in Path("/proc").glob("[0-9]*/fd/*"):
        with suppress(OSError):
            if link.readlink() == path:
                found.append(int(link.parts[2]))
    return found


def child_of(recorder: Recorder) -> int:
    """The recording process, found from outside."""
    (number,) = users_of(recorder.path)
    return number


@contextmanager
def stopped(process: int) -> Iterator[None]:
    os.kill(process, signal.SIGSTOP)
    try:
        yield
    finally:
        os.kill(process, signal.SIGCONT)


def wait_for(condition, timeout_s: float = 10.0) -> None:
    deadline = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_file_holds_what_was_handed_over(tmp_path: Path, messages_written) -> None:
    path = tmp_path / "a.mcap"
    configuration = Configuration()
    recorder = Recorder(path, run_metadata(configuration, START_NS))
    names = register_all(recorder, configuration.pacing, "/north")
    for message in messages_written:
        assert recorder.put(
            names[message.topic], message.data, message.stamp_ns + 5, message.stamp_ns
        )
    status = recorder.close()
    assert (status.state, status.reason, status.lost) == (State.CLOSED, "", 0)
    assert status.messages == status.messages_written == len(messages_written)
    assert status.bytes_written == path.stat().st_size
    assert not any(status.dropped.values())
    reader = TraceReader(path)
    assert [
        (item.topic, item.log_time_ns, item.publish_time_ns, item.data)
        for item in reader.messages()
    ] == [
        (names[item.topic], item.stamp_ns + 5, item.stamp_ns, item.data)
        for item in messages_written
    ]
    assert reader.whole
    assert reader.metadata["roller_sim_ros"]["start_time_ns"] == str(START_NS)


def test_topics_may_come_late_and_twice(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {})
    recorder.register("/early", *FLOAT)
    recorder.put("/early", data(1), 1, 1)
    time.sleep(0.1)
    recorder.register("/meter_under_test", *FLOAT)
    recorder.register("/early", *FLOAT)
    recorder.put("/meter_under_test", data(2), 2, 2)
    recorder.close()
    assert numbers(path, "/early") == [1]
    assert numbers(path, "/meter_under_test") == [2]


def test_errors_at_the_start_reach_the_caller(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match="there is no folder") as caught:
        Recorder(tmp_path / "no" / "a.mcap", {})
    assert caught.value.problem is Problem.UNWRITABLE
    (tmp_path / "b.mcap").write_text("precious")
    with pytest.raises(TraceError, match="there already is such a file") as caught:
        Recorder(tmp_path / "b.mcap", {})
    assert caught.value.problem is Problem.EXISTS
    assert (tmp_path / "b.mcap").read_text() == "precious"
    with pytest.raises(TraceError, match="no space left on device") as caught:
        Recorder(Path("/dev/full"), {}, overwrite=True)
    assert caught.value.problem is Problem.FULL


def test_process_that_does_not_start_is_an_error(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(sys, "executable", "/bin/false")
    with pytest.raises(TraceError, match="the recording process did not start"):
        Recorder(tmp_path / "a.mcap", {})


def test_put_never_waits_for_a_stopped_process_and_drops_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {}, capacity=64 * 1024)
    recorder.register("/a", *FLOAT)
    recorder.register("/b", *FLOAT)
    longest = 0.0
    taken = {"/a": 0, "/b": 0}
    with stopped(child_of(recorder)):
        for number in range(20_000):
            topic = "/b" if number % 4 == 3 else "/a"
            begin = time.perf_counter()
            taken[topic] += recorder.put(topic, data(number), number, number)
            longest = max(longest, time.perf_counter() - begin)
        status = recorder.status()
    assert longest < 0.25  # the process was stopped for far longer than any put took
    assert status.state is State.RECORDING
    assert status.dropped == {"/a": 15_000 - taken["/a"], "/b": 5_000 - taken["/b"]}
    assert status.dropped["/b"] > 0
    wait_for(lambda: recorder.put("/a", data(99_999), 99_999, 99_999))
    status = recorder.close()
    assert status.state is State.CLOSED
    got = numbers(path, "/a")
    assert len(got) + len(numbers(path, "/b")) == status.messages
    assert len(got) == taken["/a"] + 1
    assert got[-1] == 99_999
    # The gap is in the file, too.
    last = list(TraceReader(path).messages({"/a"}))[-1]
    assert last.sequence == len(got) + status.dropped["/a"]


def test_topic_that_found_the_ring_full_is_announced_later(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {}, capacity=4096)
    recorder.register("/a", *FLOAT)
    with stopped(child_of(recorder)):
        while recorder.put("/a", data(1), 1, 1):
            pass
        recorder.register("/late", *FLOAT)
        assert not recorder.put("/late", data(2), 2, 2)
    wait_for(lambda: recorder.put("/late", data(3), 3, 3))
    assert recorder.close().state is State.CLOSED
    assert numbers(path, "/late") == [3]


def test_patient_recorder_waits_for_room_and_drops_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {}, capacity=4096, patience_s=60.0)
    recorder.register("/a", *FLOAT)
    taken: list[bool] = []

    def run() -> None:
        taken.extend(recorder.put("/a", data(number), number, number) for number in range(300))
        recorder.register("/late", *FLOAT)
        taken.append(recorder.put("/late", data(7), 300, 300))

    thread = threading.Thread(target=run)
    with stopped(child_of(recorder)):
        thread.start()
        # 4096 bytes are room for 85 messages: it waits for more.
        thread.join(0.3)
        assert thread.is_alive()
    thread.join(60.0)
    assert len(taken) == 301
    assert all(taken)
    assert sum(recorder.close().dropped.values()) == 0
    assert numbers(path, "/a") == list(range(300))
    assert numbers(path, "/late") == [7]


def test_patience_ends_with_the_recording_process(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "a.mcap", {}, capacity=4096, patience_s=60.0)
    recorder.register("/a", *FLOAT)
    os.kill(child_of(recorder), signal.SIGKILL)
    wait_for(lambda: not recorder.put("/a", data(1), 1, 1))
    assert recorder.close().state is State.FAILED


def test_threads_may_put_at_the_same_time(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {})
    topics = [f"/t{number}" for number in range(4)]
    for topic in topics:
        recorder.register(topic, *FLOAT)

    def run(topic: str) -> None:
        for number in range(3000):
            assert recorder.put(topic, data(number), number, number)

    threads = [threading.Thread(target=run, args=(topic,)) for topic in topics]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert recorder.close().messages_written == 12_000
    for topic in topics:
        assert numbers(path, topic) == list(range(3000))


def test_signals_do_not_end_the_recording(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {})
    recorder.register("/a", *FLOAT)
    for number, name in enumerate((signal.SIGINT, signal.SIGTERM, signal.SIGHUP)):
        os.kill(child_of(recorder), name)
        time.sleep(0.05)
        assert recorder.put("/a", data(number), number, number)
    assert recorder.close().state is State.CLOSED
    assert numbers(path, "/a") == [0, 1, 2]


def test_full_disk_stops_the_recording_and_not_the_caller(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {}, flush_period_s=0.05)
    resource.prlimit(child_of(recorder), resource.RLIMIT_FSIZE, (60_000, 60_000))
    recorder.register("/a", *FLOAT)
    handed_over = 0
    deadline = time.monotonic() + 20.0
    while recorder.status().state is State.RECORDING:
        assert time.monotonic() < deadline
        handed_over += recorder.put("/a", data(handed_over) + os.urandom(200), 1, 1)
        time.sleep(0.001)
    assert not recorder.put("/a", data(0), 1, 1)
    status = recorder.status()
    assert status.state is State.FAILED
    assert status.reason.startswith(f"{path}: no more can be written: file too large;")
    assert status.dropped["/a"] >= 1
    assert status.lost == handed_over - status.messages_written > 0
    assert recorder.close().state is State.FAILED
    # What was recorded until then is there.
    account = recover(path)
    assert account.kept >= status.messages_written > 100
    assert numbers(account.target, "/a") == list(range(account.kept))


def test_process_that_ends_unasked_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {}, flush_period_s=0.05)
    recorder.register("/a", *FLOAT)
    recorder.put("/a", data(0), 1, 1)
    wait_for(lambda: recorder.status().messages_written == 1)
    os.kill(child_of(recorder), signal.SIGKILL)
    wait_for(lambda: recorder.status().state is State.FAILED)
    assert "ended unasked (-9)" in recorder.status().reason
    assert recover(path).kept == 1


def test_close_does_not_wait_for_ever_and_the_file_is_finished_later(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {})
    recorder.register("/a", *FLOAT)
    recorder.put("/a", data(0), 1, 1)
    with stopped(child_of(recorder)):
        begin = time.monotonic()
        status = recorder.close()
        assert time.monotonic() - begin < 2.0
    assert status.state is State.FAILED
    assert "was not finished within" in status.reason
    wait_for(lambda: not users_of(path))
    assert TraceReader(path).whole
    assert numbers(path, "/a") == [0]
    assert not recorder.put("/a", data(1), 1, 1)
    assert recorder.close().dropped == {"/a": 1}


def test_backlog_is_written_within_two_seconds_at_the_end(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    recorder = Recorder(path, {})
    recorder.register("/a", *FLOAT)
    with stopped(child_of(recorder)):
        # Two seconds of everything, the IMU at each of 5120 samples a second included.
        for number in range(12_000):
            assert recorder.put("/a", data(number) + os.urandom(300), number, number)
    begin = time.monotonic()
    assert recorder.close().state is State.CLOSED
    assert time.monotonic() - begin < 2.0
    assert len(numbers(path, "/a")) == 12_000


# A process that records a number every millisecond and says on standard output, after each, which is handed over.
NODE = """
    import os, sys, time
    from pathlib import Path
    from roller_sim_ros.traces.recorder import Recorder

    recorder = Recorder(Path(sys.argv[1]), {})
    recorder.register("/a", "std_msgs/msg/Float64", "float64 data\\n", "")
    number = 0
    while True:
        now = time.time_ns()
        assert recorder.put("/a", b"\\0\\1\\0\\0" + number.to_bytes(8, "little"), now, now)
        os.write(1, f"{number} {now}\\n".encode())
        number += 1
        time.sleep(0.001)
"""


@contextmanager
def node(path: Path) -> Iterator[subprocess.Popen[bytes]]:
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(NODE), str(path)],
        stdout=subprocess.PIPE,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def kill_after(process: subprocess.Popen[bytes], seconds: float, kill) -> tuple[int, int]:
    """Let the process run; return number and time of the last message that it said it had handed over."""
    assert process.stdout is not None
    line = process.stdout.readline()
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        line = process.stdout.readline()
    kill(process.pid, signal.SIGKILL)
    process.wait()
    for whole in process.stdout.read().split(b"\n")[:-1]:
        line = whole
    number, time_ns = line.split()
    return int(number), int(time_ns)


@pytest.mark.parametrize("seed", range(4))
def test_sigkill_of_the_node_loses_nothing(tmp_path: Path, seed: int) -> None:
    path = tmp_path / "a.mcap"
    with node(path) as process:
        number, _ = kill_after(process, random.Random(seed).uniform(0.0, 1.2), os.kill)
    wait_for(lambda: not users_of(path))
    reader = TraceReader(path)
    got = numbers(path, "/a")
    assert reader.whole
    # One more may have been handed over than was said.
    assert got in (list(range(number + 1)), list(range(number + 2)))
    with path.open("rb") as stream:
        assert make_reader(
            stream, validate_crcs=True
        ).get_summary().statistics.message_count == len(got)


@pytest.mark.parametrize("seed", range(4))
def test_sigkill_of_everything_loses_two_seconds_at_most(tmp_path: Path, seed: int) -> None:
    path = tmp_path / "a.mcap"
    with node(path) as process:
        seconds = random.Random(seed).uniform(1.0, 2.5)
        number, time_ns = kill_after(process, seconds, os.killpg)
    wait_for(lambda: not users_of(path))
    account = recover(path)
    got = numbers(account.target, "/a")
    assert got == list(range(len(got)))
    assert len(got) <= number + 2
    assert time_ns - account.topics["/a"].last_ns < 2e9
    assert account.topics["/a"].missing_messages == 0
