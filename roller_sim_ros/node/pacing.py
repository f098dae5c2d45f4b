# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The thread that keeps time: one block at a time, published when its last sample is due."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, wait
from typing import Any, TypeVar

from roller_sim_ros.node.lateness import Lateness
from roller_sim_ros.node.realtime import precise_sleeps, request_realtime
from roller_sim_ros.node.run import Run

T = TypeVar("T")

LOOK_S = 0.1
"""How often who waits for the thread looks whether it is still there."""


class Pacer:
    """Drives a run at a speed, in a thread of its own; paused, it leaves the run to others.

    A block is computed ahead of its deadline and handed out at it: the start plus the time of the
    block's last sample, on the steady clock. Deadlines are absolute, so that a block that comes late shifts
    none of those after it; they follow without a pause until the roller is on time again.

    Parameters
    ----------
    run : Run
        What is driven.
    speed : float
        Simulated over real time; 0: as fast as possible, without deadlines.
    priority : int
        Real-time priority to be tried; 0: none.

    Attributes
    ----------
    run : Run
        As given.
    lateness : Lateness
        How late the blocks were.
    realtime : list of str
        What was tried for real time, and what came of it.
    failure : Exception or None
        What ended the thread unasked.
    """

    def __init__(self, run: Run, speed: float = 1.0, priority: int = 0) -> None:
        self.run = run
        self.lateness = Lateness()
        self.realtime: list[str] = []
        self.failure: Exception | None = None
        self._speed = speed
        self._priority = priority
        self._stopping = threading.Event()
        self._started = threading.Event()
        self._playing = threading.Event()
        self._parked = threading.Event()
        self._acts: deque[tuple[Callable[[], Any], Future[Any]]] = deque()
        self._thread = threading.Thread(target=self._main, name="pacing", daemon=True)

    @property
    def playing(self) -> bool:
        """Whether time goes on by itself."""
        return self._playing.is_set()

    def start(self, *, paused: bool = False) -> None:
        """Begin; the next sample's time is now."""
        if not paused:
            self._playing.set()
        self._thread.start()
        self._started.wait()

    def play(self) -> None:
        """Go on; the next sample's time is now."""
        self._playing.set()

    def pause(self) -> None:
        """Wait until the block under way is out and the thread leaves the run alone."""
        self._playing.clear()
        self._parked.wait()

    def between_blocks(self, act: Callable[[], T]) -> T:
        """Do something while no block is under way, and return or raise what comes of it.

        While time goes on by itself the pacing thread does it, and is later with its next block.
        """
        if not self.playing:
            self._parked.wait()
            return act()
        future: Future[T] = Future()
        self._acts.append((act, future))
        while not wait([future], LOOK_S).done:
            # It may have parked, or ended, without a look at what waits.
            if self._parked.is_set() and future.cancel():
                return act()
        return future.result()

    def stop_playing(self) -> None:
        """Pause after the block under way, without waiting for it: for the thread itself."""
        self._playing.clear()

    def stop(self) -> None:
        """End after the block under way."""
        self._stopping.set()
        self._playing.set()
        self._thread.join()

    def _main(self) -> None:
        precise_sleeps()
        self.realtime = request_realtime(self._priority)
        self._started.set()
        try:
            while not self._stopping.is_set():
                if not self._playing.is_set():
                    self._parked.set()
                    self._playing.wait()
                    self._parked.clear()
                elif self._speed > 0.0:
                    self._keep_pace()
                else:
                    self._hurry()
        except Exception as error:  # noqa: BLE001 - the other thread reports it, whatever it is
            self.failure = error
        finally:
            self._parked.set()

    def _keep_pace(self) -> None:
        run, speed, note = self.run, self._speed, self.lateness.note
        monotonic, sleep = time.monotonic, time.sleep
        stopping, playing = self._stopping.is_set, self._playing.is_set
        start, from_s = monotonic(), run.time_s
        while playing() and not stopping():
            block, messages = run.compute()
            period_s = block.sample_period_s
            due_s = (block.time_s + (len(block) - 1) * period_s - from_s) / speed
            wait_s = start + due_s - monotonic()
            if wait_s > 0.0:
                sleep(wait_s)
            now_s = monotonic() - start
            run.send(messages)
            note(now_s - due_s, len(block) * period_s / speed)
            if self._acts:
                self._act()

    def _hurry(self) -> None:
        run, stopping, playing = self.run, self._stopping.is_set, self._playing.is_set
        while playing() and not stopping():
            _, messages = run.compute()
            run.send(messages)
            if self._acts:
                self._act()

    def _act(self) -> None:
        act, future = self._acts.popleft()
        if future.set_running_or_notify_cancel():
            try:
                future.set_result(act())
            except Exception as error:  # noqa: BLE001 - who waits for it gets it
                future.set_exception(error)
