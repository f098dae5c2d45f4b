# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Fit of eq. (9) by linear programming: poles from a linearised minimax problem, then the residues.

    H(s)/H0 = N(s)/D(s) = sum_j r_j/(s - p_j),    s in units of v_s/sqrt(BL),

with as many poles as the order says and one zero less: the response to a jump of the force starts with a
velocity, as that of the half space does, never with a jump (Sandström 1994, 'Dynamic vertical load on an
elastic half space').

1. |N - H D| <= t |D_before|, t least, repeated until D settles (Sanathanan and Koerner), with N(0) = D(0)
   = 1. Further linear conditions keep i omega N/D_before of positive real part, the zeros of D near (the sum
   of their real parts is bounded) and the dashpot of the first motion near the exact one. A round that
   loses stability is taken back half-way. Each order starts from the solution two orders below.
2. With the poles fixed the residues are a true minimax problem, with the static value exact and the
   mobility i omega H of positive real part at all frequencies (passive).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roller_sim_ros.half_space.compliance import normalised_compliance
from roller_sim_ros.half_space.point_load import ComplexArray, FloatArray
from roller_sim_ros.half_space.transient import initial_velocity, memory

FARTHEST_POLE = 60.0
"""Bound of the sum of |Re p| while the poles are sought; a pole beyond it is dropped in the end.

Poles farther out ring at z = -1 and act on no band of interest.
"""

LEAST_DAMPING = 0.02
"""Least damping ratio -Re p/|p| of a pole."""

# The modulus of a complex error is bounded by the edges of a polygon: 16 of them see 98 % of it.
_EDGES = np.exp(2j * np.pi * np.arange(16) / 16)
# Beyond its band, up to so many bands, the fit may err by so much times more plus so much of H0. It keeps the
# fit sane there; the harmonics of the drum's motion reach that far.
_REACH, _LOOSENESS, _SLACK = 4.0, 30.0, 0.03
# Bounds of the dashpot of the first motion, over the exact one.
_DASHPOT_BOUNDS = (0.5, 2.0)
# Where the first stage asks for passivity, over the end of the band.
_AXIS = np.geomspace(1e-2, 3e2, 180)
# Least leading coefficient of D over that of D_before: the degree is kept.
_LEAST_LEADING = 0.05
# Least Re(i omega H)(1 + 1/a0^2) where passivity is asked for; in between it is checked.
_LEAST_MOBILITY = 1e-3
_MOST_ROUNDS, _ROUNDS_ON_THE_WAY = 15, 3
# Over the end of the band, two for each further stage; apart, for a double pole has no partial fractions.
_STARTING_POLES = np.array([-1.3, -1.8, -1.1, -2.1, -0.9, -2.5, -0.75, -3.0], dtype=np.complex128)
_SETTLED = 1e-3
_GOOD_ENOUGH = 1e-4


@dataclass(frozen=True)
class _Target:
    """What is fitted: H/H0 at a0, and the error allowed there, slack + factor * t."""

    a0: FloatArray
    exact: ComplexArray
    factor: FloatArray
    slack: FloatArray
    highest_a0: float
    dashpot: tuple[float, float]


def fit(
    aspect_ratio: float, poisson_ratio: float, order: int, highest_a0: float
) -> tuple[ComplexArray, ComplexArray]:
    """Fit poles and residues.

    Parameters
    ----------
    aspect_ratio, poisson_ratio : float
        alpha and nu of the exact compliance.
    order : int
        Number of poles.
    highest_a0 : float
        End of the band in which the error counts.

    Returns
    -------
    poles, residues : ndarray of complex, shape (m,)
        As in `rational.RationalHalfSpace`: upper half plane and real axis, pairs with twice the residue.
    """
    target = _target(aspect_ratio, poisson_ratio, order, highest_a0)
    scaled = _STARTING_POLES[: 2 - order % 2]
    while scaled.size < order:
        scaled = np.append(
            _relocated(target, scaled, _ROUNDS_ON_THE_WAY),
            _STARTING_POLES[scaled.size : scaled.size + 2],
        )
    scaled = _relocated(target, scaled, _MOST_ROUNDS)
    poles = _kept(scaled * highest_a0)
    return poles, _residues(target, poles)


def _kept(poles: ComplexArray) -> ComplexArray:
    """Poles of the real axis and the upper half plane that are not too far, nearest first."""
    near = poles[(poles.imag >= 0.0) & (np.abs(poles) <= FARTHEST_POLE)]
    return near[np.argsort(np.abs(near))]


def _target(aspect_ratio: float, poisson_ratio: float, order: int, highest_a0: float) -> _Target:
    # Chebyshev's points of the band and its end: the error of a fit of this order hides between no two of
    # them. The compliance itself turns with the memory of the half space.
    turns = memory(aspect_ratio, poisson_ratio) * highest_a0
    count = 12 + 4 * order + math.ceil(0.8 * turns)
    inside = 0.5 * highest_a0 * (1.0 - np.cos(np.pi * (np.arange(count) + 0.5) / (count - 0.5)))
    a0 = np.concatenate([inside, highest_a0 * np.geomspace(1.05, _REACH, 12)])
    beyond = a0 > highest_a0
    dashpot = initial_velocity(aspect_ratio, poisson_ratio)
    return _Target(
        a0=a0,
        exact=normalised_compliance(a0, aspect_ratio, poisson_ratio),
        factor=np.where(beyond, _LOOSENESS, 1.0),
        slack=np.where(beyond, _SLACK, 0.0),
        highest_a0=highest_a0,
        # One pole has no freedom left for it.
        dashpot=(0.0, math.inf)
        if order == 1
        else (
            _DASHPOT_BOUNDS[0] * dashpot,
            _DASHPOT_BOUNDS[1] * dashpot,
        ),
    )


def _minimax(
    terms: ComplexArray,
    aim: ComplexArray,
    target: _Target,
    size: FloatArray,
    conditions: list[tuple[FloatArray, FloatArray]],
    equation: tuple[FloatArray, float] | None = None,
) -> FloatArray | None:
    """Return x with |terms x - aim| <= (slack + factor t) size and t least, or None.

    `conditions` are pairs of rows and bounds, rows x <= bounds; `equation` a row and its value.
    """
    from scipy.optimize import linprog  # takes as long as all else at start-up; only a fit needs it

    rows = (_EDGES[:, np.newaxis, np.newaxis] * terms).real.reshape(-1, terms.shape[1])
    rows = np.hstack([rows, -np.tile(target.factor * size, _EDGES.size)[:, np.newaxis]])
    bounds = np.outer(_EDGES, aim).real.ravel() + np.tile(target.slack * size, _EDGES.size)
    programme: dict[str, Any] = {
        "c": np.append(np.zeros(terms.shape[1]), 1.0),
        "A_ub": np.vstack([rows, *(np.pad(extra, ((0, 0), (0, 1))) for extra, _ in conditions)]),
        "b_ub": np.concatenate([bounds, *(bound for _, bound in conditions)]),
        "A_eq": None if equation is None else np.append(equation[0], 0.0)[np.newaxis],
        "b_eq": None if equation is None else [equation[1]],
        "bounds": [(None, None)] * terms.shape[1] + [(0.0, None)],
    }
    # The simplex method is the faster one, and it cycles now and then where the fit is nearly exact.
    solution = linprog(**programme, method="highs-ds", options={"maxiter": 1000})
    if solution.x is None:
        solution = linprog(**programme, method="highs-ipm", options={"maxiter": 200})
    return None if solution.x is None else np.asarray(solution.x[:-1])


def _relocated(target: _Target, start: ComplexArray, rounds: int) -> ComplexArray:
    """First stage: better poles than `start`, all over the band's end, conjugate pairs in full."""
    order = start.size
    s = 1j * target.a0[:, np.newaxis] / target.highest_a0
    zeros, powers = np.arange(1, order), np.arange(1, order + 1)
    axis = 1j * _AXIS[:, np.newaxis]
    weight = _AXIS + 1.0 / _AXIS
    before = _ascending(start)
    best_error, best = math.inf, before
    for _ in range(rounds):
        # Unknown are the coefficients over those of D_before, which are all positive.
        numerator, denominator = s**zeros * before[:-1], s**powers * before
        d_axis = 1.0 + (axis**powers) @ before
        size = np.abs(1.0 + denominator.sum(axis=1))
        passive = weight[:, np.newaxis] * (axis**zeros * before[:-1] / d_axis[:, np.newaxis]).imag
        conditions = [
            (
                np.pad(passive, ((0, 0), (0, order))),
                -weight * (1.0 / d_axis).imag - _LEAST_MOBILITY,
            ),
            _leading(order, before, target),
        ]
        found = _minimax(
            np.hstack([numerator, -target.exact[:, np.newaxis] * denominator]),
            target.exact - 1.0,
            target,
            size,
            conditions,
        )
        if found is None:
            break
        after = found[order - 1 :] * before
        fitted = (1.0 + numerator @ found[: order - 1]) / (1.0 + s**powers @ after)
        error = float(((np.abs(fitted - target.exact) - target.slack) / target.factor).max())
        change = np.abs(after / before - 1.0).max()
        damped = _damped(after)
        if damped and error < best_error:
            best_error, best = error, after
        if damped and (change < _SETTLED or error < _GOOD_ENOUGH):
            break
        # Half-way to an undamped or unstable D the resonance has not formed.
        for _ in range(3):
            if _damped(after):
                break
            after = 0.5 * (before + after)
        else:
            break
        before = after
    return np.asarray(np.roots(np.append(best[::-1], 1.0)), dtype=np.complex128)


def _ascending(poles: ComplexArray) -> FloatArray:
    """Coefficients of s, s^2, ... of the polynomial with these zeros and the constant 1."""
    coefficients = np.poly(poles).real
    return np.asarray(coefficients[-2::-1] / coefficients[-1])


def _damped(coefficients: FloatArray) -> bool:
    poles = np.roots(np.append(coefficients[::-1], 1.0))
    return bool(np.all(-poles.real >= LEAST_DAMPING * np.abs(poles)))


def _leading(order: int, before: FloatArray, target: _Target) -> tuple[FloatArray, FloatArray]:
    """Conditions on the leading coefficients: degree kept, poles near, dashpot bounded."""
    top = np.zeros(2 * order - 1)
    top[-1] = before[-1]
    next_lower = np.zeros(2 * order - 1)
    if order > 1:
        next_lower[-2] = before[-2]
    rows = [-top, next_lower - FARTHEST_POLE / target.highest_a0 * top]
    bounds = [-_LEAST_LEADING * before[-1], -1.0 if order == 1 else 0.0]
    if order > 1:
        zero = np.zeros(2 * order - 1)
        zero[order - 2] = before[order - 2] * target.highest_a0
        rows += [target.dashpot[0] * top - zero, zero - target.dashpot[1] * top]
        bounds += [0.0, 0.0]
    return np.array(rows), np.array(bounds)


def partial_fractions(s: npt.NDArray[Any], poles: ComplexArray) -> ComplexArray:
    """Columns 1/(s - p), and for each conjugate pair its real and its imaginary combination."""
    columns = []
    for pole in poles:
        upper, lower = 1.0 / (s - pole), 1.0 / (s - np.conj(pole))
        if pole.imag == 0.0:
            columns.append(upper)
        else:
            columns += [0.5 * (upper + lower), 0.5j * (upper - lower)]
    stacked: ComplexArray = np.array(columns, dtype=np.complex128).T
    return stacked


def _residues(target: _Target, poles: ComplexArray) -> ComplexArray:
    """Second stage: residues as in `rational.RationalHalfSpace`."""
    terms = partial_fractions(1j * target.a0, poles)
    static = partial_fractions(np.zeros(1), poles)[0].real
    is_real = np.concatenate([[True] if pole.imag == 0.0 else [True, False] for pole in poles])
    dashpot = np.where(is_real, 1.0, 0.0)[np.newaxis]
    conditions = [(-dashpot, np.array([-target.dashpot[0]]))]
    if math.isfinite(target.dashpot[1]):
        conditions.append((dashpot, np.array([target.dashpot[1]])))
    mobility = _mobility(_frequencies(poles, 100, 6.0, 25), poles)
    everywhere = _mobility(_frequencies(poles, 3000, 8.0, 1001), poles)
    found = None
    for _ in range(_MOST_ROUNDS):
        passive = (-mobility, np.full(len(mobility), -_LEAST_MOBILITY))
        found = _minimax(
            terms,
            target.exact,
            target,
            np.ones_like(target.a0),
            [*conditions, passive],
            equation=(static, 1.0),
        )
        if found is None:
            break
        values = everywhere @ found
        if values.min() > 0.5 * _LEAST_MOBILITY:
            break
        lowest = np.flatnonzero(
            np.r_[True, values[1:] < values[:-1]] & np.r_[values[:-1] <= values[1:], True]
        )
        mobility = np.vstack([mobility, everywhere[lowest[values[lowest] < _LEAST_MOBILITY]]])
    assert found is not None, "a sum of damped poles with a bounded dashpot can be passive"
    # The static value is exact to the last bits, not only to the programme's tolerance.
    rest = iter(found / (static @ found))
    return np.array(
        [next(rest) + (1j * next(rest) if pole.imag > 0.0 else 0.0) for pole in poles],
        dtype=np.complex128,
    )


def _frequencies(poles: ComplexArray, count: int, widths: float, near: int) -> FloatArray:
    """Frequencies over all decades and about each resonance, in units of its half width."""
    about = np.abs(poles.imag)[:, np.newaxis] + np.abs(poles.real)[:, np.newaxis] * np.linspace(
        -widths, widths, near
    )
    every = np.concatenate([np.geomspace(1e-3, 1e5, count), about.ravel()])
    return np.sort(every[every > 0.0])


def _mobility(a0: FloatArray, poles: ComplexArray) -> FloatArray:
    """Rows of Re(i omega H) times 1 + 1/a0^2, which has finite limits at both ends."""
    terms = partial_fractions(1j * a0, poles)
    return np.asarray(-terms.imag * (a0 + 1.0 / a0)[:, np.newaxis])
