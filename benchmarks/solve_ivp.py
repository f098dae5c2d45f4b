# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The two-pole kernel against scipy's `solve_ivp` with events, at matched accuracy."""

from __future__ import annotations

import copy
import itertools
import math
import time
from dataclasses import dataclass

import numpy as np

from benchmarks.cases import AMPLITUDE_M, CASES, FREQUENCY_HZ, Case, GroundRun
from benchmarks.errors import BenchmarkError
from benchmarks.options import Options
from benchmarks.plain_model import Method, PlainRoller, Samples
from benchmarks.table import Table, ratio, seconds
from benchmarks.timing import paired
from roller_sim_ros.drum_soil import Ground
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.meters import Summary, summarise
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

SETTLING = 100
COMPARED = 8
TIMED = 4
ROUNDS = 25
METHODS: tuple[Method, ...] = ("RK45", "DOP853", "LSODA")
TOLERANCES = tuple(10.0**-n for n in range(3, 13))
CONVERGED = 1e-12


@dataclass(frozen=True)
class Solver:
    """A setting of `solve_ivp`, its error and what it took."""

    method: Method
    rtol: float
    error: float
    seconds: float


def measure(options: Options) -> Table:
    """Compare on both of the paper's soils."""
    rows, notes = [], []
    for case in CASES:
        row, note = _compared(case, options)
        rows.append(row)
        notes.append(note)
    return Table(
        title="solve_ivp",
        says=(
            f"One revolution at {FREQUENCY_HZ:g} Hz and {AMPLITUDE_M * 1e3:g} mm, "
            f"{SAMPLES_PER_REVOLUTION} samples, through `Ground.advance`, beside the same phases "
            "written plainly for scipy's `solve_ivp` with events (`plain_model.py`). The error is "
            "the root mean square of the force's, over its maximum, against a solution with rtol "
            f"{CONVERGED:g}; of {', '.join(METHODS)} and tolerances in decades, the fastest that "
            "is at least as accurate as the kernel is taken."
        ),
        columns=("soil", "kernel", "error", "solve_ivp", "error", "with", "ratio", "aim"),
        rows=rows,
        notes=notes,
    )


def _compared(case: Case, options: Options) -> tuple[tuple[str, ...], str]:
    ground, ours = _kernel(case)
    settled = _plain(case)
    settled.run(SETTLING, method="DOP853", rtol=CONVERGED)
    converged = copy.deepcopy(settled).run(COMPARED, method="DOP853", rtol=CONVERGED)
    error = _error(ours, converged)
    solver = _matched(settled, converged, error)

    def kernel() -> None:
        ground.advance(0, SAMPLES_PER_REVOLUTION)

    def plain() -> None:
        copy.deepcopy(settled).run(TIMED, method=solver.method, rtol=solver.rtol)

    times = paired(kernel, plain, rounds=options.rounds(ROUNDS), repeat_first=1000)
    row = (
        case.name,
        seconds(times.first_s),
        f"{error:.0e}",
        seconds(times.second_s / TIMED),
        f"{solver.error:.0e}",
        f"{solver.method}, rtol {solver.rtol:.0e}",
        ratio(times.ratio / TIMED),
        "≥ 1000",
    )
    found, expected = _summary(ours), _summary(converged)
    note = f"{case.name}, kernel and converged solution: " + ", ".join(
        f"{name} {a:.6g} and {b:.6g}"
        for name, a, b in (
            ("period", found.period or 0, expected.period or 0),
            ("F_max/F_stat", found.force_ratio_max, expected.force_ratio_max),
            ("CMV", found.cmv, expected.cmv),
        )
    )
    return row, f"{note}."


def _kernel(case: Case) -> tuple[Ground, Samples]:
    run = GroundRun("two-pole", case)
    run.advance(SETTLING)
    rows = run.advance(COMPARED)
    return run.ground, Samples(
        rows[at.OUT_VERTICAL], rows[at.OUT_FORCE], rows[at.OUT_PHASE].astype(np.uint8)
    )


def _plain(case: Case) -> PlainRoller:
    return PlainRoller(case.shear_modulus_pa, case.plastic_parameter_m, FREQUENCY_HZ, AMPLITUDE_M)


def _matched(settled: PlainRoller, converged: Samples, error: float) -> Solver:
    """Return the fastest setting that is as accurate as the kernel."""
    found = []
    for method, rtol in itertools.product(METHODS, TOLERANCES):
        roller = copy.deepcopy(settled)
        start = time.thread_time()
        samples = roller.run(COMPARED, method=method, rtol=rtol)
        took = time.thread_time() - start
        found.append(Solver(method, rtol, _error(samples, converged), took))
    good = [solver for solver in found if solver.error <= error]
    if not good:
        raise BenchmarkError(f"no setting of solve_ivp is as accurate as the kernel ({error:.1g})")
    return min(good, key=lambda solver: solver.seconds)


def _error(samples: Samples, converged: Samples) -> float:
    difference = samples.force - converged.force
    return math.sqrt(float(np.mean(difference**2))) / float(converged.force.max())


def _summary(samples: Samples) -> Summary:
    load = CASES[0].configuration("two-pole").machine.static_load_n
    return summarise(samples.acceleration, samples.force, samples.phase, load)
