# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Local refinement: the model's steady waveform laid on the measured one by least squares, and what is left."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from roller_sim_ros.estimate.low_pass import ComplexArray, passed
from roller_sim_ros.estimate.orbit import Orbit
from roller_sim_ros.estimate.surfaces import LEAST, MOST
from roller_sim_ros.estimate.waveform import Waveform
from roller_sim_ros.parameters import Configuration

Array = NDArray[np.float64]

AROUND = [np.array([g, p]) for g in (-0.05, 0.0, 0.05) for p in (-0.09, 0.0, 0.09) if g or p]
"""Grounds in ln G and ln p around one at which a least-squares step ended without the measured motion: the motion's
dependence on the ground has kinks."""

OTHER_STARTS = (1.4, 0.7)
"""Amplitudes to start from over the known one where that leads to another motion: the drum may have several."""

FOUND = 0.002
"""Share of the measured waveform's size up to which what is left means that this is the motion."""

FOUND_SIGMAS = 1.1
"""Standard deviations of the waveform's noise that are left besides."""

DIFFERENCE = 1e-3
"""Step of ln G and ln p for the derivatives: well above what is left of transients, and changes go with its square."""

TOLERANCE = 1e-5
"""Of ln G and ln p."""

MOST_STEPS = 12

REACH = 2.0
"""Of ln G and ln p from where it starts."""

CORRELATED = 24
"""Samples over which what is left may be alike."""


@dataclass(frozen=True)
class Refined:
    """A ground whose steady motion is the measured one, as far as that goes.

    Attributes
    ----------
    logs : ndarray, shape (2,)
        ln G and ln p.
    covariance : ndarray, shape (2, 2)
        Of them; infinite where the motion does not depend on them.
    modelled : ndarray, shape (n,)
        The motion's vertical acceleration without its mean, m/s².
    misfit : float
        Root mean square of modelled less measured, m/s².
    """

    logs: Array
    covariance: Array
    modelled: Array
    misfit: float


def refine(
    measured: Waveform,
    start: Array,
    known: Configuration,
    response: ComplexArray | None = None,
) -> Refined:
    """Return the ground whose motion is nearest to a waveform.

    Parameters
    ----------
    measured : Waveform
        One period.
    start : ndarray, shape (2,)
        ln G and ln p to start from.
    known : Configuration
        Machine, exciter, half space, density, Poisson's ratio.
    response : ndarray, optional
        Of the sensor's low-pass, see `low_pass`.
    """
    size = float(np.sqrt(np.mean(measured.vertical**2)))
    enough = FOUND * size + FOUND_SIGMAS * measured.noise
    matching = _Matching(measured, start, known, response)
    best = matching.nearest(start)
    if best.misfit > enough:
        best = min(best, matching.nearest(matching.best_around(best.logs)), key=_misfit)
    for factor in OTHER_STARTS:
        if best.misfit > enough:
            other = _Matching(measured, start, known, response, factor)
            best = min(best, other.nearest(start), key=_misfit)
    return best


def _misfit(found: Refined) -> float:
    return found.misfit


class _Matching:
    """The model's motion beside a measured one.

    Parameters
    ----------
    measured, start, known, response
        As for `refine`.
    start_factor : float
        As for `Orbit`.
    """

    def __init__(
        self,
        measured: Waveform,
        start: Array,
        known: Configuration,
        response: ComplexArray | None,
        start_factor: float = 1.0,
    ) -> None:
        samples = len(measured.vertical) // measured.period
        self._measured = measured.vertical
        self._response = response
        self._orbit = Orbit(known, start, measured.period, samples, start_factor)
        # A motion over several revolutions may have begun with any of them.
        first = passed(self._orbit.vertical(start), response)
        self._shift = min(
            (samples * turn for turn in range(measured.period)),
            key=lambda by: float(((np.roll(first, by) - self._measured) ** 2).sum()),
        )

    def left(self, logs: Array) -> Array:
        """Return modelled less measured, m/s², on a ground."""
        modelled = passed(self._orbit.vertical(logs), self._response)
        return np.asarray(np.roll(modelled, self._shift) - self._measured)

    def best_around(self, logs: Array) -> Array:
        """Return the ground around one on which least is left."""
        grounds = [np.clip(logs + off, np.log(LEAST), np.log(MOST)) for off in AROUND]
        return min(grounds, key=lambda ground: float((self.left(ground) ** 2).sum()))

    def nearest(self, start: Array) -> Refined:
        """Return the ground from a start on which least is left, as far as steps lead."""
        found = least_squares(
            self.left,
            start,
            bounds=(
                np.maximum(np.log(LEAST), start - REACH) - 1e-9,
                np.minimum(np.log(MOST), start + REACH) + 1e-9,
            ),
            x_scale=0.1,
            diff_step=[DIFFERENCE, DIFFERENCE],
            xtol=TOLERANCE,
            ftol=1e-6,
            gtol=1e-12,
            max_nfev=MOST_STEPS,
        )
        return Refined(
            logs=np.asarray(found.x),
            covariance=covariance(np.asarray(found.jac), found.fun),
            modelled=self._measured + found.fun,
            misfit=float(np.sqrt(np.mean(found.fun**2))),
        )


def covariance(jacobian: Array, left: Array) -> Array:
    """Return the covariance of parameters fitted by least squares, from what the fit leaves.

    For white noise s² (JᵀJ)⁻¹. What a wrong model leaves is alike from sample to sample, so that there is less in it
    than its samples would say: where the sandwich (JᵀJ)⁻¹ Jᵀ S J (JᵀJ)⁻¹, with S from the autocovariance of what is
    left over `CORRELATED` samples, tapered (Newey & West 1987) and periodic as the waveform is, gives a larger spread,
    that one holds. It may not give a smaller one: the fit has taken out of what is left just what J shows.

    Parameters
    ----------
    jacobian : ndarray, shape (n, 2)
        Derivatives of what is left.
    left : ndarray, shape (n,)
        What is left.
    """
    count = len(left)
    normal = jacobian.T @ jacobian
    if not np.linalg.cond(normal) < 1e14:
        return np.full((2, 2), np.inf)
    power = np.abs(np.fft.fft(left)) ** 2 / count
    autocovariance = np.fft.ifft(power).real * count / max(count - 2, 1)
    lags = np.minimum(np.arange(count), count - np.arange(count))
    taper = np.maximum(0.0, 1.0 - lags / CORRELATED)
    spectrum = np.fft.fft(autocovariance * taper).real
    filtered = np.fft.ifft(spectrum[:, np.newaxis] * np.fft.fft(jacobian, axis=0), axis=0).real
    inverse = np.linalg.inv(normal)
    white = float(autocovariance[0]) * inverse
    sandwich = inverse @ (jacobian.T @ filtered) @ inverse
    wider = np.sqrt(np.maximum(1.0, np.diag(sandwich) / np.maximum(np.diag(white), 1e-300)))
    return np.asarray(white * np.outer(wider, wider))
