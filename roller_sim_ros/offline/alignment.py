# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One topic of a trace beside the same topic of its replay, message by message."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

from roller_sim_ros.wire.messages import Message


class Place(NamedTuple):
    """Where in the run a message was made.

    Attributes
    ----------
    sample : int
        First sample of its block.
    time_s : float
        Its time since the start.
    """

    sample: int
    time_s: float


class Replayed(NamedTuple):
    """A message that should be in the trace, and where it was made."""

    message: Message
    place: Place


class Mismatch(NamedTuple):
    """What the trace has where the replay has something else; None: nothing."""

    recorded: bytes
    replayed: Replayed | None


class Alignment:
    """Lays recorded messages on replayed ones, in order; those that the recorder lost are left out.

    Attributes
    ----------
    compared : int
        Messages that were the same.
    lost : int
        Messages that are not in the trace.
    """

    def __init__(self) -> None:
        self.compared = 0
        self.lost = 0
        self._recorded: deque[tuple[bytes, int]] = deque()
        self._replayed: deque[Replayed] = deque()
        self._counter = 0
        self._first = True
        self._left_over = 0

    def record(self, data: bytes, counter: int) -> int:
        """Take a recorded message and return how many before it are lost.

        Parameters
        ----------
        data : bytes
            CDR.
        counter : int
            The recorder's, which counts lost messages too; 0 where it does not count.
        """
        lost = self.count(counter)
        if self._first:
            # Some of them were lost at the end of the run before this one.
            lost = max(0, lost - self._left_over)
            self._first = False
        self._recorded.append((data, lost))
        return lost

    def count(self, counter: int) -> int:
        """Take note of a recorded message by its counter and return how many before it are lost."""
        before, self._counter = self._counter, counter
        return max(0, counter - before - 1)

    def replay(self, replayed: Replayed) -> None:
        """Take a replayed message."""
        self._replayed.append(replayed)

    def mismatch(self) -> Mismatch | None:
        """Compare what is there of both and return the first pair that is not the same."""
        while self._recorded and self._replayed:
            data, lost = self._recorded[0]
            if lost:
                self._replayed.popleft()
                self.lost += 1
                self._recorded[0] = (data, lost - 1)
                continue
            self._recorded.popleft()
            replayed = self._replayed.popleft()
            if data != replayed.message.data:
                return Mismatch(data, replayed)
            self.compared += 1
        return None

    def end_run(self) -> Mismatch | None:
        """End the run and return a recorded message that the replay does not have."""
        mismatch = Mismatch(self._recorded[0][0], None) if self._recorded else None
        self._left_over = len(self._replayed)
        self.lost += self._left_over
        self._recorded.clear()
        self._replayed.clear()
        self._first = True
        return mismatch
