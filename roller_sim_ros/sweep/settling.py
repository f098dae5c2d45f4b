# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Rollers stepped over revolutions of one plan inside compiled code, down to what they settle on."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import exact_kernel, rational_kernel
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.jit import njit
from roller_sim_ros.sweep import lanes
from roller_sim_ros.sweep.records import Records
from roller_sim_ros.sweep.repetition import WATCH_ROWS, begin_watch, repeats

Array = NDArray[np.float64]
Arguments = tuple[Any, ...]
Loop = Callable[[int, bool, Array, Arguments, Array], tuple[int, int]]

_own = threading.local()


@dataclass(frozen=True)
class Run:
    """What is stepped: at the start of a revolution that all its others are like.

    Attributes
    ----------
    place : int
        Number of its point in the records.
    arguments : tuple
        What the kernel takes between the samples and the output: state and constants come first.
    scales : ndarray, shape (STATE_SIZE,)
        Sizes of its state's values, see `repetition`.
    before : int
        Revolutions before those that are recorded.
    """

    place: int
    arguments: Arguments
    scales: Array
    before: int


@njit
def _exact(
    revolutions: int, watching: bool, watch: Array, arguments: Arguments, out: Array
) -> tuple[int, int]:
    """Step over at most some revolutions, the last of them into `out`; return how many, and the period found."""
    for done in range(1, revolutions + 1):
        every: Arguments = (out.shape[2], 0) + arguments + (out[(done - 1) % out.shape[0]],)  # noqa: RUF005
        exact_kernel.advance(*every)
        if watching:
            period = repeats(arguments[0], watch)
            if period > 0 and (revolutions - done) % period == 0:
                return done, period
    return revolutions, 0


@njit
def _rational(
    revolutions: int, watching: bool, watch: Array, arguments: Arguments, out: Array
) -> tuple[int, int]:
    """As `_exact`."""
    for done in range(1, revolutions + 1):
        every: Arguments = (out.shape[2], 0) + arguments + (out[(done - 1) % out.shape[0]],)  # noqa: RUF005
        rational_kernel.advance(*every)
        if watching:
            period = repeats(arguments[0], watch)
            if period > 0 and (revolutions - done) % period == 0:
                return done, period
    return revolutions, 0


def settle(model: str, runs: Sequence[Run], early_stop: bool, records: Records) -> None:
    """Step runs to their end and record their last revolutions, or one period of those that repeat to rounding.

    Parameters
    ----------
    model : str
        Kind of half space, the same for all.
    runs : sequence of Run
        At the start of the first revolution; their states go on.
    early_stop : bool
        Stop where the motion repeats to rounding.
    records : Records
        Receives the revolutions; ``computed`` is added to.
    """
    if model == "two-pole":
        for before in sorted({run.before for run in runs}):
            alike = [run for run in runs if run.before == before]
            _settle_in_lanes(alike, before, early_stop, records)
        return
    loop: Loop = {"exact": _exact, "rational": _rational}[model]
    for run in runs:
        _settle_alone(loop, run, early_stop, records)


def _settle_alone(loop: Loop, run: Run, early_stop: bool, records: Records) -> None:
    kept, _, in_revolution = records.samples.shape[1:]
    out = _memory("out", (kept, at.OUT_ROWS, in_revolution))
    watch = _memory("watch", (WATCH_ROWS, at.STATE_SIZE))
    begin_watch(run.scales, watch)
    done, period = loop(run.before, early_stop, watch, run.arguments, out[:1])
    recorded = period or kept
    loop(recorded, False, watch, run.arguments, out[:recorded])
    for revolution in range(recorded):
        records.keep(run.place, revolution, out[revolution])
    records.recorded[run.place] = recorded
    records.computed[run.place] += done + recorded


def _settle_in_lanes(runs: Sequence[Run], before: int, early_stop: bool, records: Records) -> None:
    memory: lanes.LaneMemory | None = getattr(_own, "lanes", None)
    if memory is None:
        memory = _own.lanes = lanes.LaneMemory()
    states = np.array([run.arguments[0] for run in runs])
    every: Arguments = (
        np.array([run.arguments[1] for run in runs]),
        states,
        np.array([run.scales for run in runs]),
        before,
        records.samples.shape[1],
        early_stop,
        *runs[0].arguments[2:],
        memory.lanes,
        memory.runs,
        memory.watches,
        np.array([run.place for run in runs]),
        records.samples,
        records.recorded,
        records.computed,
    )
    lanes.settle(*every)
    for run, state in zip(runs, states, strict=True):
        run.arguments[0][:] = state


def _memory(name: str, shape: tuple[int, ...]) -> Array:
    """Return this thread's scratch of a name."""
    array: Array | None = getattr(_own, name, None)
    if array is None or array.shape != shape:
        array = np.empty(shape)
        setattr(_own, name, array)
    return array
