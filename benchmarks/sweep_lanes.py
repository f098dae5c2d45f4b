# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Eight trajectories side by side: ours against sweep_lanes.c, compiled on the spot, on the same arrays."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from benchmarks.errors import BenchmarkError
from benchmarks.reference_loop import compiled
from roller_sim_ros.drum_soil import TwoPoleGround
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.sweep import lanes
from roller_sim_ros.sweep.lane_rows import LANES
from roller_sim_ros.sweep.records import Records

Array = NDArray[np.float64]

REVOLUTIONS = 100
AGREEMENT = 1e-9
"""Of the range of a state's value, after REVOLUTIONS revolutions of a settled motion."""

_SOURCE = Path(__file__).parent / "sweep_lanes.c"


class EightRuns:
    """Eight two-pole rollers, settled, at the start of a revolution."""

    def __init__(self, configurations: list[Configuration], settling: int) -> None:
        assert len(configurations) == LANES
        grounds = [_settled(configuration, settling) for configuration in configurations]
        self._start = np.array([ground.state for ground in grounds])
        self._constants = np.array([ground.kernel_arguments[1] for ground in grounds])
        self._shared = grounds[0].kernel_arguments[2:]
        self._memory = lanes.LaneMemory()
        self._records = Records(LANES, 2, SAMPLES_PER_REVOLUTION)
        self.samples = LANES * REVOLUTIONS * SAMPLES_PER_REVOLUTION

    def ours(self) -> Array:
        """Step over the revolutions; return the final states."""
        states: Array = self._start.copy()
        sine, cosine, modes, bends = self._shared
        lanes.settle(
            self._constants,
            states,
            np.ones_like(states),
            REVOLUTIONS - 2,
            2,
            False,
            sine,
            cosine,
            modes,
            bends,
            self._memory.lanes,
            self._memory.runs,
            self._memory.watches,
            np.arange(LANES),
            self._records.samples,
            self._records.recorded,
            self._records.computed,
        )
        return states

    def in_c(self) -> Array:
        """As `ours`, by the loop in C."""
        states: Array = self._start.copy()
        sine, cosine = self._shared[:2]
        _lanes_in_c()(
            ctypes.c_long(REVOLUTIONS),
            _pointer(states),
            _pointer(self._constants),
            ctypes.c_long(self._constants.shape[1]),
            _pointer(sine),
            _pointer(cosine),
        )
        return states

    def check(self) -> None:
        """Refuse to compare what does not do the same."""
        here, there = self.ours(), self.in_c()
        span = np.abs(here).max(axis=0)
        apart = np.abs(here - there).max(axis=0) / np.where(span > 0.0, span, 1.0)
        if not apart[: at.UNSETTLED_STEPS].max() <= AGREEMENT:
            raise BenchmarkError(
                f"lanes and C differ by {apart.max():.1g} of the range; has the algorithm changed?"
            )


def _settled(configuration: Configuration, revolutions: int) -> TwoPoleGround:
    drive = ExciterDrive(configuration.exciter, configuration.sampling.floor_hz, run_up=False)
    ground = TwoPoleGround(
        configuration.machine,
        configuration.soil,
        configuration.half_space,
        configuration.exciter,
        SAMPLES_PER_REVOLUTION,
    )
    ground.begin(drive.next_revolution(), configuration.soil)
    for _ in range(revolutions):
        ground.advance(0, SAMPLES_PER_REVOLUTION)
    return ground


@lru_cache(maxsize=1)
def _lanes_in_c() -> Callable[..., None]:
    function: Callable[..., None] = compiled(_SOURCE).lanes
    function.restype = None  # type: ignore[attr-defined]
    return function


def _pointer(array: Array) -> object:
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
