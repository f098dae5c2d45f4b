# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Windows that slide over revolutions, and which of them can be estimated at all."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from roller_sim_ros.estimate.status import Status
from roller_sim_ros.estimate.turns import Turn
from roller_sim_ros.estimate.window import WindowEstimate, estimate_window
from roller_sim_ros.parameters import Configuration, ParameterError

CONSTANT = 2e-3
"""Relative change of frequency or amplitude up to which the exciter runs steadily."""

CONSTANT_PULSES = 1e-2
"""The same of a frequency from the times of single revolutions, which jitter."""


@dataclass(frozen=True)
class Window:
    """Revolutions in a row.

    Attributes
    ----------
    turns : tuple of Turn
        At least one.
    whole : bool
        Whether they are as many as a window has.
    """

    turns: tuple[Turn, ...]
    whole: bool


class SlidingWindow:
    """Makes windows of revolutions that come one by one.

    A row of revolutions that is interrupted before it fills a window makes one that is not whole.

    Parameters
    ----------
    revolutions : int
        In a window.
    step : int
        From window to window.
    """

    def __init__(self, revolutions: int, step: int) -> None:
        self._revolutions = revolutions
        self._step = step
        self._turns: list[Turn] = []
        self._any = False

    def push(self, turn: Turn) -> Iterator[Window]:
        """Take a revolution; yield what it interrupts and what it completes."""
        if not turn.follows:
            yield from self.finish()
        self._turns.append(turn)
        if len(self._turns) == self._revolutions:
            yield Window(tuple(self._turns), whole=True)
            self._any = True
            del self._turns[: self._step]

    def finish(self) -> Iterator[Window]:
        """Yield what there was of a row too short for a window, and begin anew."""
        if self._turns and not self._any:
            yield Window(tuple(self._turns), whole=False)
        self._turns.clear()
        self._any = False


def estimate_turns(
    window: Window,
    known: Configuration,
    *,
    constant: float = CONSTANT,
    sensor_bandwidth_hz: float = 0.0,
) -> tuple[WindowEstimate, Configuration]:
    """Estimate one window at the frequency and amplitude that its revolutions had.

    Parameters
    ----------
    window : Window
        Revolutions.
    known : Configuration
        What is known beside these; its amplitude holds where a revolution's is unknown.
    constant : float
        Relative change of frequency or amplitude that is none.
    sensor_bandwidth_hz : float
        As for `estimate_window`.

    Returns
    -------
    estimate : WindowEstimate
        What came out.
    known : Configuration
        With the window's frequency and amplitude, as far as they are possible ones.
    """
    frequencies = np.array([turn.excitation_hz for turn in window.turns])
    amplitudes = np.array(
        [
            known.exciter.amplitude_m if math.isnan(turn.amplitude_m) else turn.amplitude_m
            for turn in window.turns
        ]
    )
    try:
        exciter = replace(
            known.exciter,
            frequency_hz=float(frequencies.mean()),
            amplitude_m=float(amplitudes.mean()),
        )
    except ParameterError:
        return WindowEstimate(Status.CHANGING), known
    known = replace(known, exciter=exciter)
    if not window.whole:
        return WindowEstimate(Status.TOO_FEW), known
    if np.ptp(frequencies) > constant * frequencies.mean() or (
        np.ptp(amplitudes) > CONSTANT * amplitudes.mean()
    ):
        return WindowEstimate(Status.CHANGING), known
    rows = np.stack([turn.vertical for turn in window.turns])
    return estimate_window(rows, known, sensor_bandwidth_hz=sensor_bandwidth_hz), known
