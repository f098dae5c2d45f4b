# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the rows of a verdict look at: the meter's values beside the truth, revolution by revolution."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.score.latency import Latency
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.score.truth import FaultWindow, Truth, sound

SILENT_INTERVALS = 2.5
"""Usual intervals between a meter's messages; in a longer pause it is silent."""


@dataclass(frozen=True)
class Values:
    """The meter's messages laid on the revolutions of the truth; all arrays have the shape (revolutions,).

    Of several messages in a revolution the last counts.

    Attributes
    ----------
    given : ndarray of bool
        Where there is a message.
    value : ndarray of float64
        NaN where there is none, or the meter says that it has none.
    flagged : ndarray of bool
        Where the message says that the value is not to be trusted.
    alarm : ndarray of float64
        1 or 0 or an RMV; NaN where nothing is said.
    """

    given: NDArray[np.bool_]
    value: NDArray[np.float64]
    flagged: NDArray[np.bool_]
    alarm: NDArray[np.float64]

    def shifted(self, revolutions: int) -> Values:
        """Return the values as if they had come some revolutions earlier."""
        return Values(
            _shift(self.given, revolutions, fill=False),
            _shift(self.value, revolutions, fill=np.nan),
            _shift(self.flagged, revolutions, fill=False),
            _shift(self.alarm, revolutions, fill=np.nan),
        )


Scalar = TypeVar("Scalar", np.bool_, np.float64)


def _shift(column: NDArray[Scalar], by: int, *, fill: bool | float) -> NDArray[Scalar]:
    out = np.full_like(column, fill)
    if by >= 0:
        out[: len(column) - by] = column[by:]
    else:
        out[-by:] = column[:by]
    return out


@dataclass(frozen=True)
class Evidence:
    """All that the rows are made of.

    Attributes
    ----------
    truth : Truth
        The truth.
    faults : tuple of FaultWindow
        When which fault was active.
    values : Values
        The meter's, each at the revolution that it is of.
    stamped : bool
        Whether that is by the messages' own stamps, not by when they came.
    alarm_is_rmv : bool
        Whether `Values.alarm` is an RMV.
    latency : Latency
        By how much values come late.
    window : int
        Revolutions in the window of the true values.
    limits : Limits
        What the rows hold against.
    """

    truth: Truth
    faults: tuple[FaultWindow, ...]
    values: Values
    stamped: bool
    alarm_is_rmv: bool
    latency: Latency
    window: int
    limits: Limits

    @cached_property
    def usable(self) -> NDArray[np.bool_]:
        """Where the meter gives a value that it does not flag."""
        return np.isfinite(self.values.value) & ~self.values.flagged

    @cached_property
    def sound(self) -> NDArray[np.bool_]:
        """Where no fault is active, nor was so recently that a meter's window may hold some of it."""
        return sound(self.faults, len(self.truth), self.limits.settle_revolutions)

    @cached_property
    def steady(self) -> NDArray[np.bool_]:
        """Where the frequency was the same all over the true values' window, and there is a true value."""
        return np.isfinite(self.truth.cmv) & self.truth.steady(self.window)

    @cached_property
    def compared(self) -> NDArray[np.bool_]:
        """Where values are compared: true and given, not flagged, no fault about."""
        return self.usable & np.isfinite(self.truth.cmv) & self.sound

    @cached_property
    def silent(self) -> NDArray[np.bool_]:
        """Where a message was due and none came, in pauses that are longer than those that the meter usually makes."""
        places = np.flatnonzero(self.values.given)
        silent = np.ones(len(self.truth), dtype=np.bool_)
        if len(places) < 2:
            return silent
        usual = float(np.median(np.diff(places)))
        silent[places[0] :] = False
        for last, following in pairwise([*places.tolist(), len(silent)]):
            if following - last > SILENT_INTERVALS * usual:
                silent[last + round(usual) : following] = True
        return silent

    def settled(self, fault: FaultWindow) -> int:
        """Return the first revolution in which a fault that is over may matter no more."""
        return min(len(self.truth), fault.end + self.limits.settle_revolutions)

    def deviation_percent(self, where: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return by how much the values at some revolutions are off, in percent of the true ones.

        A value without a stamp of its own may be of any revolution since the longest latency that is allowed.
        """
        places = np.flatnonzero(where)
        value = self.values.value[places]
        low = high = self.truth.cmv[places]
        if not self.stamped:
            reach = max(1, round(self.limits.latency_s / self.truth.period_s))
            spans = [self.truth.cmv[max(0, it - reach) : it + 2] for it in places]
            low = np.array([np.nanmin(span) for span in spans])
            high = np.array([np.nanmax(span) for span in spans])
        off = np.maximum(np.maximum(low - value, value - high), 0.0)
        return np.asarray(100.0 * off / np.abs(self.truth.cmv[places]))
