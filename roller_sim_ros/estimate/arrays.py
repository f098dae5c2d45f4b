# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The library call on arrays: samples of acceleration, and the phase of the eccentric at each."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.estimate.sliding import SlidingWindow, Window, estimate_turns
from roller_sim_ros.estimate.status import EstimateError
from roller_sim_ros.estimate.turns import Turn, TurnCollector
from roller_sim_ros.estimate.window import WindowEstimate
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration

WINDOW_REVOLUTIONS = 16


def estimate(
    vertical: NDArray[np.floating],
    known: Configuration,
    *,
    phase_rad: NDArray[np.floating] | None = None,
    window_revolutions: int = WINDOW_REVOLUTIONS,
    step_revolutions: int | None = None,
    sensor_bandwidth_hz: float = 0.0,
) -> list[WindowEstimate]:
    """Estimate the ground in windows that slide over the samples of a run at one frequency and amplitude.

    Parameters
    ----------
    vertical : ndarray, shape (n,)
        Vertical acceleration of the drum, m/s², positive up; a constant does not matter.
    known : Configuration
        Machine, exciter (frequency, amplitude, kind), half space, density and Poisson's ratio; its G and p are not
        looked at.
    phase_rad : ndarray, shape (n,), optional
        Phase of the eccentric at each sample, rad, rising, as `numpy.unwrap` gives it; its vertical force goes as the
        sine. When left out there are 128 samples per revolution from phase zero on.
    window_revolutions : int
        Revolutions in a window.
    step_revolutions : int, optional
        From one window to the next; half a window when left out.
    sensor_bandwidth_hz : float
        Frequency of −3 dB of the sensor's second-order Butterworth low-pass; 0: none.

    Returns
    -------
    list of WindowEstimate
        One for each window; where there are too few samples, one that says so.

    Raises
    ------
    EstimateError
        If the arrays have other shapes or are empty, the phase does not rise, or a window is no possible one.
    """
    samples = np.asarray(vertical, dtype=np.float64)
    step = step_of(window_revolutions, step_revolutions)
    if samples.ndim != 1 or not len(samples):
        raise EstimateError(
            f"an array of shape {samples.shape} holds no samples; shape (n,) is needed"
        )
    if phase_rad is None:
        turns = np.arange(len(samples)) / SAMPLES_PER_REVOLUTION
    else:
        turns = np.asarray(phase_rad, dtype=np.float64) / (2.0 * math.pi)
        if turns.shape != samples.shape or not np.all(np.diff(turns) > 0.0):
            raise EstimateError(
                f"phase_rad, of shape {turns.shape}, must rise and be as long as vertical, of shape {samples.shape}: "
                "see numpy.unwrap"
            )
    collector = TurnCollector(SAMPLES_PER_REVOLUTION)
    sliding = SlidingWindow(window_revolutions, step)
    found: list[Window] = []
    exciter = known.exciter
    rows = collector.feed(
        turns / exciter.frequency_hz if exciter.frequency_hz else turns,
        turns,
        samples,
        excitation_hz=exciter.frequency_hz,
        amplitude_m=exciter.amplitude_m,
    )
    for turn in rows:
        found += sliding.push(turn)
    found += sliding.finish()
    if not found:
        nothing = Turn(0.0, exciter.frequency_hz, exciter.amplitude_m, samples, follows=False)
        found = [Window((nothing,), whole=False)]
    return [
        estimate_turns(window, known, sensor_bandwidth_hz=sensor_bandwidth_hz)[0]
        for window in found
    ]


def step_of(window_revolutions: int, step_revolutions: int | None) -> int:
    """Return the step from window to window, half a window where none is given.

    Raises
    ------
    EstimateError
        If a window has fewer than 4 revolutions, or the step is not 1 to a window.
    """
    if window_revolutions < 4:
        raise EstimateError(f"window_revolutions = {window_revolutions} must be at least 4")
    if step_revolutions is None:
        return window_revolutions // 2
    if not 1 <= step_revolutions <= window_revolutions:
        raise EstimateError(
            f"step_revolutions = {step_revolutions} must be 1 to {window_revolutions}, a window's revolutions"
        )
    return step_revolutions
