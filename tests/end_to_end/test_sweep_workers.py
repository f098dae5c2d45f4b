# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A sweep on workers of other kinds: processes, and a cluster of dask.distributed; one that dies loses nothing."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from distributed import Client, LocalCluster

from roller_sim_ros.commands.axis_flags import parse_values
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep import Axis, Grid, Plan, Results, SweepStopped, fill, read, run
from roller_sim_ros.sweep.filling import executor_or_threads
from roller_sim_ros.sweep.task import Outcome

REVOLUTIONS = 150
POINTS = 1500
AXES = {"exciter.frequency_hz": "20:35:50", "exciter.amplitude_m": "0.5:2.4:30"}


def grid() -> Grid:
    base = Configuration().changed({"half_space.model": "two-pole"})
    return Grid(tuple(Axis(name, parse_values(name, text)) for name, text in AXES.items()), base)


@pytest.fixture(scope="module")
def by_threads() -> Results:
    results = Results.none_of(Plan(grid(), REVOLUTIONS))
    with executor_or_threads(None, None) as threads:
        fill(results, threads)
    assert results.points_done == POINTS
    return results


@pytest.fixture(scope="module")
def cluster() -> Iterator[LocalCluster]:
    with LocalCluster(  # type: ignore[no-untyped-call]
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as two:
        yield two


def assert_same(results: Results, expected: Results) -> None:
    for name, array in expected.arrays.items():
        np.testing.assert_array_equal(results.arrays[name], array, err_msg=name)


def test_processes_give_the_same_numbers_and_a_killed_one_loses_nothing(
    by_threads: Results,
) -> None:
    killed = False

    def kill(_: Outcome) -> None:
        nonlocal killed
        if not killed:
            os.kill(next(iter(pool._processes)), signal.SIGKILL)
        killed = True

    with (
        ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool,
        pytest.raises(SweepStopped, match="the workers broke down") as stopped,
    ):
        run(grid(), revolutions=REVOLUTIONS, executor=pool, done=kill)
    results = stopped.value.results
    assert 0 < results.points_done < POINTS
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        data = run(grid(), revolutions=REVOLUTIONS, executor=pool, results=results)
    assert_same(results, by_threads)
    np.testing.assert_array_equal(data.cmv, by_threads.arrays["cmv"])


def test_any_executor_of_python(by_threads: Results, cluster: LocalCluster) -> None:
    with Client(cluster) as client:  # type: ignore[no-untyped-call]
        data = run(
            grid(),
            revolutions=REVOLUTIONS,
            executor=client.get_executor(pure=False),  # type: ignore[no-untyped-call]
        )
    for name in ("period", "force_ratio_max", "rmv"):
        np.testing.assert_array_equal(data[name], by_threads.dataset()[name])


def test_a_cluster_whose_worker_is_killed_gives_the_same_numbers(
    by_threads: Results, cluster: LocalCluster, tmp_path: Path
) -> None:
    path = tmp_path / "map.nc"
    command = [
        *(sys.executable, "-m", "roller_sim_ros.commands", "sweep", "--half-space", "two-pole"),
        *("--frequency-hz", "20:35:50", "--amplitude-mm", "0.5:2.4:30"),
        *("--revolutions", str(REVOLUTIONS), "--progress", "--out", str(path)),
        *("--scheduler", cluster.scheduler_address),
    ]
    processes = [worker.pid for worker in cluster.workers.values()]
    assert len(set(processes)) == 2
    assert os.getpid() not in processes
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, bufsize=1) as process:
        assert process.stderr is not None
        shown = ""
        while not re.search(rf" [1-9]\d*/{POINTS} ", shown):
            shown += process.stderr.read(1)
        os.kill(processes[0], signal.SIGKILL)
        said = process.stderr.read()
    assert process.returncode == 0, said
    assert_same(read(path), by_threads)
