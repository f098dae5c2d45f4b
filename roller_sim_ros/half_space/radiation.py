# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where the energy of a vertical harmonic point load goes: Rayleigh, shear and compression waves."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.half_space.point_load import point_load
from roller_sim_ros.half_space.quadrature import gauss_legendre


@dataclass(frozen=True)
class RadiatedEnergy:
    """Energy radiated by a vertical point load F exp(i omega t).

    Attributes
    ----------
    rayleigh, shear, compression : float
        Shares of the three kinds of wave; they sum to 1.
    total : float
        Mean power over omega^2 |F|^2/(4 pi G v_s), dimensionless.
    """

    rayleigh: float
    shear: float
    compression: float
    total: float


def radiated_energy(poisson_ratio: float) -> RadiatedEnergy:
    """Share of each kind of wave in what a vertical point load radiates.

    Parameters
    ----------
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    RadiatedEnergy
        At nu = 0.25: 67.4 % Rayleigh, 25.8 % shear, 6.9 % compression (Miller and Pursey 1955).

    Notes
    -----
    The mean power is -omega |F|^2 Im H/2. Of Lamb's integral 2 pi G H = -int k alpha/R dk (k in units of
    omega/v_s), alpha = sqrt(k^2 - a^2), beta = sqrt(k^2 - 1), R = (2 k^2 - 1)^2 - 4 k^2 alpha beta, the
    pole at k = gamma gives the Rayleigh wave and k < 1 the body waves: shear waves leave with the square of
    their potential 2 k alpha/R, compression waves (k < a) with that of (2 k^2 - 1)/R.
    """
    load = point_load(poisson_ratio)
    a, gamma = load.slowness_p, load.slowness_rayleigh
    k2, alpha2, beta2 = gamma**2, gamma**2 - a**2, gamma**2 - 1.0
    alpha, beta = math.sqrt(alpha2), math.sqrt(beta2)
    slope = 8.0 * gamma * (2.0 * k2 - 1.0) - 8.0 * gamma * alpha * beta
    slope -= 4.0 * k2 * gamma * (beta / alpha + alpha / beta)
    rayleigh = -math.pi * gamma * alpha / slope

    unit, weight = gauss_legendre(100)
    x = 0.5 * math.pi * unit
    measure = 0.5 * math.pi * weight
    # k = a sin(x) below a; between a and 1 k^2 = a^2 + (1 - a^2) sin^2(x): no square root is left.
    k, dk = a * np.sin(x), a * np.cos(x) * measure
    p, s = np.sqrt(a * a - k * k), np.sqrt(1.0 - k * k)
    denominator = ((2.0 * k * k - 1.0) ** 2 + 4.0 * k * k * p * s) ** 2
    compression = float(np.sum(dk * k * p * (2.0 * k * k - 1.0) ** 2 / denominator))
    shear = float(np.sum(dk * k * 4.0 * k * k * p * p * s / denominator))
    width = 1.0 - a * a
    k_squared, kdk = a * a + width * np.sin(x) ** 2, width * np.sin(x) * np.cos(x) * measure
    s = math.sqrt(width) * np.cos(x)
    denominator = (2.0 * k_squared - 1.0) ** 4 + (4.0 * k_squared * s) ** 2 * (k_squared - a * a)
    shear += float(np.sum(kdk * 4.0 * k_squared * (k_squared - a * a) * s / denominator))
    total = rayleigh + shear + compression
    return RadiatedEnergy(rayleigh / total, shear / total, compression / total, total)
