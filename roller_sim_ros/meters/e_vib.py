# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""E_vib: the modulus of the ground, from the steepness of the loading branch of force over travel."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.meters.drum import DrumMotion, one_each
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

LOW, HIGH = 0.4, 0.9
"""Part of the loading branch that is taken, between its lowest and its highest force."""


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
    shape, samples = force.shape[:-1], force.shape[-1]
    out = np.empty(math.prod(shape))
    kernels.mean_modulus(
        np.ascontiguousarray(force, dtype=np.float64).reshape(-1, samples),
        np.ascontiguousarray(height, dtype=np.float64).reshape(-1, samples),
        one_each(static_load_n, shape),
        one_each(radius_m, shape),
        one_each(width_m, shape),
        poisson_ratio,
        samples_per_revolution,
        LOW,
        HIGH,
        out,
    )
    return out.reshape(shape)
