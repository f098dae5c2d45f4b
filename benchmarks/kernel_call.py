# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A kernel called bare, for many revolutions at once, from a settled motion."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import SETTLING_REVOLUTIONS, Case, GroundRun
from roller_sim_ros.drum_soil import Ground, exact_kernel, two_pole_kernel
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

Array = NDArray[np.float64]

KERNELS: dict[str, ModuleType] = {"two-pole": two_pole_kernel, "exact": exact_kernel}
REVOLUTIONS = 64
"""Of one bare call: enough that calling costs nothing."""

_ANGLES = ("sine", "cosine")
_HISTORY = ("free", "free_rate")


@dataclass
class KernelCall:
    """The arrays of one call over `samples` samples, by the names of the kernel's arguments."""

    kernel: Callable[..., None]
    samples: int
    arrays: dict[str, Array]

    def copy(self) -> KernelCall:
        """Return a call from the same state with arrays of its own."""
        own = {name: array.copy() for name, array in self.arrays.items()}
        return KernelCall(self.kernel, self.samples, own)

    def function(self) -> Callable[[], None]:
        """Return the call, ready to be timed."""
        arguments = (self.samples, 0, *self.arrays.values())
        kernel = self.kernel

        def run() -> None:
            kernel(*arguments)

        return run


def settled_ground(model: str, case: Case) -> Ground:
    """Return a ground on a settled motion, at the begin of a revolution of constant amplitude."""
    run = GroundRun(model, case)
    run.advance(SETTLING_REVOLUTIONS)
    run.begin()
    return run.ground


def many_revolutions(model: str, ground: Ground) -> KernelCall:
    """Return the call that goes on from a ground's state for REVOLUTIONS revolutions."""
    kernel: Any = KERNELS[model].advance
    names = list(inspect.signature(getattr(kernel, "py_func", kernel)).parameters)
    between = dict(zip(names[2:-1], ground.kernel_arguments, strict=True))
    samples = REVOLUTIONS * SAMPLES_PER_REVOLUTION
    arrays: dict[str, Array] = {}
    for name, array in between.items():
        if name in _ANGLES:
            arrays[name] = np.append(np.tile(array[:-1], REVOLUTIONS), array[-1])
        elif name in _HISTORY:
            arrays[name] = np.append(array, np.zeros(samples - SAMPLES_PER_REVOLUTION))
        else:
            arrays[name] = array.copy()
    arrays[names[-1]] = np.empty((at.OUT_ROWS, samples))
    return KernelCall(kernel, samples, arrays)
