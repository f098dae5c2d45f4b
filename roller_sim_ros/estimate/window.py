# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One window of revolutions: from the waveform over the map to the ground, and what that is worth."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.estimate.inversion import invert
from roller_sim_ros.estimate.low_pass import low_pass, undone
from roller_sim_ros.estimate.refine import Refined, refine
from roller_sim_ros.estimate.soil_map import best_ground
from roller_sim_ros.estimate.status import Status
from roller_sim_ros.estimate.surfaces import LEAST, MOST
from roller_sim_ros.estimate.waveform import Waveform, waveform
from roller_sim_ros.parameters import Configuration

Array = NDArray[np.float64]

SPREAD = 0.2
"""Relative standard deviation above which a parameter is uncertain."""

MISFIT = 0.05
"""Share of the measured waveform's size that the model may leave beside the noise."""

EXPECTED = 1.5
"""Times the noise that may be left of it."""


@dataclass(frozen=True)
class WindowEstimate:
    """The ground of one window; NaN where it cannot be told.

    Attributes
    ----------
    status : Status
        Whether the values stand, or why there are none.
    shear_modulus_pa, plastic_parameter_m : float
        G, Pa, and p, m.
    shear_modulus_spread_pa, plastic_spread_m : float
        Their standard deviations, from the curvature of the fit and what it leaves. They know of noise, and of what is
        left by a wrong model or machine, not of how far that moves the values.
    correlation : float
        Of the errors of ln G and ln p, −1 to 1.
    period : int
        Revolutions after which the motion repeats, 0 for none.
    misfit_m_s2, misfit_share : float
        Root mean square of modelled less measured acceleration, m/s², and as a share of the measured one's.
    noise_m_s2 : float
        What of it the difference from revolution to revolution explains, m/s².
    measured, modelled : ndarray, shape (period × samples per revolution,)
        Vertical acceleration over one period without its mean, m/s², from phase zero on, as the sensor shows it.
    """

    status: Status
    shear_modulus_pa: float = math.nan
    plastic_parameter_m: float = math.nan
    shear_modulus_spread_pa: float = math.nan
    plastic_spread_m: float = math.nan
    correlation: float = math.nan
    period: int = 0
    misfit_m_s2: float = math.nan
    misfit_share: float = math.nan
    noise_m_s2: float = math.nan
    measured: Array = field(default_factory=lambda: np.zeros(0), repr=False)
    modelled: Array = field(default_factory=lambda: np.zeros(0), repr=False)


def estimate_window(
    revolutions: NDArray[np.floating], known: Configuration, *, sensor_bandwidth_hz: float = 0.0
) -> WindowEstimate:
    """Estimate the ground under a window of revolutions at one frequency and amplitude.

    Parameters
    ----------
    revolutions : ndarray, shape (revolutions, samples per revolution)
        Vertical acceleration of the drum, m/s², positive up, each row from phase zero of the eccentric to phase zero;
        its force goes as the sine of the phase. Gravity or a bias do not matter. At least 4 rows, and 64 samples.
    known : Configuration
        Machine, exciter (frequency, amplitude, kind), half space, density and Poisson's ratio; its G and p are not
        looked at.
    sensor_bandwidth_hz : float
        Frequency of −3 dB of the sensor's second-order Butterworth low-pass; 0: none.

    Raises
    ------
    EstimateError
        If the array has another shape, or the bandwidth is negative.
    """
    measured = waveform(revolutions)
    if known.exciter.amplitude_m <= 0.0 or known.exciter.frequency_hz <= 0.0:
        return WindowEstimate(Status.STANDING)
    if measured.status is not Status.OK:
        return WindowEstimate(measured.status)
    response = low_pass(
        len(measured.vertical), measured.period, known.exciter.frequency_hz, sensor_bandwidth_hz
    )
    inverted = invert(undone(measured.vertical, response), measured.noise, measured.period, known)
    if not len(inverted.contact):
        return WindowEstimate(Status.MISFIT, period=measured.period)
    start = best_ground(inverted, measured.period, known)
    return _estimate(measured, refine(measured, start, known, response))


def _estimate(measured: Waveform, found: Refined) -> WindowEstimate:
    size = float(np.sqrt(np.mean(measured.vertical**2)))
    modulus, plastic = (float(value) for value in np.exp(found.logs))
    spreads = np.sqrt(np.diag(found.covariance))
    both = float(spreads[0] * spreads[1])
    return WindowEstimate(
        status=_status(measured, found, size, spreads),
        shear_modulus_pa=modulus,
        plastic_parameter_m=plastic,
        shear_modulus_spread_pa=float(modulus * spreads[0]),
        plastic_spread_m=float(plastic * spreads[1]),
        correlation=float(found.covariance[0, 1]) / both if 0.0 < both < math.inf else math.nan,
        period=measured.period,
        misfit_m_s2=found.misfit,
        misfit_share=found.misfit / size,
        noise_m_s2=measured.noise,
        measured=measured.vertical,
        modelled=found.modelled,
    )


def _status(measured: Waveform, found: Refined, size: float, spreads: Array) -> Status:
    unexplained = found.misfit**2 - (EXPECTED * measured.noise) ** 2
    if unexplained > (MISFIT * size) ** 2:
        return Status.MISFIT
    at_end = np.abs(found.logs - np.clip(found.logs, np.log(LEAST) + 0.01, np.log(MOST) - 0.01))
    if not spreads[0] <= SPREAD or at_end.any():
        return Status.UNCERTAIN
    return Status.OK if spreads[1] <= SPREAD else Status.PLASTIC_UNCERTAIN
