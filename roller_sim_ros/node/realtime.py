"""Real-time privileges: tried and reported, never required."""

from __future__ import annotations

import ctypes
import os

_MCL_CURRENT = 1


def request_realtime(priority: int) -> list[str]:
    """Try to give the calling thread real-time scheduling, a core of its own, and locked memory.

    Parameters
    ----------
    priority : int
        SCHED_FIFO priority; 0: nothing is tried.

    Returns
    -------
    list of str
        What was tried and what came of it, one sentence each.
    """
    if priority <= 0:
        return []
    return [_scheduling(priority), _affinity(), _memory()]


def _scheduling(priority: int) -> str:
    try:
        # 0 is the calling thread.
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))
    except OSError as error:
        return f"SCHED_FIFO {priority} refused: {error.strerror}"
    return f"SCHED_FIFO {priority}"


def _affinity() -> str:
    cores = os.sched_getaffinity(0)
    if len(cores) < 2:
        return "only one core"
    core = max(cores)
    try:
        os.sched_setaffinity(0, {core})
    except OSError as error:
        return f"core {core} refused: {error.strerror}"
    return f"core {core}"


def _memory() -> str:
    libc = ctypes.CDLL(None, use_errno=True)
    # What is allocated later may still be paged; locking that too would make allocations fail at the limit.
    if libc.mlockall(_MCL_CURRENT):
        return f"memory lock refused: {os.strerror(ctypes.get_errno())}"
    return "memory locked"
