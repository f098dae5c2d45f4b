# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The two soaks: in real time, and in lock step."""

from __future__ import annotations

import re
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.processes import Process
from soak.client import Client, SoakError, Stream
from soak.memory import Memory, children, resident_mb

SITE = Path(__file__).with_name("site.yaml")
SAMPLES = 128
HZ = 40.0
EDGE = 500
"""Blocks at either end of which the lateness is compared."""

Tell = Callable[[str], None]


@dataclass
class Result:
    """What came of a soak.

    Attributes
    ----------
    what : str
        Which one.
    simulated_s, wall_s : float
        How long.
    acceleration, truth : Stream
        What came.
    drift_samples : float
        Samples more (or fewer) than the time between the stamps, at 40 Hz, has room for.
    clock_drift_ms : float or None
        By how much later blocks came at the end than at the start against the steady clock; in real time only.
    memory : Memory
        Of the node.
    recording : Memory or None
        Of the process that writes the trace.
    last_words : str
        What the roller said at its end.
    """

    what: str
    simulated_s: float
    wall_s: float
    acceleration: Stream
    truth: Stream
    drift_samples: float
    clock_drift_ms: float | None
    memory: Memory
    recording: Memory | None
    last_words: str

    @property
    def lost(self) -> int:
        """Samples that did not come."""
        return self.acceleration.lost + self.truth.lost


def real_time(seconds: float, tell: Tell = print) -> Result:
    """Let the roller work in real time, record, and listen to it."""
    with tempfile.TemporaryDirectory(prefix="roller_sim_soak_") as folder:
        trace = Path(folder) / "trace.mcap"
        with _roller(Path(folder), "--record", str(trace)) as (process, client, pid):
            client.spin_until(lambda: client.truth.samples, "samples")
            memory, recording, begin = Memory(), Memory(), time.monotonic()
            (recorder,) = children(pid)
            while time.monotonic() - begin < seconds:
                client.spin_for(min(seconds / 40.0, 10.0))
                hours = (time.monotonic() - begin) / 3600.0
                memory.add(hours, resident_mb(pid))
                recording.add(hours, resident_mb(recorder))
                tell(
                    f"{hours:6.3f} h  {client.truth.samples} samples, {client.truth.lost} lost, "
                    f"{memory.mb[-1]:.1f} + {recording.mb[-1]:.1f} MB"
                )
            wall_s = time.monotonic() - begin
            process.end()
        lateness = client.lateness_s
        ends = lateness[:EDGE], lateness[-EDGE:]
        return _result(
            "real time, recording",
            client,
            (memory, recording),
            wall_s,
            1e3 * (statistics.median(ends[1]) - statistics.median(ends[0])),
            _last_words(process),
        )


def lock_step(hours: float, revolutions: int = 200, tell: Tell = print) -> Result:
    """Step the roller until so much simulated time has passed, and take every sample."""
    with tempfile.TemporaryDirectory(prefix="roller_sim_soak_") as folder:
        blocks = f"pacing.samples_per_message:={SAMPLES}"
        arguments = ("--lock-step", "--ros-args", "-p", blocks)
        with _roller(Path(folder), *arguments) as (process, client, pid):
            client.wait_until_steppable()
            memory, begin = Memory(), time.monotonic()
            wanted = round(hours * 3600.0 * HZ) * SAMPLES
            told = 0.0
            while client.truth.next_sample < wanted:
                left = (wanted - client.truth.next_sample) // SAMPLES
                client.step(min(revolutions, max(1, left)))
                client.lateness_s.clear()
                done = client.truth.next_sample / (SAMPLES * HZ * 3600.0)
                if done - told >= hours / 200.0:
                    told = done
                    memory.add(done, resident_mb(pid))
                    wall_s = time.monotonic() - begin
                    tell(
                        f"{done:7.3f} h simulated, {done * 3600.0 / wall_s:.0f} × real time  "
                        f"{client.truth.samples} samples, {client.truth.lost} lost, {memory.mb[-1]:.1f} MB"
                    )
            wall_s = time.monotonic() - begin
            process.end()
        return _result("lock step", client, (memory, None), wall_s, None, _last_words(process))


def _result(
    what: str,
    client: Client,
    memory: tuple[Memory, Memory | None],
    wall_s: float,
    clock: float | None,
    words: str,
) -> Result:
    truth = client.truth
    between_s = (truth.last_ns - truth.first_ns) * 1e-9
    counted = truth.next_sample - truth.last_size - truth.first_sample
    return Result(
        what=what,
        simulated_s=between_s,
        wall_s=wall_s,
        acceleration=client.acceleration,
        truth=truth,
        drift_samples=counted - between_s * HZ * SAMPLES,
        clock_drift_ms=clock,
        memory=memory[0],
        recording=memory[1],
        last_words=words,
    )


@contextmanager
def _roller(folder: Path, *arguments: str) -> Iterator[tuple[Process, Client, int]]:
    program = [sys.executable, "-m", "roller_sim_ros.commands", "sim", "--scenario", str(SITE)]
    with own_domain() as domain:
        environment = {
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": str(folder),
        }
        process: Process | None = None
        client = Client(domain, lambda: process is None or process.code is None)
        try:
            process = Process("roller", [*program, *arguments], folder / "roller.log", environment)
            yield process, client, process.pid
        except SoakError as error:
            raise SoakError(f"{error}; {process.said() if process else ''}") from error
        finally:
            if process is not None:
                process.end()
            client.close()


def _last_words(process: Process) -> str:
    """Return what the roller said when it ended: late blocks, recorded messages."""
    text = process.log.read_text(encoding="utf-8")
    return " ".join(re.findall(r"^(?:ran|recorded) .*", text, flags=re.MULTILINE))
