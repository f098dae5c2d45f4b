# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Writes a trace: MCAP with the conventions of rosbag2, in chunks that reach the disk soon."""

from __future__ import annotations

import errno
import os
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, cast

from mcap.writer import CompressionType, Writer

from roller_sim_ros.traces.errors import writing_error

PROFILE = "ros2"
ENCODING = "cdr"
SCHEMA_ENCODING = "ros2msg"
FLUSH_PERIOD_S = 0.5


class TraceWriter:
    """A trace being written; whatever is older than the flush period survives the end of the process.

    Parameters
    ----------
    path : pathlib.Path
        The file.
    metadata : mapping
        Metadata records by name, written first.
    overwrite : bool
        Replace a file that is there.
    flush_period_s : float
        An open chunk is closed and written at least this often, s; checked by `put` and `flush_if_due`.

    Raises
    ------
    TraceError
        On construction if the file cannot be made; by any other method if it cannot be written any
        more, after which the file ends with its last whole record.

    Examples
    --------
    ::

        with TraceWriter(path, run_metadata(configuration, start_ns)) as trace:
            names = register_all(trace, configuration.pacing)
            trace.put(names[message.topic], message.data, message.stamp_ns, message.stamp_ns)
    """

    def __init__(
        self,
        path: Path,
        metadata: Mapping[str, Mapping[str, str]],
        *,
        overwrite: bool = False,
        flush_period_s: float = FLUSH_PERIOD_S,
    ) -> None:
        self.path = path
        self.messages = 0
        """Messages taken."""
        self.messages_written = 0
        """Messages that stand in the file in whole chunks."""
        self._flush_period_s = flush_period_s
        self._next_flush = time.monotonic() + flush_period_s
        self._channels: dict[str, int] = {}
        self._sequences: dict[str, int] = {}
        self._schemas: dict[tuple[str, str], int] = {}
        try:
            self._sink = _Sink(path, overwrite=overwrite)
        except OSError as error:
            raise writing_error(path, error) from error
        # The sink is all of a stream that the library uses.
        self._writer = Writer(cast("Any", self._sink), compression=CompressionType.ZSTD)
        try:
            self._writer.start(profile=PROFILE)
            for name, record in metadata.items():
                self._writer.add_metadata(name, dict(record))
        except OSError as error:
            self._sink.close()
            if not overwrite:
                path.unlink(missing_ok=True)
            raise writing_error(path, error) from error

    def __enter__(self) -> TraceWriter:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def bytes_written(self) -> int:
        """Size of the file."""
        return self._sink.position

    def register(
        self,
        topic: str,
        type_name: str,
        schema_text: str,
        offered_qos_profiles: str,
        type_hash: str = "",
    ) -> None:
        """Announce a topic; twice is the same as once.

        Parameters
        ----------
        topic : str
            Absolute name.
        type_name, schema_text, type_hash : str
            As in `roller_sim_ros.wire.types.Schema`; the hash may be unknown.
        offered_qos_profiles : str
            As `roller_sim_ros.wire.qos.Qos.offered_profiles` writes it; may be empty.
        """
        if topic in self._channels:
            return
        key = (type_name, schema_text)
        if key not in self._schemas:
            self._schemas[key] = self._writer.register_schema(
                type_name, SCHEMA_ENCODING, schema_text.encode("utf-8")
            )
        metadata = {"offered_qos_profiles": offered_qos_profiles}
        if type_hash:
            metadata["topic_type_hash"] = type_hash
        self._channels[topic] = self._writer.register_channel(
            topic, ENCODING, self._schemas[key], metadata
        )
        self._sequences[topic] = 0

    def put(
        self,
        topic: str,
        data: bytes | memoryview,
        log_time_ns: int,
        publish_time_ns: int,
        sequence: int | None = None,
    ) -> None:
        """Write a message.

        Parameters
        ----------
        topic : str
            A registered topic.
        data : bytes
            CDR.
        log_time_ns, publish_time_ns : int
            When it was received and published, ns since the epoch.
        sequence : int, optional
            Counter of the topic's messages; the next one when left out.
        """
        if sequence is None:
            sequence = self._sequences[topic] + 1
        self._sequences[topic] = sequence
        before = self._sink.position
        self._guarded(
            self._writer.add_message,
            self._channels[topic],
            log_time_ns,
            data,
            publish_time_ns,
            sequence,
        )
        self.messages += 1
        if self._sink.position != before:
            self._note_flush()
        self.flush_if_due()

    def flush_if_due(self) -> None:
        """Close and write the open chunk if the flush period is over."""
        if time.monotonic() >= self._next_flush:
            self._guarded(self._writer.flush)
            self._note_flush()

    def close(self) -> None:
        """Write what is left, the summary and the index; twice is the same as once."""
        if self._sink.closed:
            return
        self._guarded(self._writer.finish)
        self.messages_written = self.messages
        self._guarded(self._sink.sync)
        self._sink.close()

    def _note_flush(self) -> None:
        self.messages_written = self.messages
        self._next_flush = time.monotonic() + self._flush_period_s

    def _guarded(self, write: Any, *arguments: Any) -> None:
        try:
            write(*arguments)
        except OSError as error:
            self._sink.close()
            raise writing_error(self.path, error) from error


class _Sink:
    """The file, unbuffered: what is written is the system's at once and survives a SIGKILL.

    A write that fails is undone, so that the file always ends with a whole record.
    """

    def __init__(self, path: Path, *, overwrite: bool) -> None:
        self._file = path.open("wb" if overwrite else "xb", buffering=0)
        self.position = 0

    @property
    def closed(self) -> bool:
        return self._file.closed

    def write(self, data: bytes) -> int:
        view = memoryview(data)
        done = 0
        try:
            while done < len(view):
                done += self._file.write(view[done:]) or 0
        except OSError:
            # A device, which has no length to cut, does not matter: nothing is left in it.
            with suppress(OSError):
                os.truncate(self._file.fileno(), self.position)
            raise
        self.position += done
        return done

    def tell(self) -> int:
        return self.position

    def flush(self) -> None:
        """Do nothing: there is no buffer."""

    def sync(self) -> None:
        try:
            os.fsync(self._file.fileno())
        except OSError as error:
            if error.errno != errno.EINVAL:  # pipes and devices cannot be synchronised
                raise

    def close(self) -> None:
        self._file.close()
