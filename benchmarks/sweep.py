# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sweeps: eight lanes against eight lanes in C, the map of Figure 16, threads against processes, memory."""

from __future__ import annotations

import os
import resource
import time
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np

from benchmarks.options import Options
from benchmarks.reference_loop import FLAGS
from benchmarks.sweep_lanes import AGREEMENT, REVOLUTIONS, EightRuns
from benchmarks.table import Table, ratio, seconds
from benchmarks.timing import paired
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.sweep import Axis, Grid, Plan, Results, fill
from roller_sim_ros.sweep.lane_rows import LANES
from roller_sim_ros.sweep.task import DONE

ROUNDS = 30
SETTLING_REVOLUTIONS = 300
POINTS_A_SIDE = 101
SMALL_SIDE = 5
"""Of a map that only has everything compiled."""
QUICK_SIDE = 15

_MOTIONS = {
    "nothing happens (A = 0)": (0.0, 80e6, 0.5e-3),
    "continuous contact (G 80 MPa, 0.2 mm)": (0.2e-3, 80e6, 0.5e-3),
    "lift-off (G 35 MPa, 1.6 mm)": (1.6e-3, 35e6, 0.8e-3),
    "double jump (G 80 MPa, 1.6 mm)": (1.6e-3, 80e6, 0.5e-3),
}
_AIMS = {"two-pole": "< 5 s", "exact": "< 20 s", "rational": ""}


def measure(options: Options) -> Table:
    """Time the lanes, then whole maps."""
    cores = len(os.sched_getaffinity(0))
    side = QUICK_SIDE if options.quick else POINTS_A_SIDE
    rounds = options.rounds(ROUNDS)
    rows = [_lanes(name, rounds, *motion) for name, motion in _MOTIONS.items()]
    for model, aim in _AIMS.items():
        with ThreadPoolExecutor(cores) as threads:
            _map(model, threads, SMALL_SIDE)
            rows.append(_row(f"{model} map, {cores} threads", _map(model, threads, side), aim))
    with ProcessPoolExecutor(cores, mp_context=get_context("spawn")) as processes:
        _map("two-pole", processes, SMALL_SIDE)
        timing = _map("two-pole", processes, side)
        rows.append(_row(f"two-pole map, {cores} processes", timing, "", here=False))
    with ThreadPoolExecutor(cores) as threads:
        full = _map("two-pole", threads, side, early_stop=False)
    rows.append(_row(f"two-pole map, {cores} threads, all revolutions", full, ""))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Table(
        title="Sweep",
        says=(
            f"Lanes: CPU time per sample of one of {LANES} two-pole trajectories around 28 Hz, {REVOLUTIONS} "
            f"revolutions, beside a loop in C over {LANES} lanes (`sweep_lanes.c`, {' '.join(FLAGS)}) "
            f"whose states agree to {AGREEMENT:g}. Maps: {side} × {side} points of frequency "
            "(15 … 40 Hz) and amplitude (0.1 … 2.5 mm) at G 80 MPa, p 0.5 mm, 500 revolutions each; wall time "
            "beside CPU time over cores, which is what the wall time comes to when nobody else uses them."
        ),
        columns=("what", "ours", "beside it", "ratio", "aim"),
        rows=rows,
        notes=[
            f"Greatest memory of this process over all of it: {peak:.0f} MB.",
            _per_sample(full),
        ],
    )


class _Timing:
    """Results of a map and what they took."""

    def __init__(self, results: Results, wall_s: float, cpu_s: float) -> None:
        self.results = results
        self.wall_s = wall_s
        self.cpu_s = cpu_s


def _lanes(
    name: str, rounds: int, amplitude: float, modulus: float, plastic: float
) -> tuple[str, ...]:
    configurations = [
        Configuration().changed(
            {
                "half_space.model": "two-pole",
                "exciter.amplitude_m": amplitude * (1.0 + 0.01 * lane),
                "soil.shear_modulus_pa": modulus,
                "soil.plastic_parameter_m": plastic,
            }
        )
        for lane in range(LANES)
    ]
    runs = EightRuns(configurations, SETTLING_REVOLUTIONS)
    runs.check()
    times = paired(runs.in_c, runs.ours, rounds=rounds)
    return (
        f"lanes, {name}",
        seconds(times.second_s / runs.samples),
        f"C: {seconds(times.first_s / runs.samples)}",
        ratio(times.ratio),
        "≤ 2",
    )


def _map(model: str, executor: Executor, side: int, *, early_stop: bool = True) -> _Timing:
    """Compute the map of Figure 16 with so many points a side."""
    base = Configuration().changed(
        {
            "half_space.model": model,
            "soil.shear_modulus_pa": 80e6,
            "soil.plastic_parameter_m": 0.5e-3,
        }
    )
    axes = (
        Axis.of("exciter.frequency_hz", np.linspace(15.0, 40.0, side)),
        Axis.of("exciter.amplitude_m", np.linspace(0.1e-3, 2.5e-3, side)),
    )
    results = Results.none_of(Plan(Grid(axes, base), early_stop=early_stop))
    wall, cpu = time.perf_counter(), time.process_time()
    fill(results, executor)
    return _Timing(results, time.perf_counter() - wall, time.process_time() - cpu)


def _row(name: str, timing: _Timing, aim: str, *, here: bool = True) -> tuple[str, ...]:
    """Return a row; the CPU time of other processes is not known here."""
    even = timing.cpu_s / len(os.sched_getaffinity(0))
    return (
        name,
        f"{timing.wall_s:.1f} s",
        f"CPU / cores: {even:.1f} s" if here else "",
        ratio(timing.wall_s / even) if here else "",
        aim,
    )


def _per_sample(timing: _Timing) -> str:
    samples = int(timing.results.arrays[DONE].sum()) * SAMPLES_PER_REVOLUTION
    return (
        f"All revolutions of the map are {samples / 1e6:.0f} million samples: "
        f"{timing.cpu_s / samples * 1e9:.1f} ns of CPU time each, values included."
    )
