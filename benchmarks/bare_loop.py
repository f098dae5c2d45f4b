# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m benchmarks.bare_loop PERIOD_S BUSY_S`: absolute deadlines and nothing else, until it is interrupted.

What any Python process on this machine can do at that moment; the node's pacing is compared with it. Busy for as long
as the node is before each deadline, it also shows what the scheduler does to a process that needs the CPU.
"""

from __future__ import annotations

import json
import sys
import time

from benchmarks.interrupts import Interrupted
from benchmarks.percentiles import percentiles
from roller_sim_ros.node.realtime import precise_sleeps


def main() -> None:
    period_s, busy_s = float(sys.argv[1]), float(sys.argv[2])
    interrupted = Interrupted()
    precise_sleeps()
    lateness_s: list[float] = []
    print("ready", flush=True)
    monotonic, sleep, note = time.monotonic, time.sleep, lateness_s.append
    used = time.thread_time
    start = monotonic()
    count = 0
    while not interrupted:
        count += 1
        until_s = used() + busy_s
        while busy_s and used() < until_s:
            pass
        due_s = start + count * period_s
        wait_s = due_s - monotonic()
        if wait_s > 0.0:
            sleep(wait_s)
        note(monotonic() - due_s)
    print(json.dumps({**percentiles(lateness_s), "late": sum(x > period_s for x in lateness_s)}))


if __name__ == "__main__":
    main()
