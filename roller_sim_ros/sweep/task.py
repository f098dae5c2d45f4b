# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A share of a sweep that one worker computes: it can be sent to another process or machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import SUMMARY_REVOLUTIONS
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep.motion import Motion
from roller_sim_ros.sweep.plan import DEFAULT_REVOLUTIONS, Plan
from roller_sim_ros.sweep.records import DEPTH, FORCE, PHASE, VERTICAL, Records
from roller_sim_ros.sweep.roller import Roller
from roller_sim_ros.sweep.settling import settle
from roller_sim_ros.sweep.values import VALUES

DONE = "revolutions_computed"
"""Name of the array that tells how many revolutions were stepped over: none where a point is not done."""

Values = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Task:
    """Some lines of a sweep.

    Attributes
    ----------
    plan : Plan
        What is swept.
    points : ndarray of int, shape (lines, line_length)
        Flat indices into the grid of the points of each line, in the order in which they are computed.
    """

    plan: Plan
    points: NDArray[np.int64]


@dataclass(frozen=True)
class Outcome:
    """What became of a task.

    Attributes
    ----------
    points : ndarray of int, shape (n,)
        Flat indices into the grid.
    values : dict
        {name: ndarray, shape (n,)} of all `VALUES` and of `DONE`.
    """

    points: NDArray[np.int64]
    values: Values


def compute(task: Task) -> Outcome:
    """Step the rollers of a task over their revolutions and evaluate what they settle on."""
    plan = task.plan
    rollers: list[Roller] = []
    parts = []
    for points in task.points.T:
        configurations = [plan.grid.configuration(int(point)) for point in points]
        if rollers:
            for roller, configuration in zip(rollers, configurations, strict=True):
                roller.go_to(configuration)
        else:
            rollers = [Roller(configuration) for configuration in configurations]
        records = _run(rollers, plan.grid.base, plan.revolutions, early_stop=plan.early_stop)
        parts.append(_evaluate(configurations, records))
    values = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return Outcome(task.points.T.reshape(-1), values)


def values_at(
    configurations: Sequence[Configuration],
    revolutions: int = DEFAULT_REVOLUTIONS,
    *,
    early_stop: bool = True,
) -> Values:
    """Return what rollers settle on from rest, at any points, on this core.

    Parameters
    ----------
    configurations : sequence of Configuration
        The points, at least one; with one half space and one number of samples per revolution.
    revolutions : int
        Revolutions at each point, of which the last 64 are evaluated; at least 2.
    early_stop : bool
        Do not compute revolutions that repeat those before to rounding.

    Returns
    -------
    dict
        {name: ndarray, shape (points,)} of all `VALUES` and of `DONE`.
    """
    rollers = [Roller(configuration) for configuration in configurations]
    return _evaluate(
        configurations, _run(rollers, configurations[0], revolutions, early_stop=early_stop)
    )


def kept_revolutions(revolutions: int) -> int:
    """Return how many of a run's last revolutions are evaluated: an even number, as `offline.run` has it."""
    return min(SUMMARY_REVOLUTIONS, revolutions - revolutions % 2)


def _run(
    rollers: Sequence[Roller], alike: Configuration, revolutions: int, *, early_stop: bool
) -> Records:
    """Step rollers over the revolutions of the points at which they are."""
    kept = kept_revolutions(revolutions)
    records = Records(len(rollers), kept, alike.sampling.samples_per_revolution)
    runs = []
    for place, roller in enumerate(rollers):
        run = roller.approach(place, revolutions - kept, records)
        if run is None:
            roller.record(place, records)
        else:
            runs.append(run)
    if runs:
        settle(alike.half_space.model, runs, early_stop, records)
    return records


def _evaluate(configurations: Sequence[Configuration], records: Records) -> Values:
    """Return the values of all points: those of one length of record at a time."""
    kept = records.samples.shape[1]
    values: Values = {
        value.name: np.empty(len(configurations), dtype=value.dtype) for value in VALUES
    }
    values[DONE] = records.computed.astype(np.int32)
    for recorded in np.unique(records.recorded):
        places = np.flatnonzero(records.recorded == recorded)
        # Of a motion that repeats, two periods tell all that the run's last revolutions do.
        times = 1 if recorded == kept else 2
        revolutions = np.tile(np.arange(recorded), times)
        rows = [
            records.samples[places[:, np.newaxis], revolutions, row]
            for row in (VERTICAL, FORCE, DEPTH, PHASE)
        ]
        motion = Motion(
            configurations=[configurations[int(place)] for place in places],
            synchronous=records.synchronous[places],
            vertical=rows[0],
            soil_force=rows[1],
            drum_depth=rows[2],
            contact_state=rows[3],
        )
        for value in VALUES:
            values[value.name][places] = value.of(motion)
    return values
