# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The exact transient as a table, and from it the FIR taps of the sampled half space.

For comparison with other implementations, which have a half space by its taps: nothing that runs uses them, since the
ground `exact` carries waves, not samples of an old sample period (`roller_sim_ros.drum_soil.exact_ground`).

One table per (alpha, nu), on a uniform grid of the dimensionless time tau = t v_s/sqrt(BL). The ramp
response R is interpolated by cubics (its derivative at the nodes is the step response s), s by their
derivative. Beyond the memory of the half space both are exact: s = 1 and R = tau - const.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.half_space.checks import require_poisson_ratio, require_positive
from roller_sim_ros.half_space.point_load import FloatArray
from roller_sim_ros.half_space.transient import memory as transient_memory
from roller_sim_ros.half_space.transient import step_and_ramp

TABLE_INTERVALS = 8192


@dataclass(frozen=True)
class StepResponse:
    """Normalised response of the rectangle's centre to a unit step of the load.

    Attributes
    ----------
    aspect_ratio : float
        alpha = L/B.
    poisson_ratio : float
        nu.
    spacing : float
        Distance of the table's nodes, in units of sqrt(BL)/v_s.
    memory : float
        T v_s/sqrt(BL): the response is static from here on.
    ramp_offset : float
        tau - R(tau) for tau >= memory.
    step : ndarray, shape (n,)
        s at the nodes k * spacing: 0 at first, 1 at the end. Read-only.
    ramp : ndarray, shape (n,)
        R = int_0^tau s at the nodes. Read-only.
    """

    aspect_ratio: float
    poisson_ratio: float
    spacing: float
    memory: float
    ramp_offset: float
    step: FloatArray
    ramp: FloatArray


def step_response(aspect_ratio: float, poisson_ratio: float) -> StepResponse:
    """Tabulate the exact transient once for each (alpha, nu).

    Parameters
    ----------
    aspect_ratio : float
        alpha = L/B, positive.
    poisson_ratio : float
        nu, 0 <= nu < 0.5.

    Returns
    -------
    StepResponse
        Kept for the next call with the same arguments.

    Raises
    ------
    HalfSpaceError
        If an argument is out of range.
    """
    require_positive(aspect_ratio=aspect_ratio)
    require_poisson_ratio(poisson_ratio)
    return _tabulate(float(aspect_ratio), float(poisson_ratio))


@functools.lru_cache(maxsize=64)
def _tabulate(aspect_ratio: float, poisson_ratio: float) -> StepResponse:
    span = transient_memory(aspect_ratio, poisson_ratio)
    spacing = span / TABLE_INTERVALS
    tau = spacing * np.arange(TABLE_INTERVALS + 2, dtype=np.float64)
    step, ramp = step_and_ramp(tau, aspect_ratio, poisson_ratio)
    offset = float(tau[-1] - ramp[-1])
    for table in (step, ramp):
        table.flags.writeable = False
    return StepResponse(aspect_ratio, poisson_ratio, spacing, span, offset, step, ramp)


def ramp_at(
    x: float,
    table_ramp: FloatArray,
    table_step: FloatArray,
    spacing: float,
    memory: float,
    ramp_offset: float,
) -> float:
    """Return R(x) at the dimensionless time x; zero for x <= 0. Arguments as in `StepResponse`."""
    if x <= 0.0:
        return 0.0
    if x >= memory:
        return x - ramp_offset
    position = x / spacing
    i = int(position)
    y = position - i
    rise = table_ramp[i + 1] - table_ramp[i]
    start, end = spacing * table_step[i], spacing * table_step[i + 1]
    curve = start + end - 2.0 * rise
    return float(table_ramp[i] + y * (start + y * (rise - start - curve + y * curve)))


def step_at(
    x: float,
    table_ramp: FloatArray,
    table_step: FloatArray,
    spacing: float,
    memory: float,
) -> float:
    """Return s(x), the exact derivative of `ramp_at`; zero for x <= 0, one from the memory on."""
    if x <= 0.0:
        return 0.0
    if x >= memory:
        return 1.0
    position = x / spacing
    i = int(position)
    y = position - i
    rise = (table_ramp[i + 1] - table_ramp[i]) / spacing
    curve = table_step[i] + table_step[i + 1] - 2.0 * rise
    return float(table_step[i] + y * (2.0 * (rise - table_step[i] - curve) + y * 3.0 * curve))


def taps(
    response: StepResponse, h0: float, sqrt_bl_over_vs_s: float, sample_period_s: float
) -> tuple[FloatArray, FloatArray]:
    """FIR taps of the half space under a force that is linear between the samples.

    Parameters
    ----------
    response : StepResponse
        From `step_response`.
    h0 : float
        Static compliance, m/N.
    sqrt_bl_over_vs_s : float
        sqrt(BL)/v_s, the unit of the dimensionless time, s.
    sample_period_s : float
        Delta t, s.

    Returns
    -------
    h : ndarray, shape (n,)
        Displacement taps, m/N: e_n = sum_k h_k F_{n-k}; they sum to H0 and none is negative.
    g : ndarray, shape (n,)
        Velocity taps, m/(N s), of the velocity just before the sample:
        e'_n = sum_k g_k F_{n-k}; they sum to zero.

    Notes
    -----
    h_k = H0 [R_{k+1} - 2 R_k + R_{k-1}]/Delta t and g_k = H0 [s_{k+1} - 2 s_k + s_{k-1}]/Delta t with
    R_{-1} = s_{-1} = 0: a triangular pulse of force is three ramps.
    """
    require_positive(h0=h0, sqrt_bl_over_vs_s=sqrt_bl_over_vs_s, sample_period_s=sample_period_s)
    delta = sample_period_s / sqrt_bl_over_vs_s
    count = int(np.ceil(response.memory / delta)) + 1
    table = (response.ramp, response.step, response.spacing, response.memory)
    nodes = [k * delta for k in range(-1, count + 1)]
    ramp = np.array([ramp_at(x, *table, response.ramp_offset) for x in nodes])
    step = np.array([step_at(x, *table) for x in nodes])
    return h0 * np.diff(ramp, 2) / delta, h0 * np.diff(step, 2) / sample_period_s
