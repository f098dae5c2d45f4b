"""Half space as a rational function of any order, eq. (9), fitted by linear programming.

    H(s)/H0 = N(s)/D(s) = sum_j r_j/(s - p_j),    s in units of v_s/sqrt(BL),

with as many poles as the order says and one zero less: the response to a jump of the force starts with a
velocity, as that of the half space does, never with a jump. The fit goes to the exact compliance at the
actual aspect ratio and Poisson's ratio, in two stages, each a linear programme (Sandström 1994, 'Dynamic
vertical load on an elastic half space'):

1. N and D together from the linearised minimax problem |N - H D| <= t |D_before|, repeated until D settles
   (Sanathanan and Koerner). It gives the poles; those that come out unstable are mirrored, those so far
   out that they would ring at z = -1 are dropped.
2. With the poles fixed the residues are a true minimax problem, with the static value exact and the mobility
   i omega H of positive real part at all frequencies (passive) as further linear conditions.
"""

from __future__ import annotations

import functools
import math
import time
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linprog

from roller_sim_ros.half_space.checks import HalfSpaceError, require_poisson_ratio, require_positive
from roller_sim_ros.half_space.compliance import normalised_compliance
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray
from roller_sim_ros.half_space.static import static_compliance

HIGHEST_ORDER = 8
FARTHEST_POLE = 60.0
"""Poles with |s sqrt(BL)/v_s| above this are dropped: they ring at z = -1 and act on no band of interest."""

# The modulus of a complex error is bounded by the edges of a polygon.
_EDGES = np.exp(2j * np.pi * np.arange(16) / 16)
# Beyond its band the fit may err this many times more, up to so many bands: it keeps the fit sane there. The
# second and third are tried where the first leads to poles that had to be mirrored or dropped.
_LOOSENESS = (30.0, 10.0, 100.0)
_REACH = 4.0
# Passivity is asked for here, with this margin in Re(i omega H) (1 + 1/a0^2), and checked in between.
_PASSIVE_AT = np.geomspace(1e-3, 1e3 * FARTHEST_POLE, 120)
_LEAST_MOBILITY = 1e-4
_SETTLED = 1e-3
_MOST_ROUNDS = 15


@dataclass(frozen=True)
class RationalHalfSpace:
    """A fitted half space, dimensionless: e = H0 Re sum_j residues_j z_j, z_j' = poles_j z_j + F.

    Attributes
    ----------
    aspect_ratio, poisson_ratio : float
        alpha and nu of the exact compliance it was fitted to.
    order : int
        Number of poles, those of the lower half plane counted; less than what was asked for where poles
        had to be dropped.
    highest_a0 : float
        The band of the fit: a0 from zero to this.
    poles : ndarray of complex, shape (m,)
        p_j with Im p_j >= 0, in units of v_s/sqrt(BL). All real parts are negative. Read-only.
    residues : ndarray of complex, shape (m,)
        r_j in the same unit, real where the pole is real; twice the residue where the pole stands for a
        conjugate pair. Read-only.
    error : float
        Largest |H_fit - H|/H0 in the band.
    fit_seconds : float
        What the fit took.
    """

    aspect_ratio: float
    poisson_ratio: float
    order: int
    highest_a0: float
    poles: ComplexArray
    residues: ComplexArray
    error: float
    fit_seconds: float

    @property
    def dashpot(self) -> float:
        """Velocity over the jump of force that starts it, in units of H0 v_s/sqrt(BL)."""
        return float(self.residues.real.sum())

    def compliance(self, a0: npt.ArrayLike) -> ComplexArray:
        """Return H/H0 at the dimensionless frequency a0, for exp(+i omega t); same shape as `a0`."""
        s = 1j * np.asarray(a0, dtype=np.float64)[..., np.newaxis]
        upper = self.residues / (s - self.poles)
        lower = np.conj(self.residues) / (s - np.conj(self.poles))
        return np.asarray(0.5 * (upper + lower).sum(axis=-1))

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


@functools.lru_cache(maxsize=256)
def _fit(
    aspect_ratio: float, poisson_ratio: float, order: int, highest_a0: float
) -> RationalHalfSpace:
    begin = time.perf_counter()
    count = 12 + 4 * order
    # Chebyshev's points of the interval and its end: an error of this order hides between no two of them.
    inside = 0.5 * highest_a0 * (1.0 - np.cos(np.pi * (np.arange(count) + 0.5) / (count - 0.5)))
    outside = highest_a0 * np.geomspace(1.05, _REACH, 12)
    a0 = np.concatenate([inside, outside])
    exact = normalised_compliance(a0, aspect_ratio, poisson_ratio)
    best: tuple[float, ComplexArray, ComplexArray] | None = None
    for looseness in _LOOSENESS:
        allowed = np.where(a0 <= highest_a0, 1.0, looseness)
        poles, expected = _poles(a0 / highest_a0, exact, allowed, order)
        poles = poles * highest_a0
        kept = _stable(poles)
        residues = _residues(a0, exact, allowed, kept)
        fitted = _partial_fractions(1j * inside, kept) @ residues
        error = float(np.abs(fitted - exact[:count]).max())
        if best is None or error < best[0]:
            best = (error, kept, _complex_residues(kept, residues))
        if error <= 1.1 * expected + 1e-5:
            break
    assert best is not None
    error, kept, residues = best
    for array in (kept, residues):
        array.flags.writeable = False
    return RationalHalfSpace(
        aspect_ratio=aspect_ratio,
        poisson_ratio=poisson_ratio,
        order=int(np.where(kept.imag > 0.0, 2, 1).sum()),
        highest_a0=highest_a0,
        poles=kept,
        residues=residues,
        error=error,
        fit_seconds=time.perf_counter() - begin,
    )


