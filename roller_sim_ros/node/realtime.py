# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Real-time privileges: tried and reported, never required."""

from __future__ import annotations

import ctypes
import os

_MCL_CURRENT = 1
_PR_SET_TIMERSLACK = 29


def precise_sleeps() -> None:
    """Let the calling thread's sleeps end when they are due, not up to 50 µs later; needs no privilege."""
    nanosecond = ctypes.c_ulong(1)
    ctypes.CDLL(None).prctl(_PR_SET_TIMERSLACK, nanosecond, 0, 0, 0)


def request_realtime(priority: int) -> list[str]:
    """Try to give the calling thread real-time scheduling and a core, and to lock the process's memory.

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
    return [request_scheduling(priority), _affinity(), _memory()]


def request_scheduling(priority: int) -> str:
    """Try to give the calling thread real-time scheduling, which its children do not inherit.

    Parameters
    ----------
    priority : int
        SCHED_FIFO priority; 0: ordinary scheduling again.

    Returns
    -------
    str
        What came of it.
    """
    policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK if priority > 0 else os.SCHED_OTHER
    try:
        # 0 is the calling thread.
        os.sched_setscheduler(0, policy, os.sched_param(max(0, priority)))
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
