"""A share of a sweep that one worker computes: it can be sent to another process or machine."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.sweep.motion import Motion
from roller_sim_ros.sweep.plan import Plan
from roller_sim_ros.sweep.roller import Roller, Settled
from roller_sim_ros.sweep.values import VALUES

DONE = "revolutions_computed"
"""Name of the array that tells how many revolutions were stepped over: none where a point is not done."""

ROWS = (at.OUT_VERTICAL, at.OUT_FORCE, at.OUT_DEPTH, at.OUT_PHASE)
"""What of the kernels' output is evaluated."""


@dataclass(frozen=True)
class Task:
    """Some lines of a sweep.

    Attributes
    ----------
    plan : Plan
        What is swept.
    lines : tuple of int
        Numbers of the lines.
    """

    plan: Plan
    lines: tuple[int, ...]


@dataclass(frozen=True)
class Outcome:
    """What became of a task.

    Attributes
    ----------
    points : ndarray of int, shape (n,)
        Flat indices into the grid.
    values : dict
        {name: ndarray, shape (n,)} of all values and of `DONE`.
    """

    points: NDArray[np.int64]
    values: dict[str, NDArray[Any]]


def compute(task: Task) -> Outcome:
    """Step the rollers of a task over their revolutions and evaluate what they settled on."""
    points: list[int] = []
    settled: list[Settled] = []
    for line in task.lines:
        for point, result in _along(task.plan, task.plan.line(line)):
            points.append(point)
            settled.append(result)
    samples = np.stack([item.samples for item in settled])
    motion = Motion(
        configurations=[task.plan.grid.configuration(point) for point in points],
        synchronous=np.array([item.synchronous for item in settled]),
        vertical=samples[:, :, at.OUT_VERTICAL],
        soil_force=samples[:, :, at.OUT_FORCE],
        drum_height=-samples[:, :, at.OUT_DEPTH],
        contact_state=samples[:, :, at.OUT_PHASE],
    )
    values = {value.name: np.asarray(value.of(motion), dtype=value.dtype) for value in VALUES}
    values[DONE] = np.array([item.computed for item in settled], dtype=np.int32)
    return Outcome(np.array(points), values)


def _along(plan: Plan, line: list[int]) -> Iterator[tuple[int, Settled]]:
    """Yield the points of a line with what the roller settled on, each from where the one before ended."""
    roller = Roller(plan.grid.configuration(line[0]))
    for point in line:
        roller.go_to(plan.grid.configuration(point))
        yield point, roller.settle(plan.revolutions, early_stop=plan.early_stop)
