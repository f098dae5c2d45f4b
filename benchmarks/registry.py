# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All benchmarks by name, in the order of the document, where each has its part; each is imported when it runs."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from benchmarks.options import Options
from benchmarks.table import Table

BENCHMARKS = {
    "kernel": "ns per sample of both kernels, bare and through Python, against plain C",
    "solve_ivp": "the two-pole kernel against scipy's solve_ivp at matched accuracy",
    "sweep": "lanes against eight lanes in C, whole maps, threads against processes, memory",
    "offline": "times real time without ROS, with and without messages; what a saved state costs",
    "estimate": "a window of 16 revolutions, beside one run of the model",
    "node": "the real-time node: lateness against a bare loop, share of a core, lost samples",
    "panel": "the live page beside the node: lateness without and with it, frames drawn, CPU time",
    "lock_step": "times real time in lock step, with DDS, a recording and a client in the loop",
    "start": "from the start of roller-sim sim to the first sample, beside a plain publisher",
    "startup": "import times of the commands and the heaviest imports",
}
"""{name: what it measures}; the module benchmarks.<name> has measure(Options) -> Table."""


def measure(name: str, options: Options) -> Table:
    """Run one benchmark."""
    function: Callable[[Options], Table] = import_module(f"benchmarks.{name}").measure
    return function(options)
