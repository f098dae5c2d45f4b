# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A run of the roller on the network: its blocks are computed here and sent from here, whoever drives it."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.session import Block
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.messages import Message

ROUNDING_S = 2e-9
"""A sample that is due so little after a moment is due at it: a time between two stamps, of whole ns, is off by one."""


class Run:
    """An emulator whose messages go out block by block; driven by one thread at a time.

    Parameters
    ----------
    emulator : Emulator
        At its start, or restored.
    samples : int
        Samples per block, a divisor of 128.
    send : callable
        Takes the messages of a block.
    imu_wanted : callable
        Whether anyone listens to the per-sample messages; asked once a revolution.
    clock : bool
        Whether ``/clock`` goes before every block.

    Attributes
    ----------
    emulator : Emulator
        As given.
    before_revolution : callable or None
        Called with the simulated time, s, before every revolution.
    on_end : callable or None
        Called once, by the driving thread, when all that the scenario planned has been driven.
    ended : bool
        Whether that is so.
    progress : (float, float)
        Simulated time that is sent, and when it was, both in s since the run was made.
    """

    def __init__(
        self,
        emulator: Emulator,
        samples: int,
        send: Callable[[list[Message]], None],
        imu_wanted: Callable[[], bool],
        *,
        clock: bool = False,
    ) -> None:
        self.emulator = emulator
        self.before_revolution: Callable[[float], None] | None = None
        self.on_end: Callable[[], None] | None = None
        self.ended = False
        self.progress = (0.0, 0.0)
        self._samples = samples
        self._send = send
        self._imu_wanted = imu_wanted
        self._imu = False
        self._clock = clock
        self._time_s = _end_s(emulator.block)
        self._began = time.monotonic()
        self._from_s = self._time_s

    @property
    def time_s(self) -> float:
        """Time of the next sample, s since the start of the session."""
        return self._time_s

    @property
    def time_ns(self) -> int:
        """Its stamp, up to which all is simulated: what ``/clock`` says."""
        return self.emulator.start_ns + round(self._time_s * 1e9)

    @property
    def next_sample(self) -> int:
        """Its index."""
        return self.emulator.session.next_sample

    def compute(self, most: int = SAMPLES_PER_REVOLUTION) -> tuple[Block, list[Message]]:
        """Advance by a block, or by what `most` leaves of it, and return the block and its messages."""
        emulator = self.emulator
        first = emulator.session.next_sample
        if first % SAMPLES_PER_REVOLUTION == 0:
            self._imu = self._imu_wanted()
            if self.before_revolution is not None:
                self.before_revolution(self._time_s)
        out = emulator.advance(min(most, self._samples - first % self._samples))
        block = emulator.block
        assert block is not None  # there is one after every advance
        if self._imu:
            out += emulator.imu_messages()
        self._time_s = _end_s(block)
        if self._clock:
            out.insert(0, messages.clock(self.time_ns))
        return block, out

    def send(self, out: list[Message]) -> None:
        """Send the messages of the block that was computed last."""
        self._send(out)
        self.progress = (self._time_s - self._from_s, time.monotonic() - self._began)
        if not self.ended and self.next_sample % SAMPLES_PER_REVOLUTION == 0:
            self.ended = self.emulator.session.site.position.finished
            if self.ended and self.on_end is not None:
                self.on_end()

    def step(self, samples: int, going_on: Callable[[], bool]) -> bool:
        """Compute and send the next samples; return whether it came to that.

        Parameters
        ----------
        samples : int
            How many.
        going_on : callable
            Asked before every block; whether to go on.
        """
        left = samples
        while left > 0:
            if not going_on():
                return False
            block, out = self.compute(left)
            self.send(out)
            left -= len(block)
        return True

    def step_for(self, duration_s: float, going_on: Callable[[], bool]) -> bool:
        """Compute and send the samples that are due before `duration_s` is over; return whether it came to that."""
        end_s = self._time_s + duration_s
        while self._time_s < end_s - ROUNDING_S:
            if not going_on():
                return False
            _, out = self.compute(self._within(end_s - ROUNDING_S - self._time_s))
            self.send(out)
        return True

    def _within(self, left_s: float) -> int:
        """Return how many samples surely begin within a time; at least one does."""
        session = self.emulator.session
        block = self.emulator.block
        if block is not None and session.next_sample % SAMPLES_PER_REVOLUTION:
            period_s = block.sample_period_s
        else:
            # The period of the revolution to come is not known yet; none is longer than this.
            period_s = 1.0 / (session.configuration.sampling.floor_hz * SAMPLES_PER_REVOLUTION)
        return max(1, math.ceil(left_s / period_s))


def _end_s(block: Block | None) -> float:
    return 0.0 if block is None else block.time_s + len(block) * block.sample_period_s
