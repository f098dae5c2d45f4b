# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The kernels against the same loop in C, bare and through the layers of Python above them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from benchmarks.cases import CASES, SETTLING_REVOLUTIONS, Case
from benchmarks.errors import BenchmarkError
from benchmarks.kernel_call import KERNELS, REVOLUTIONS, many_revolutions, settled_ground
from benchmarks.options import Options
from benchmarks.reference_loop import FLAGS, reference
from benchmarks.table import Table, ratio
from benchmarks.timing import paired
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.session import Session

ROUNDS = 200
BLOCK = 16
AGREEMENT = 1e-9
"""Of the range of each output row, over REVOLUTIONS periodic revolutions."""

_AIMS = {"two-pole": "≤ 2, 30 ns", "exact": "≤ 2, 80 ns"}


def measure(options: Options) -> Table:
    """Time both kernels on both of the paper's soils."""
    rows: list[tuple[str, ...]] = []
    for model in KERNELS:
        for case in CASES:
            rows += _rows(model, case, options)
    return Table(
        title="Kernel",
        says=(
            "Time per sample of a settled motion at 28 Hz and 1.6 mm, beside the same loop in plain "
            f"C (`reference_loop.c`, {' '.join(FLAGS)}), which gives the same samples to "
            f"{AGREEMENT:g} of their range. Bare: one call over {REVOLUTIONS} revolutions. The "
            "other rows do the same revolutions through the package's layers."
        ),
        columns=("half space, soil, way", "ours/ns", "C/ns", "ours/C", "aim"),
        rows=rows,
    )


def _rows(model: str, case: Case, options: Options) -> list[tuple[str, ...]]:
    ground = settled_ground(model, case)
    call = many_revolutions(model, ground)
    other = call.copy()
    bare, in_c = call.function(), reference(model, other)
    _check(model, case, call.arrays["out"], other.arrays["out"], bare, in_c)
    found: list[tuple[str, ...]] = []
    for way, function in (
        ("bare", bare),
        ("Ground, 128 samples", _repeated(lambda: ground.advance(0, SAMPLES_PER_REVOLUTION), 1)),
        ("Session, 128 samples", _session(model, case, SAMPLES_PER_REVOLUTION)),
        (f"Session, {BLOCK} samples", _session(model, case, BLOCK)),
    ):
        rounds = options.rounds(ROUNDS if way == "bare" else ROUNDS // 2)
        times = paired(in_c, function, rounds=rounds)
        ours, plain = times.second_s / call.samples, times.first_s / call.samples
        found.append(
            (
                f"{model}, {case.name}, {way}",
                f"{ours * 1e9:.1f}",
                f"{plain * 1e9:.1f}",
                ratio(times.ratio),
                _AIMS[model] if way == "bare" else "",
            )
        )
    return found


def _session(model: str, case: Case, block: int) -> Callable[[], None]:
    session = Session(case.configuration(model))
    for _ in range(SETTLING_REVOLUTIONS):
        session.advance(SAMPLES_PER_REVOLUTION)
    return _repeated(lambda: session.advance(block), SAMPLES_PER_REVOLUTION // block)


def _repeated(advance: Callable[[], object], per_revolution: int) -> Callable[[], None]:
    """Return what goes over as many revolutions as a bare call."""

    def run() -> None:
        for _ in range(REVOLUTIONS * per_revolution):
            advance()

    return run


def _check(
    model: str,
    case: Case,
    ours: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    plain: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    bare: Callable[[], None],
    in_c: Callable[[], None],
) -> None:
    bare()
    in_c()
    span = np.abs(ours).max(axis=1)
    apart = np.abs(ours - plain).max(axis=1) / np.where(span > 0.0, span, 1.0)
    worst = int(np.argmax(apart))
    if not apart[worst] <= AGREEMENT:
        names = [name for name in dir(at) if name.startswith("OUT_") and getattr(at, name) == worst]
        raise BenchmarkError(
            f"{model}, {case.name}: kernel and C differ by {apart[worst]:.1g} of the range in {names[0]}; "
            "has the kernel's algorithm changed?"
        )
