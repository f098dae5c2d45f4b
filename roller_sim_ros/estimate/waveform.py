# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The repeated waveform in a window of noisy revolutions, or why there is none.

Revolutions that repeat after P of them are averaged over P. What a lag of L revolutions changes tells noise from
motion: noise of a sensor is much the same at all orders, while chaos, a subharmonic or a drift move the drum at low
ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.estimate.status import EstimateError, Status

Array = NDArray[np.float64]

FEWEST_REVOLUTIONS = 4
"""Two repetitions of a double jump."""

PERIODS = (1, 2, 4, 8)
"""Revolutions after which a motion may repeat."""

FEWEST_SAMPLES = 64
"""Per revolution: the blow of a double jump has content up to some 20 orders."""

NOISE_FLOOR_M_S2 = 0.05
"""Amplitude at the excitation frequency below which nothing vibrates, as for the meter."""

SAME = 1.15
"""Factor within which the changes over two lags are the same noise."""

SETTLED = 0.005
"""Share of the peak within which a motion repeats whatever the noise."""

LOOSE = 0.02
"""Share of the peak up to which what changes may have the spectrum of a motion."""

LOW, HIGH = slice(1, 6), slice(10, 21)
"""Orders of motion, and of little but noise. Chaos and subharmonics have 35 times the power at the former and more,
noise as much, also behind a low-pass of some hundred Hz."""

NOISE = 4.0
"""Power at the former over that at the latter up to which what changes is noise."""

DRIFT = 2.0
"""Growth of the change from the period to half the window, or its fall from the first half to the second, at which the
motion has not settled."""

PLATEAU = 3
"""Samples in a row at the extreme that make it the end of a range."""

BESIDE = 2
"""Samples beside a plateau at which its fall is looked at. A parabola that stays within a step of the converter over L
samples has fallen by at most ((L + 2 BESIDE)/L)² steps there, and is off by one step at most."""


@dataclass(frozen=True)
class Waveform:
    """One period of a motion, averaged.

    Attributes
    ----------
    status : Status
        OK, or why there is none.
    period : int
        Revolutions after which the motion repeats; 0 when there is none.
    vertical : ndarray, shape (period × samples per revolution,)
        Vertical acceleration without its mean, m/s², from phase zero on; empty when there is none.
    noise : float
        Standard deviation of a sample of `vertical`, m/s²: what the revolutions differ by, averaged as they are.
    """

    status: Status
    period: int = 0
    vertical: Array = field(default_factory=lambda: np.zeros(0))
    noise: float = float("nan")


def waveform(revolutions: NDArray[np.floating]) -> Waveform:
    """Return the waveform that some revolutions repeat.

    Parameters
    ----------
    revolutions : ndarray, shape (revolutions, samples per revolution)
        Vertical acceleration, m/s², positive up, each row from phase zero to phase zero; a constant does not matter.

    Raises
    ------
    EstimateError
        If it has another shape, or fewer than 64 samples per revolution.
    """
    rows = np.asarray(revolutions, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] < FEWEST_SAMPLES:
        raise EstimateError(
            f"an array of shape {rows.shape} is no window: (revolutions, samples per revolution) is needed, with at "
            f"least {FEWEST_SAMPLES} samples per revolution"
        )
    if len(rows) < FEWEST_REVOLUTIONS:
        return Waveform(Status.TOO_FEW)
    if not np.isfinite(rows).all():
        return Waveform(Status.MISSING)
    rows = rows - rows.mean()
    fundamental = np.exp(-2j * np.pi * np.arange(rows.shape[1]) / rows.shape[1])
    if abs((rows @ fundamental).mean()) * 2.0 / rows.shape[1] < NOISE_FLOOR_M_S2:
        return Waveform(Status.STANDING)
    if is_clipped(rows.ravel()):
        return Waveform(Status.CLIPPED)
    lags = [lag for lag in PERIODS if 2 * lag <= len(rows)]
    changes = {lag: rows[lag:] - rows[:-lag] for lag in lags}
    sizes = {lag: float(np.sqrt(np.mean(change**2) / 2.0)) for lag, change in changes.items()}
    peak = float(np.abs(rows).max())
    enough = max(SAME * min(sizes.values()), SETTLED * peak)
    period = next(lag for lag in lags if sizes[lag] <= enough)
    half = len(rows) // 2 // period * period
    drift = float(np.sqrt(np.mean((rows[half:] - rows[:-half]) ** 2) / 2.0))
    if sizes[period] > SETTLED * peak:
        early, late = (
            float(np.sqrt(np.mean(part**2))) for part in np.array_split(changes[period], 2)
        )
        if drift > DRIFT * sizes[period] or early > DRIFT * late:
            return Waveform(Status.UNSETTLED)
        if sizes[period] > LOOSE * peak and _lowness(changes[period]) > NOISE:
            return Waveform(Status.CHAOTIC)
    whole = len(rows) // period
    vertical = rows[: whole * period].reshape(whole, -1).mean(axis=0)
    return Waveform(Status.OK, period, vertical - vertical.mean(), sizes[period] / math.sqrt(whole))


def _lowness(changes: Array) -> float:
    """Return the mean power at the orders of motion over that at those of noise."""
    power = (np.abs(np.fft.rfft(changes, axis=1)) ** 2).mean(axis=0)
    high = float(power[HIGH].mean())
    return float(power[LOW].mean()) / high if high > 0.0 else np.inf


def is_clipped(samples: Array) -> bool:
    """Tell whether samples stand still at their highest or lowest value as a sensor's do at the end of its range.

    The rounded peak of a coarse converter stands still too; but it falls off by few of the converter's steps, that is
    of the least difference between two values.
    """
    values = np.unique(samples)
    if len(values) < 2:
        return False
    step = float(np.diff(values).min())
    for signed in (samples, -samples):
        at_end = signed == signed.max()
        edges = np.flatnonzero(np.diff(np.concatenate([[False], at_end, [False]]).astype(np.int8)))
        for first, last in zip(edges[::2], edges[1::2], strict=True):
            length = last - first
            before, after = first - BESIDE, last - 1 + BESIDE
            if length < PLATEAU or before < 0 or after >= len(signed):
                continue
            rounded = ((length + 2 * BESIDE) / length) ** 2 + 1.0
            if signed[first] - max(signed[before], signed[after]) > rounded * step:
                return True
    return False
