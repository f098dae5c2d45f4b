# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Half space as a rational function of any order, eq. (9), fitted by linear programming.

The fit (see `rational_fit`) goes to the exact compliance at the actual aspect ratio and Poisson's ratio. It is
kept as poles and residues, H(s)/H0 = sum_j r_j/(s - p_j) with s in units of v_s/sqrt(BL): as many states, each
of which a kernel steps exactly.
"""

from __future__ import annotations

import functools
import math
import time
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space import rational_fit
from roller_sim_ros.half_space.checks import HalfSpaceError, require_poisson_ratio, require_positive
from roller_sim_ros.half_space.compliance import normalised_compliance
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray
from roller_sim_ros.half_space.static import static_compliance

HIGHEST_ORDER = 8


@dataclass(frozen=True)
class RationalHalfSpace:
    """A fitted half space, dimensionless: e = H0 Re sum_j residues_j z_j, z_j' = poles_j z_j + F.

    Attributes
    ----------
    aspect_ratio, poisson_ratio : float
        alpha and nu of the exact compliance it was fitted to.
    order : int
        Number of poles, those of the lower half plane counted: less than what was asked for where a pole
        was dropped because it came out too far away.
    highest_a0 : float
        The band of the fit: a0 from zero to this.
    poles : ndarray of complex, shape (m,)
        p_j with Im p_j >= 0, in units of v_s/sqrt(BL). All real parts are negative. Read-only.
    residues : ndarray of complex, shape (m,)
        r_j in the same unit, real where the pole is real; twice the residue where the pole stands for a
        conjugate pair. Read-only.
    fit_seconds : float
        What the fit took.
    """

    aspect_ratio: float
    poisson_ratio: float
    order: int
    highest_a0: float
    poles: ComplexArray
    residues: ComplexArray
    fit_seconds: float

    @functools.cached_property
    def error(self) -> float:
        """Largest |H_fit - H|/H0 in the band, from 400 frequencies.

        Found where it is asked for: that takes as long as a good part of the fit.
        """
        band = np.linspace(0.0, self.highest_a0, 400)
        exact = normalised_compliance(band, self.aspect_ratio, self.poisson_ratio)
        return float(np.abs(self.compliance(band) - exact).max())

    @property
    def dashpot(self) -> float:
        """Velocity over the jump of force that starts it, in units of H0 v_s/sqrt(BL)."""
        return float(self.residues.real.sum())

    def compliance(self, a0: npt.ArrayLike) -> ComplexArray:
        """Return H/H0 at the dimensionless frequency a0, for exp(+i omega t); same shape as `a0`."""
        return _evaluate(np.asarray(a0, dtype=np.float64), self.poles, self.residues)

    def coefficients(self) -> tuple[FloatArray, FloatArray]:
        """Coefficients of eq. (9), highest power first.

        Returns
        -------
        numerator : ndarray, shape (order,)
        denominator : ndarray, shape (order + 1,)
            In the dimensionless s; the last of each is 1.
        """
        pairs = self.poles[self.poles.imag > 0.0]
        every = np.concatenate([self.poles, np.conj(pairs)])
        weights = np.concatenate([self.residues, np.conj(self.residues[self.poles.imag > 0.0])])
        halves = np.where(every.imag == 0.0, 1.0, 0.5) * weights
        numerator = sum(
            half * np.poly(np.delete(every, index)) for index, half in enumerate(halves)
        )
        denominator = np.poly(every)
        unit = denominator[-1].real
        return np.real(numerator) / unit, denominator.real / unit


def rational_half_space(
    aspect_ratio: float, poisson_ratio: float, order: int = 4, highest_a0: float | None = None
) -> RationalHalfSpace:
    """Fit eq. (9) to the exact compliance.

    Parameters
    ----------
    aspect_ratio : float
        alpha = L/B, positive.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.
    order : int
        Number of poles, 1 to 8.
    highest_a0 : float, optional
        Band of the fit in a0 = omega sqrt(BL)/v_s; 1 up to order 4 and 2 above when not given.

    Returns
    -------
    RationalHalfSpace
        Stable and passive. Kept for the next call with the same arguments.

    Raises
    ------
    HalfSpaceError
        If an argument is out of range.
    """
    require_positive(aspect_ratio=aspect_ratio)
    require_poisson_ratio(poisson_ratio)
    if not 1 <= order <= HIGHEST_ORDER or order != int(order):
        raise HalfSpaceError(f"order = {order!r} must be a whole number from 1 to {HIGHEST_ORDER}")
    if highest_a0 is None:
        highest_a0 = 1.0 if order <= 4 else 2.0
    require_positive(highest_a0=highest_a0)
    return _fit(float(aspect_ratio), float(poisson_ratio), int(order), float(highest_a0))


def rational_compliance(
    omega: npt.ArrayLike,
    shear_modulus_pa: float,
    density: float,
    poisson_ratio: float,
    half_width_m: float,
    half_length_m: float,
    order: int = 4,
) -> ComplexArray:
    """Compliance H(i omega) of the fitted half space.

    Parameters
    ----------
    omega : array_like, any shape
        Angular frequency, rad/s.
    shear_modulus_pa, density, poisson_ratio, half_width_m, half_length_m : float
        G (Pa), rho (kg/m^3), nu, B and L (m).
    order : int
        See `rational_half_space`.

    Returns
    -------
    ndarray of complex, same shape
        Settlement per newton, m/N, for exp(+i omega t).
    """
    require_positive(density=density)
    h0 = static_compliance(shear_modulus_pa, poisson_ratio, half_width_m, half_length_m)
    unit_time = math.sqrt(half_width_m * half_length_m * density / shear_modulus_pa)
    fit = rational_half_space(half_length_m / half_width_m, poisson_ratio, order)
    return h0 * fit.compliance(np.asarray(omega, dtype=np.float64) * unit_time)


@functools.lru_cache(maxsize=4096)
def _fit(
    aspect_ratio: float, poisson_ratio: float, order: int, highest_a0: float
) -> RationalHalfSpace:
    begin = time.perf_counter()
    poles, residues = rational_fit.fit(aspect_ratio, poisson_ratio, order, highest_a0)
    seconds = time.perf_counter() - begin
    for array in (poles, residues):
        array.flags.writeable = False
    return RationalHalfSpace(
        aspect_ratio=aspect_ratio,
        poisson_ratio=poisson_ratio,
        order=poles.size + int(np.count_nonzero(poles.imag)),
        highest_a0=highest_a0,
        poles=poles,
        residues=residues,
        fit_seconds=seconds,
    )


def _evaluate(a0: FloatArray, poles: ComplexArray, residues: ComplexArray) -> ComplexArray:
    s = 1j * a0[..., np.newaxis]
    upper = residues / (s - poles)
    lower = np.conj(residues) / (s - np.conj(poles))
    return np.asarray(0.5 * (upper + lower).sum(axis=-1))
