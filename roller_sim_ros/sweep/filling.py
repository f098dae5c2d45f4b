# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Filling in the results of a sweep with any executor: threads here, processes, or machines elsewhere."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from typing import TYPE_CHECKING

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.sweep.errors import SweepStopped
from roller_sim_ros.sweep.grid import Grid
from roller_sim_ros.sweep.plan import DEFAULT_REVOLUTIONS, Continuation, Plan
from roller_sim_ros.sweep.records import most_points
from roller_sim_ros.sweep.results import Results
from roller_sim_ros.sweep.task import Outcome, Task, compute, kept_revolutions

if TYPE_CHECKING:
    import xarray

_MOST_LINES = 128
"""Lines of a task: enough that few lanes are empty while the last runs of a task end."""

_MOST_REVOLUTIONS = 500_000
"""Points × revolutions of a task: what takes some tenths of a second at most."""

_WAITING_TASKS = 64
"""Tasks handed to the executor ahead of time."""

Done = Callable[[Outcome], None]


def run(
    grid: Grid,
    *,
    revolutions: int = DEFAULT_REVOLUTIONS,
    continuation: Continuation | None = None,
    early_stop: bool = True,
    executor: Executor | None = None,
    workers: int | None = None,
    results: Results | None = None,
    done: Done | None = None,
) -> xarray.Dataset:
    """Sweep a grid.

    Parameters
    ----------
    grid : Grid
        The points.
    revolutions : int
        Revolutions at each point, of which the last 64 are evaluated.
    continuation : Continuation, optional
        Start each point from its neighbour's final state; otherwise each starts at rest.
    early_stop : bool
        Do not compute revolutions that repeat those before to rounding.
    executor : concurrent.futures.Executor, optional
        Who computes: a pool of processes, ``distributed.Client(…).get_executor()``, …; threads of this process
        when left out. The numbers are the same.
    workers : int, optional
        Threads without an executor; one for each core when left out.
    results : Results, optional
        Results of the same sweep that are there in part: from a file, or from a `SweepStopped`. They are filled in.
    done : callable, optional
        Called with each `Outcome`.

    Returns
    -------
    xarray.Dataset
        Labelled results.

    Raises
    ------
    SweepStopped
        If the executor broke down; its ``results`` hold what was done.
    RollerSimError
        If the results given are those of another sweep.
    """
    plan = Plan(grid, revolutions, continuation, early_stop)
    if results is None:
        results = Results.none_of(plan)
    elif results.plan != plan:
        raise RollerSimError("the results given are those of another sweep")
    with executor_or_threads(executor, workers) as given:
        fill(results, given, done)
    return results.dataset()


@contextmanager
def executor_or_threads(executor: Executor | None, workers: int | None) -> Iterator[Executor]:
    """Yield the executor, or a pool of threads that is shut down afterwards."""
    if executor is not None:
        yield executor
        return
    with ThreadPoolExecutor(workers or len(os.sched_getaffinity(0))) as threads:
        yield threads


def fill(results: Results, executor: Executor, done: Done | None = None) -> None:
    """Compute what is missing.

    When it is interrupted, tasks that have begun are waited for and their points kept.

    Parameters
    ----------
    results : Results
        Filled in.
    executor : concurrent.futures.Executor
        Who computes.
    done : callable, optional
        Called with each `Outcome`, after its points are filled in.

    Raises
    ------
    SweepStopped
        If the executor broke down.
    """

    def take(future: Future[Outcome]) -> None:
        outcome = future.result()
        results.add(outcome)
        if done is not None:
            done(outcome)

    tasks = _tasks(results)
    pending: set[Future[Outcome]] = set()
    finished: set[Future[Outcome]] = set()
    try:
        while True:
            for task in tasks:
                pending.add(executor.submit(compute, task))
                if len(pending) >= _WAITING_TASKS:
                    break
            if not pending:
                return
            finished, pending = wait(pending, return_when=FIRST_COMPLETED)
            while finished:
                take(finished.pop())
    except BaseException as error:
        _keep_begun(pending | finished, take)
        if isinstance(error, BrokenExecutor):
            raise SweepStopped(results, str(error) or type(error).__name__) from error
        raise


def _keep_begun(futures: set[Future[Outcome]], take: Callable[[Future[Outcome]], None]) -> None:
    """Wait for the tasks that cannot be called back, and keep what they give."""
    begun = [future for future in futures if not future.cancel()]
    for future in wait(begun).done:
        if future.exception() is None:
            take(future)


def _tasks(results: Results) -> Iterator[Task]:
    """Yield what is to be done, made when it is asked for: the tasks of a million points are not all there at once."""
    plan = results.plan
    fitting = most_points(
        kept_revolutions(plan.revolutions), plan.grid.base.sampling.samples_per_revolution
    )
    short = _MOST_REVOLUTIONS // (plan.revolutions * plan.line_length)
    lines_each = max(1, min(_MOST_LINES, fitting, short))
    missing = results.missing_lines()
    for first in range(0, len(missing), lines_each):
        yield Task(plan, plan.points(missing[first : first + lines_each]))
