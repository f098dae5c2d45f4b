# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""By how much the meter's values lag the truth: the place of the peak of their cross-correlation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

EARLIEST = 4
"""Revolutions by which a meter with a shorter window than the truth's may be early."""

LEAST_PAIRS = 64
LEAST_VARIATION = 0.01
"""Standard deviation of the true value over its mean, below which there is nothing to correlate with."""

LEAST_CORRELATION = 0.7
DISTINCT = 1.5
"""Lags whose unexplained share is not larger by this factor than that of the peak could be the right one as well."""

WIDEST_S = 0.5
"""Largest width of the lags that could be right, for the latency to be known."""


@dataclass(frozen=True)
class Latency:
    """A lag of the meter's values.

    Attributes
    ----------
    revolutions : int
        In whole revolutions; 0 where it is not known.
    seconds : float
        Between revolutions too; NaN where it is not known.
    reason : str
        Why it is not known.
    """

    revolutions: int = 0
    seconds: float = math.nan
    reason: str = ""


def find_latency(
    value: NDArray[np.float64], true: NDArray[np.float64], period_s: float, longest_s: float
) -> Latency:
    """Return the lag at which a series correlates best with another.

    Parameters
    ----------
    value, true : ndarray, shape (n,)
        The meter's and the true values, revolution by revolution, NaN where there is none.
    period_s : float
        Time of a revolution, s.
    longest_s : float
        Longest lag looked for, s.
    """
    known = np.isfinite(value) & np.isfinite(true)
    if np.count_nonzero(known) < LEAST_PAIRS:
        return Latency(reason=f"fewer than {LEAST_PAIRS} values")
    if np.std(true[known]) < LEAST_VARIATION * abs(np.mean(true[known])):
        return Latency(reason="the true value hardly changes")
    longest = min(len(true) - LEAST_PAIRS, math.ceil(longest_s / period_s))
    lags = np.arange(-EARLIEST, max(longest, EARLIEST) + 1)
    correlation = np.array([_correlation(value, true, int(lag)) for lag in lags])
    if not np.isfinite(correlation).any() or np.nanmax(correlation) < LEAST_CORRELATION:
        return Latency(reason="the values do not go with the true ones")
    peak = int(np.nanargmax(correlation))
    unexplained = 1.0 - correlation**2
    alike = lags[unexplained <= DISTINCT * unexplained[peak] + 1e-9]
    if float(np.ptp(alike)) * period_s > WIDEST_S:
        return Latency(reason="the true value changes too slowly to tell")
    if peak == len(lags) - 1:
        return Latency(
            int(lags[peak]), math.inf, f"longer than {lags[peak] * period_s:.1f} s, or unrelated"
        )
    lag = int(lags[peak])
    return Latency(lag, (lag + _between(correlation, peak)) * period_s)


def _correlation(value: NDArray[np.float64], true: NDArray[np.float64], lag: int) -> float:
    """Return the correlation of `value` with `true` some places earlier."""
    late = value[lag:] if lag >= 0 else value[:lag]
    early = true[: len(true) - lag] if lag >= 0 else true[-lag:]
    known = np.isfinite(late) & np.isfinite(early)
    if np.count_nonzero(known) < LEAST_PAIRS:
        return math.nan
    one, other = late[known] - late[known].mean(), early[known] - early[known].mean()
    scale = math.sqrt(float(one @ one) * float(other @ other))
    return float(one @ other) / scale if scale > 0.0 else math.nan


def _between(correlation: NDArray[np.float64], peak: int) -> float:
    """Return where between its neighbours the peak of a parabola through three lags is."""
    if not 0 < peak < len(correlation) - 1:
        return 0.0
    left, middle, right = correlation[peak - 1 : peak + 2]
    bend = left - 2.0 * middle + right
    if not bend < 0.0:
        return 0.0
    return float(np.clip(0.5 * (left - right) / bend, -0.5, 0.5))