def _poles(
    scaled_a0: FloatArray, exact: ComplexArray, allowed: FloatArray, order: int
) -> tuple[ComplexArray, float]:
    """First stage: poles over the band's end, and the error the free fit would have."""
    s = 1j * scaled_a0[:, np.newaxis]
    terms = np.hstack(
        [s ** np.arange(1, order), -exact[:, np.newaxis] * s ** np.arange(1, order + 1)]
    )
    objective = np.append(np.zeros(2 * order - 1), 1.0)
    before: FloatArray = np.ones_like(scaled_a0)
    best = (math.inf, np.ones(order))
    for _ in range(_MOST_ROUNDS):
        solution = linprog(
            objective,
            A_ub=_edges(terms, allowed * before),
            b_ub=np.outer(_EDGES, exact - 1.0).real.ravel(),
            bounds=[(None, None)] * (2 * order - 1) + [(0.0, None)],
            method="highs",
        )
        if solution.x is None:
            break
        found = solution.x[order - 1 : -1]
        denominator = 1.0 + s ** np.arange(1, order + 1) @ found
        fitted = (1.0 + s ** np.arange(1, order) @ solution.x[: order - 1]) / denominator
        error = float((np.abs(fitted - exact) / allowed).max())
        if error < best[0]:
            best = (error, found)
        size = np.abs(denominator)
        if np.abs(size / before - 1.0).max() < _SETTLED:
            break
        before = size
    return np.roots(np.append(best[1][::-1], 1.0)), best[0]


def _edges(terms: ComplexArray, allowed: FloatArray) -> FloatArray:
    """Rows of |terms x - target| <= t allowed, the last column being that of t."""
    rows = (_EDGES[:, np.newaxis, np.newaxis] * terms).real.reshape(-1, terms.shape[1])
    return np.hstack([rows, -np.tile(allowed, _EDGES.size)[:, np.newaxis]])


def _stable(poles: ComplexArray) -> ComplexArray:
    """Poles of the upper half plane and the real axis, mirrored to the left, far ones dropped."""
    mirrored = -np.abs(poles.real) + 1j * poles.imag
    kept = mirrored[(mirrored.imag >= 0.0) & (np.abs(mirrored) <= FARTHEST_POLE)]
    return np.asarray(kept[np.argsort(np.abs(kept))], dtype=np.complex128)


def _partial_fractions(s: ComplexArray, poles: ComplexArray) -> ComplexArray:
    """Columns 1/(s - p), and for each conjugate pair its real and imaginary combination."""
    columns = []
    for pole in poles:
        upper, lower = 1.0 / (s - pole), 1.0 / (s - np.conj(pole))
        if pole.imag == 0.0:
            columns.append(upper)
        else:
            columns += [0.5 * (upper + lower), 0.5j * (upper - lower)]
    return np.array(columns).T


def _residues(
    a0: FloatArray, exact: ComplexArray, allowed: FloatArray, poles: ComplexArray
) -> FloatArray:
    """Second stage: factors of the columns of `_partial_fractions`."""
    terms = _partial_fractions(1j * a0, poles)
    static = np.append(_partial_fractions(np.zeros(1, dtype=complex), poles).real, 0.0)
    objective = np.append(np.zeros(len(static) - 1), 1.0)
    rows = _edges(terms, allowed)
    limits = np.outer(_EDGES, exact).real.ravel()
    mobility = _mobility(_PASSIVE_AT, poles)
    everywhere = _mobility(np.geomspace(_PASSIVE_AT[0], _PASSIVE_AT[-1], 4000), poles)
    for _ in range(_MOST_ROUNDS):
        solution = linprog(
            objective,
            A_ub=np.vstack([rows, np.pad(-mobility, ((0, 0), (0, 1)))]),
            b_ub=np.append(limits, np.full(len(mobility), -_LEAST_MOBILITY)),
            A_eq=static[np.newaxis],
            b_eq=[1.0],
            bounds=[(None, None)] * (len(static) - 1) + [(0.0, None)],
            method="highs",
        )
        if solution.x is None:
            raise HalfSpaceError(
                f"no passive half space with the poles {poles}: {solution.message}"
            )
        found = np.asarray(solution.x[:-1])
        values = everywhere @ found
        if values.min() > 0.0:
            break
        mobility = np.vstack([mobility, everywhere[[np.argmin(values)]]])
    return found


def _mobility(a0: FloatArray, poles: ComplexArray) -> FloatArray:
    """Rows of Re(i omega H) times 1 + 1/a0^2, which has finite limits at both ends."""
    terms = _partial_fractions(1j * a0, poles)
    return np.asarray(-terms.imag * (a0 + 1.0 / a0)[:, np.newaxis])


def _complex_residues(poles: ComplexArray, factors: FloatArray) -> ComplexArray:
    """Return r_j of `RationalHalfSpace` from the factors of the columns."""
    rest = iter(factors)
    return np.array(
        [next(rest) + (1j * next(rest) if pole.imag > 0.0 else 0.0) for pole in poles],
        dtype=np.complex128,
    )
