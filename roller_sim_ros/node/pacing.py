"""The thread that keeps time: one block at a time, published when its last sample is due."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.node.lateness import Lateness
from roller_sim_ros.node.realtime import precise_sleeps, request_realtime
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.wire.messages import Message


class Pacer:
    """Advances an emulator in real time, in a thread of its own.

    A block is computed ahead of its deadline and handed out at it: the start plus the time of the
    block's last sample, on the steady clock. Deadlines are absolute, so that a block that comes late shifts
    none of those after it; they follow without a pause until the roller is on time again.

    Parameters
    ----------
    emulator : Emulator
        What is advanced.
    samples : int
        Samples per block, a divisor of 128.
    send : callable
        Takes the messages of a block.
    imu_wanted : callable
        Whether anyone listens to the per-sample messages; asked once a revolution.
    priority : int
        Real-time priority to be tried; 0: none.

    Attributes
    ----------
    lateness : Lateness
        How late the blocks were.
    realtime : list of str
        What was tried for real time, and what came of it.
    failure : Exception or None
        What ended the thread unasked.
    """

    def __init__(
        self,
        emulator: Emulator,
        samples: int,
        send: Callable[[list[Message]], None],
        imu_wanted: Callable[[], bool],
        priority: int = 0,
    ) -> None:
        self.emulator = emulator
        self.lateness = Lateness()
        self.realtime: list[str] = []
        self.failure: Exception | None = None
        self._samples = samples
        self._send = send
        self._imu_wanted = imu_wanted
        self._priority = priority
        self._progress = (0.0, 0.0)
        self._stopping = threading.Event()
        self._started = threading.Event()
        self._thread = threading.Thread(target=self._run, name="pacing", daemon=True)

    def start(self) -> None:
        """Begin; the first sample's time is now."""
        self._thread.start()
        self._started.wait()

    def stop(self) -> None:
        """End after the block under way."""
        self._stopping.set()
        self._thread.join()

    @property
    def progress(self) -> tuple[float, float]:
        """Simulated time that is published, and when it was, both in s since the start."""
        return self._progress

    def _run(self) -> None:
        precise_sleeps()
        self.realtime = request_realtime(self._priority)
        self._started.set()
        try:
            self._pace()
        except Exception as error:  # noqa: BLE001 - the other thread reports it, whatever it is
            self.failure = error

    def _pace(self) -> None:
        emulator, samples, send, note = self.emulator, self._samples, self._send, self.lateness.note
        monotonic, sleep, stopping = time.monotonic, time.sleep, self._stopping.is_set
        imu = False
        start = monotonic()
        while not stopping():
            messages = emulator.advance(samples)
            block = emulator.block
            assert block is not None  # there is one after every advance
            if block.first_sample % SAMPLES_PER_REVOLUTION == 0:
                imu = self._imu_wanted()
            if imu:
                messages += emulator.imu_messages()
            period_s = block.sample_period_s
            due_s = block.time_s + (samples - 1) * period_s
            wait_s = start + due_s - monotonic()
            if wait_s > 0.0:
                sleep(wait_s)
            now_s = monotonic() - start
            send(messages)
            note(now_s - due_s, samples * period_s)
            self._progress = (due_s, now_s)
