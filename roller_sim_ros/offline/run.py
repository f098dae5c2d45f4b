# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A run over a number of revolutions, of which the last ones are kept."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import SUMMARY_REVOLUTIONS
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import Block, Session

Step = Callable[[], Block]
"""Steps over the next block and returns it; never over a multiple of 128 samples."""

Progress = Callable[[float], None]
"""Told the share of the run that is done, once a revolution."""


@dataclass(frozen=True)
class Tail:
    """The last revolutions of a run; all arrays of the shape (revolutions × samples_per_revolution,).

    Attributes
    ----------
    samples_per_revolution : int
        Samples in one revolution.
    duration_s : float
        Simulated time at the end.
    excitation_hz : ndarray, shape (revolutions,)
        Excitation frequency.
    synchronous : bool
        Whether every revolution of samples is one of the eccentric, all at one frequency.
    vertical : ndarray
        Vertical acceleration of the drum, m/s².
    soil_force : ndarray
        F_s, N.
    drum_height : ndarray
        Height of the drum over the untouched surface, m.
    contact_state : ndarray of uint8
        LOADING, UNLOADING or AIR.
    """

    samples_per_revolution: int
    duration_s: float
    excitation_hz: NDArray[np.float64]
    synchronous: bool
    vertical: NDArray[np.float64]
    soil_force: NDArray[np.float64]
    drum_height: NDArray[np.float64]
    contact_state: NDArray[np.uint8]

    @property
    def revolutions(self) -> int:
        """Revolutions that it holds."""
        return len(self.excitation_hz)


def step_whole_revolutions(configuration: Configuration, *, run_up: bool) -> Step:
    """Return what steps a new session by whole revolutions."""
    session = Session(configuration, run_up=run_up)
    samples = session.samples_per_revolution
    return lambda: session.advance(samples)


def run(step: Step, revolutions: int, samples_per_revolution: int, progress: Progress) -> Tail:
    """Step over some revolutions and return the last of them, an even number up to 64.

    Parameters
    ----------
    step : callable
        Steps over the next block; all blocks have one size, a divisor of the revolution's.
    revolutions : int
        How many; at least 2.
    samples_per_revolution : int
        Samples in one revolution.
    progress : callable
        Told the share that is done.
    """
    kept = min(SUMMARY_REVOLUTIONS, revolutions - revolutions % 2)
    tail: deque[list[Block]] = deque(maxlen=kept)
    for done in range(revolutions):
        blocks = [step()]
        blocks += [step() for _ in range(samples_per_revolution // len(blocks[0]) - 1)]
        tail.append(blocks)
        progress((done + 1) / revolutions)
    return _joined(tail, samples_per_revolution)


def _joined(tail: deque[list[Block]], samples_per_revolution: int) -> Tail:
    blocks = [block for revolution in tail for block in revolution]
    last = blocks[-1]
    excitation_hz = np.array([revolution[0].excitation_hz for revolution in tail])
    turn = 2.0 * np.pi / samples_per_revolution
    return Tail(
        samples_per_revolution=samples_per_revolution,
        duration_s=last.time_s + len(last) * last.sample_period_s,
        excitation_hz=excitation_hz,
        synchronous=bool(np.ptp(excitation_hz) == 0.0)
        and all(block.phase_increment_rad == turn for block in blocks),
        vertical=np.concatenate([block.acceleration_vertical for block in blocks]),
        soil_force=np.concatenate([block.soil_force for block in blocks]),
        drum_height=np.concatenate([block.drum_height for block in blocks]),
        contact_state=np.concatenate([block.contact_state for block in blocks]),
    )
