# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Estimates: a window of 16 revolutions, beside one run of the model to a settled motion through the same kernels."""

from __future__ import annotations

import time
from statistics import median

import numpy as np

from benchmarks.options import Options
from benchmarks.table import Table, ratio, seconds
from roller_sim_ros.estimate import estimate_window
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.sweep import values_at
from tools.estimate_accuracy import REVOLUTIONS, UNKNOWN, Trip, random_trips

POINTS = 60
MODELS = ("exact", "two-pole", "rational")
AIM = "< 0.5 s"


def measure(_: Options) -> Table:
    """Time windows with noise, all on this thread."""
    rows = [_row(model) for model in MODELS]
    return Table(
        title="Estimate",
        says=(
            f"CPU time on one core for G and p from 16 revolutions of {SAMPLES_PER_REVOLUTION} samples with the noise "
            f"of a sensor, over {POINTS} random grounds and settings (`tools/estimate_accuracy.py`); those without a "
            f"period are not counted. Beside it the median of one run of the model over {REVOLUTIONS} revolutions "
            "(`sweep.values_at`, all of them stepped). The first window on a ground with the rational half space pays "
            "for its fit."
        ),
        columns=("half space", "median", "95 %", "most", "one run", "ratio of medians", "aim"),
        rows=rows,
    )


def _row(model: str) -> tuple[str, ...]:
    trips = random_trips(model, POINTS, seed=21)
    draw = np.random.default_rng(22)
    estimate_window(trips[0].window, trips[0].configuration)
    _run(trips[0].configuration)
    times, runs = [], []
    for trip in trips:
        window, known = trip.with_noise(draw), _known(trip)
        begin = time.thread_time()
        found = estimate_window(window, known)
        taken = time.thread_time() - begin
        if found.period:
            times.append(taken)
            runs.append(_run(trip.configuration))
    typical = median(times)
    return (
        model,
        seconds(typical),
        seconds(float(np.percentile(times, 95))),
        seconds(max(times)),
        seconds(median(runs)),
        ratio(typical / median(runs)),
        AIM,
    )


def _known(trip: Trip) -> Configuration:
    return trip.configuration.changed(UNKNOWN)


def _run(configuration: Configuration) -> float:
    begin = time.thread_time()
    values_at([configuration], REVOLUTIONS, early_stop=False)
    return time.thread_time() - begin
