# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a sweep says of each point; a new value is one function and one line in `VALUES`.

A function takes a `Motion` and returns one number for each of its points: NaN, or `UNKNOWN` among whole numbers, where
there is none to be had.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.mode import Mode, true_mode
from roller_sim_ros.meters.registry import DRUM_METERS, METERS, DrumMeter, HarmonicMeter
from roller_sim_ros.meters.summary import blows
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.sweep.motion import UNKNOWN, Motion

Array = NDArray[np.float64]
Function = Callable[[Motion], NDArray[Any]]


@dataclass(frozen=True)
class Value:
    """One value of a sweep.

    Attributes
    ----------
    name : str
        Name of the variable in a file.
    unit : str
        Its unit, ``1`` for a pure number.
    doc : str
        What it is.
    of : callable
        The function.
    whole : bool
        Whether it is a whole number from 0 to 127.
    labels : tuple of str
        What the whole numbers 0, 1, … mean, where they are names.
    """

    name: str
    unit: str
    doc: str
    of: Function
    whole: bool = False
    labels: tuple[str, ...] = ()

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of its array."""
        return np.dtype(np.int8 if self.whole else np.float64)

    @property
    def missing(self) -> float:
        """What stands where there is no value."""
        return UNKNOWN if self.whole else math.nan


def period(motion: Motion) -> NDArray[np.int8]:
    """Return the period in revolutions, 0 for none."""
    return motion.period


def mode(motion: Motion) -> NDArray[np.int8]:
    """Return the operating mode from the contact states, a `Mode`."""
    modes = [
        true_mode(float(share), None if repeats == UNKNOWN else int(repeats))
        for share, repeats in zip(air_fraction(motion), motion.period, strict=True)
    ]
    return np.where(motion.synchronous, modes, Mode.UNKNOWN).astype(np.int8)


def blows_per_period(motion: Motion) -> NDArray[np.int8]:
    """Return how many contacts begin in one period, 0 where there is none."""
    counts = [
        min(blows(air, max(int(repeats), 0), motion.samples_per_revolution), 127)
        for air, repeats in zip(motion.air, motion.period, strict=True)
    ]
    return np.where(motion.synchronous, counts, UNKNOWN).astype(np.int8)


def force_ratio_max(motion: Motion) -> Array:
    """Return max F_s / F_stat."""
    return np.asarray(motion.soil_force.max(axis=(1, 2)) / motion.static_load_n)


def force_ratio_mean(motion: Motion) -> Array:
    """Return the mean over the blows of the greatest F_s / F_stat of each.

    A blow is what comes between two landings. Of a motion with a period, those of one period count; of others, all
    whole ones. Where the drum does not leave the ground, each revolution counts as a blow.
    """
    means = [_mean_peak(motion, point) for point in range(motion.points)]
    return np.array(means) / motion.static_load_n


def acceleration_max_g(motion: Motion) -> Array:
    """Return the greatest vertical coordinate acceleration, g."""
    return np.asarray(motion.vertical.max(axis=(1, 2)) / GRAVITY_M_S2)


def acceleration_min_g(motion: Motion) -> Array:
    """Return the least vertical coordinate acceleration, g."""
    return np.asarray(motion.vertical.min(axis=(1, 2)) / GRAVITY_M_S2)


def air_fraction(motion: Motion) -> Array:
    """Return the share of the samples without contact."""
    return np.asarray(np.count_nonzero(motion.air, axis=1) / motion.air.shape[1])


def harmonic(meter: HarmonicMeter) -> Function:
    """Return the function of a meter value that follows from the harmonics of the acceleration."""

    def value(motion: Motion) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            values = np.asarray(meter.value(motion.harmonics))
        known = motion.synchronous & (np.asarray(motion.harmonics.amplitude(1.0)) > 0.0)
        return np.where(known, values, math.nan)

    return value


def of_drum(meter: DrumMeter) -> Function:
    """Return the function of a meter value that needs the eccentric's phase and the machine."""

    def value(motion: Motion) -> Array:
        return np.where(motion.synchronous, meter.value(motion.drum_motion), math.nan)

    return value


def _mean_peak(motion: Motion, point: int) -> float:
    """Return the mean over blows of a point's greatest force, N."""
    samples = motion.samples_per_revolution
    repeats = max(int(motion.period[point]), 0)
    window = repeats * samples or motion.air.shape[1]
    air = motion.air[point, -window:]
    force = motion.soil_force[point].reshape(-1)[-window:]
    landings = np.flatnonzero(air[:-1] & ~air[1:]) + 1
    if repeats and air[-1] and not air[0]:
        landings = np.concatenate(([0], landings))
    if len(landings) < (1 if repeats else 2):
        return float(force.reshape(-1, samples).max(axis=1).mean())
    if not repeats:
        # The window has an end: what it cuts off is no whole blow.
        return float(np.maximum.reduceat(force[: landings[-1]], landings[:-1]).mean())
    peaks = np.maximum.reduceat(force, landings)
    if landings[0] > 0:
        peaks[-1] = max(peaks[-1], force[: landings[0]].max())
    return float(peaks.mean())


VALUES: tuple[Value, ...] = (
    Value("period", "1", "revolutions after which the motion repeats; 0: none", period, whole=True),
    Value(
        "mode",
        "1",
        "operating mode from the contact states and the period",
        mode,
        whole=True,
        labels=tuple(item.label for item in Mode),
    ),
    Value("force_ratio_max", "1", "greatest soil force over the static one", force_ratio_max),
    Value(
        "force_ratio_mean",
        "1",
        "mean over the blows of the greatest soil force over the static one",
        force_ratio_mean,
    ),
    Value(
        "blows_per_period",
        "1",
        "contacts that begin in one period; 0: no period",
        blows_per_period,
        whole=True,
    ),
    Value("air_fraction", "1", "share of the time in the air", air_fraction),
    Value(
        "acceleration_max_g", "g", "greatest vertical coordinate acceleration", acceleration_max_g
    ),
    Value("acceleration_min_g", "g", "least vertical coordinate acceleration", acceleration_min_g),
    *(Value(item.name, item.unit or "1", item.source, harmonic(item)) for item in METERS),
    *(Value(item.name, item.unit or "1", item.source, of_drum(item)) for item in DRUM_METERS),
)
"""Every value, in the order in which a file has them."""
