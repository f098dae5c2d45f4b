"""E_vib: the modulus of the ground, from the steepness of the loading branch of force over travel."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from roller_sim_ros.meters import lundberg
from roller_sim_ros.meters.drum import DrumMotion
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

LOW, HIGH = 0.4, 0.9
"""Part of the loading branch that is taken, between its lowest and its highest force."""

FEWEST_POINTS = 2


class EVib:
    """Young's modulus whose line contact is as steep as the loading branch (BOMAG); Pa.

    Of every two revolutions the branch is taken that leads to the greatest force; its slope by regression of the
    travel on the force, over the samples between 40 and 90 % of the way to that peak from the lowest force in the
    revolution before it (zero when the drum was in the air). Lundberg's relation is inverted for the same forces,
    without linearising it. The value is the mean over the window.
    """

    name: ClassVar[str] = "e_vib"
    label: ClassVar[str] = "E_vib"
    unit: ClassVar[str] = "Pa"
    source: ClassVar[str] = (
        "BOMAG, as commonly cited: Kröber, Floss and Wallrath, Dynamic soil stiffness as quality criterion for "
        "soil compaction (2001); the regression and the levels in continuous contact are this project's"
    )
    verified: ClassVar[bool] = False

    poisson_ratio: ClassVar[float] = 0.25
    """Assumed: the meter does not know the ground's."""

    def value(self, motion: DrumMotion) -> NDArray[np.float64]:
        """Return E_vib of each motion, Pa, shape (...); NaN where no branch has a usable slope."""
        return vibration_modulus(
            motion.soil_force,
            motion.height,
            motion.drum.static_load_n,
            motion.drum.radius_m,
            motion.drum.width_m,
            poisson_ratio=self.poisson_ratio,
            samples_per_revolution=motion.samples_per_revolution,
        )


def vibration_modulus(
    soil_force: NDArray[np.floating],
    height: NDArray[np.floating],
    static_load_n: npt.ArrayLike,
    radius_m: npt.ArrayLike,
    width_m: npt.ArrayLike,
    *,
    poisson_ratio: float = EVib.poisson_ratio,
    samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
) -> NDArray[np.float64]:
    """Return E_vib of motions given by force and travel, Pa.

    Parameters
    ----------
    soil_force, height : ndarray, shape (..., samples)
        F_s, N, and the drum's height, m, up positive, over an even number of whole revolutions; the window is
        taken to repeat.
    static_load_n, radius_m, width_m : array_like, shape (...)
        F_stat, r and W. Two revolutions whose greatest force does not exceed F_stat have no blow and no value.
    poisson_ratio : float
        ν of the ground.
    samples_per_revolution : int
        Samples in one revolution.

    Returns
    -------
    ndarray, shape (...)
        NaN where no two revolutions have a value.
    """
    force, height = np.broadcast_arrays(soil_force, height)
    samples, span = force.shape[-1], 2 * samples_per_revolution
    peaks = _peaks(force, span)
    # Each row: the revolution that leads to a peak, the peak last.
    rows = (peaks[..., np.newaxis] + np.arange(-samples_per_revolution, 1)) % samples
    shape = (*rows.shape[:-2], -1)
    forces = np.take_along_axis(force, rows.reshape(shape), axis=-1).reshape(rows.shape)
    depths = -np.take_along_axis(height, rows.reshape(shape), axis=-1).reshape(rows.shape)
    taken = _branch(forces)
    taken &= forces[..., -1:] > np.asarray(static_load_n)[..., np.newaxis, np.newaxis]
    with np.errstate(invalid="ignore", divide="ignore"):
        logarithms = forces * np.log(np.where(forces > 0.0, forces, 1.0))
        slope = _slope(forces, depths, taken)
        moduli = lundberg.modulus(
            slope,
            _slope(forces, logarithms, taken),
            np.asarray(radius_m)[..., np.newaxis],
            np.asarray(width_m)[..., np.newaxis],
            poisson_ratio,
        )
        known = np.isfinite(moduli)
        return np.asarray(np.where(known, moduli, 0.0).sum(axis=-1) / known.sum(axis=-1))


def _peaks(force: NDArray[np.floating], span: int) -> NDArray[np.intp]:
    """Return where each `span` samples have their greatest force, shape (..., samples / span).

    Only summits count: at the end of a span the force of the next one's blow may already be rising.
    """
    summit = (force >= np.roll(force, 1, axis=-1)) & (force >= np.roll(force, -1, axis=-1))
    ranked = np.where(summit, force, -np.inf).reshape(*force.shape[:-1], -1, span)
    starts = np.arange(ranked.shape[-2]) * span
    return np.asarray(ranked.argmax(axis=-1) + starts)


def _branch(forces: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Return which samples of each row belong to the part of the loading branch that is taken."""
    lowest = forces.min(axis=-1, keepdims=True)
    rise = forces[..., -1:] - lowest
    index = np.arange(forces.shape[-1])
    below = forces < lowest + LOW * rise
    start = np.where(below, index, -1).max(axis=-1, keepdims=True)
    above = (forces > lowest + HIGH * rise) & (index > start)
    end = np.where(above, index, forces.shape[-1]).min(axis=-1, keepdims=True)
    return np.asarray((index > start) & (index < end))


def _slope(
    x: NDArray[np.floating], y: NDArray[np.floating], taken: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Return the regression's slope of y over x in each row, NaN for fewer than two points."""
    count = taken.sum(axis=-1, keepdims=True)
    x_0 = x - np.where(taken, x, 0.0).sum(axis=-1, keepdims=True) / count
    x_0 = np.where(taken, x_0, 0.0)
    slope = (x_0 * y).sum(axis=-1) / (x_0 * x_0).sum(axis=-1)
    return np.where(count[..., 0] >= FEWEST_POINTS, slope, np.nan)
