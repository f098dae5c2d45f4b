# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One block of samples: all that a session knows of a stretch of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

LOADING, UNLOADING, AIR = 0, 1, 2
"""Contact states (paper, Figure 13): values of ``Block.contact_state``."""


@dataclass(eq=False)
class Block:
    """Samples that share one sample period and one excitation frequency.

    A block never reaches over a multiple of 128 samples, where frequency and soil may change. z is up,
    x is forward, SI units. All arrays have the shape (n,).

    Attributes
    ----------
    first_sample : int
        Index of the first sample since the start of the session.
    time_s : float
        Time of the first sample since the start: the accumulated sample periods.
    sample_period_s, excitation_hz : float
        Constant in the block.
    eccentric_phase_rad : float
        Phase of the eccentric at the first sample, in [0, 2π); vertical force ∝ sin.
    phase_increment_rad : float
        Phase from sample to sample: 2π/128 at and above the sampling floor, less below.
    acceleration_vertical, acceleration_horizontal : ndarray
        True coordinate acceleration of the drum axle, m/s².
    soil_force : ndarray
        F_s ≥ 0 on the drum, N.
    drum_height : ndarray
        Height of the drum's lowest point over the untouched surface at the start, m; falls without limit
        while the drum sinks in continuous contact.
    soil_displacement : ndarray
        z_se of the half space's surface, m, negative under load.
    plastic_depth : ndarray
        Plastic deformation under the drum since the last renewal (q ≥ 0), m.
    height_datum : ndarray
        D, depth of the surface that the drum meets, m; in contact
        −drum_height = −soil_displacement + plastic_depth + height_datum.
    contact_state : ndarray of uint8
        LOADING, UNLOADING or AIR.
    shear_modulus_pa, plastic_parameter_m : float
        The ground under the drum.
    """

    first_sample: int
    time_s: float
    sample_period_s: float
    excitation_hz: float
    eccentric_phase_rad: float
    phase_increment_rad: float
    acceleration_vertical: NDArray[np.float64]
    acceleration_horizontal: NDArray[np.float64]
    soil_force: NDArray[np.float64]
    drum_height: NDArray[np.float64]
    soil_displacement: NDArray[np.float64]
    plastic_depth: NDArray[np.float64]
    height_datum: NDArray[np.float64]
    contact_state: NDArray[np.uint8]
    shear_modulus_pa: float
    plastic_parameter_m: float

    def __len__(self) -> int:
        """Return the number of samples."""
        return int(self.acceleration_vertical.shape[0])
