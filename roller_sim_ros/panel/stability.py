# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The map of operating modes over frequency and amplitude, computed in another process that stands back."""

from __future__ import annotations

import multiprocessing
import os
import signal
from contextlib import suppress
from dataclasses import dataclass
from multiprocessing.pool import AsyncResult, Pool
from typing import Any

import numpy as np

from roller_sim_ros.parameters import Configuration

LEVELS = ((9, 9, 100), (31, 26, 200))
"""Frequencies, amplitudes, revolutions: coarse first."""

FREQUENCIES_HZ = (15.0, 45.0)
AMPLITUDES_M = (0.1e-3, 2.6e-3)
"""What the map spans at least."""
BEYOND_HZ, BEYOND_M = 5.0, 0.4e-3
"""How far it goes beyond a commanded point that lies outside."""

CHANGE = 0.1
"""Share by which G or p must change for a map to be computed anew."""


@dataclass(frozen=True)
class Grid:
    """What is to be computed.

    Attributes
    ----------
    configuration : Configuration
        Machine and ground.
    highest_hz, highest_m : float
        The last frequency and amplitude.
    """

    configuration: Configuration
    highest_hz: float
    highest_m: float

    def serves(self, other: Grid) -> bool:
        """Return whether this one's map may be shown for the other's."""
        own, wanted = self.configuration.soil, other.configuration.soil
        near = (
            abs(own.shear_modulus_pa / wanted.shear_modulus_pa - 1.0) <= CHANGE
            and abs(own.plastic_parameter_m / wanted.plastic_parameter_m - 1.0) <= CHANGE
        )
        same = _without_ground(self.configuration) == _without_ground(other.configuration)
        return (
            near
            and same
            and (self.highest_hz, self.highest_m) == (other.highest_hz, other.highest_m)
        )


def grid(configuration: Configuration, frequency_hz: float, amplitude_m: float) -> Grid:
    """Return the grid for a machine on its ground that holds the commanded point."""
    quantity = {
        "hz": _beyond(FREQUENCIES_HZ[1], frequency_hz, BEYOND_HZ),
        "m": _beyond(AMPLITUDES_M[1], amplitude_m, BEYOND_M),
    }
    return Grid(configuration, min(80.0, quantity["hz"]), min(5e-3, quantity["m"]))


def compute(wanted: Grid, level: int) -> dict[str, Any]:
    """Return the map for the page: axes, mode of each point, and the ground that it holds for.

    Returns
    -------
    dict
        ``frequencies_hz``, ``amplitudes_m``; ``modes``, one row for each amplitude; ``shear_modulus_pa``,
        ``plastic_parameter_m``; ``fine``, whether no finer one follows.
    """
    # Only the worker needs them.
    from roller_sim_ros import sweep

    columns, rows, revolutions = LEVELS[level]
    axes = (
        sweep.Axis.of("exciter.amplitude_m", np.linspace(AMPLITUDES_M[0], wanted.highest_m, rows)),
        sweep.Axis.of(
            "exciter.frequency_hz", np.linspace(FREQUENCIES_HZ[0], wanted.highest_hz, columns)
        ),
    )
    found = sweep.run(sweep.Grid(axes, wanted.configuration), revolutions=revolutions, workers=1)
    soil = wanted.configuration.soil
    return {
        "kind": "map",
        "amplitudes_m": list(axes[0].values),
        "frequencies_hz": list(axes[1].values),
        "modes": found["mode"].values.astype(int).tolist(),
        "shear_modulus_pa": soil.shear_modulus_pa,
        "plastic_parameter_m": soil.plastic_parameter_m,
        "fine": level == len(LEVELS) - 1,
    }


class Stability:
    """Computes a map whenever machine or ground have changed; asked again and again, it never waits.

    Attributes
    ----------
    map : dict or None
        The last one, as `compute` returns it.
    """

    def __init__(self) -> None:
        self.map: dict[str, Any] | None = None
        self._pool: Pool | None = None
        self._job: AsyncResult[dict[str, Any]] | None = None
        self._grid: Grid | None = None
        self._next = 0

    def look(self, wanted: Grid) -> bool:
        """Go on with what is wanted; return whether there is a new map."""
        new = False
        if self._job is not None:
            if not self._job.ready():
                return False
            self.map = self._job.get()
            self._job = None
            new = True
        if self._grid is None or not self._grid.serves(wanted):
            self._grid, self._next = wanted, 0
        if self._next < len(LEVELS):
            if self._pool is None:
                # A fork would take along threads and sockets.
                self._pool = multiprocessing.get_context("spawn").Pool(1, _stand_back)
            self._job = self._pool.apply_async(compute, (self._grid, self._next))
            self._next += 1
        return new

    def close(self) -> None:
        """End the worker."""
        if self._pool is not None:
            self._pool.terminate()
            self._pool.join()


def _stand_back() -> None:
    """Let the worker run only when nobody else wants to."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(19)
    with suppress(OSError, AttributeError):
        os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))


def _beyond(usual: float, commanded: float, further: float) -> float:
    """Return the end of an axis: the usual one, or in steps one beyond what is commanded."""
    if commanded <= usual:
        return usual
    return further * (int(commanded / further) + 1)


def _without_ground(configuration: Configuration) -> Configuration:
    soil = Configuration().soil
    return configuration.changed(
        {
            "soil.shear_modulus_pa": soil.shear_modulus_pa,
            "soil.plastic_parameter_m": soil.plastic_parameter_m,
        }
    )
