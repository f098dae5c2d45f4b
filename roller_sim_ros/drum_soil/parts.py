# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One part of a step, in one phase, under a parabolic force (paper, eqs 11 to 14, Figure 13).

In each part the force is F(τ) = F + σ τ + κ τ (x − τ), and the elastic depth is known up to it:

    e(τ) = e_known(τ) + Δσ R(τ) − 2 κ P(τ),   R = H0 ∫ s dτ,   P = ∫ R dτ,

with s the normalised step response and Δσ the change of slope at the part's start. Drum and soil agree at the part's
middle and end (Simpson's points, so that smooth motion is right to O(h⁴)): in loading in position, which the plastic
layer makes well posed; in unloading in velocity, the remaining position gap going into the plastic depth.
"""

from __future__ import annotations

from roller_sim_ros.drum_soil.state import AIR, LOADING
from roller_sim_ros.jit import inlined

Pair = tuple[float, float]
Drum = tuple[float, float, float, float, float]
Constants = tuple[float, float, float]
Result = tuple[float, float, float, float, float, float, float]


@inlined
def solve_part(
    phase: int,
    x: float,
    parabolic: bool,
    drum: Drum,
    slope_before: float,
    moved_middle: Pair,
    moved_end: Pair,
    known_middle: Pair,
    known_end: Pair,
    answer_middle: tuple[float, float, float],
    answer_end: tuple[float, float, float],
    constants: Constants,
) -> Result:
    """Go on for x seconds in one phase.

    Parameters
    ----------
    phase
        LOADING, UNLOADING or AIR.
    x
        Length of the part, s.
    parabolic
        Otherwise κ is zero and drum and soil agree at the part's end only.
    drum
        d, v, F, q, D at its start.
    slope_before
        Slope of the force that `known` goes on with.
    moved_middle, moved_end
        Velocity and travel that the exciter adds until the middle and the end, z up.
    known_middle, known_end
        e and e' there if the slope stayed.
    answer_middle, answer_end
        P, R and s there, H0 included.
    constants
        m_d, F_stat, p/F_stat.

    Returns
    -------
    slope_start, slope_end, depth, velocity, force, surface, surface_velocity : float
        Slopes of the force at both ends of the part, and the state at its end.
    """
    d, v, force, q, datum = drum
    mass, static_load, plastic = constants
    ramp_2_y, ramp_y, step_y = answer_middle
    ramp_2, ramp, step = answer_end
    sinking = (static_load - force) / mass
    x_2 = x * x
    x_3 = x_2 * x / mass
    x_4 = x_3 * x
    d_free = d + x * v + 0.5 * x_2 * sinking - moved_end[1]
    v_free = v + x * sinking - moved_end[0]
    if phase == AIR:
        return (
            0.0,
            0.0,
            d_free,
            v_free,
            0.0,
            known_end[0] - slope_before * ramp,
            known_end[1] - slope_before * step,
        )
    if phase == LOADING:
        rest = q + datum
        right = d_free - rest - known_end[0] + slope_before * ramp
        d_y = d + 0.5 * x * v + 0.125 * x_2 * sinking - moved_middle[1]
        right_y = d_y - rest - known_middle[0] + slope_before * ramp_y
        a = x_3 / 6.0 + plastic * x + ramp
        b = x_4 / 12.0 + x * ramp - 2.0 * ramp_2
        a_y = x_3 / 48.0 + 0.5 * plastic * x + ramp_y
        b_y = x_4 / 64.0 + 0.25 * plastic * x_2 + x * ramp_y - 2.0 * ramp_2_y
    else:
        right = v_free - known_end[1] + slope_before * step
        v_y = v + 0.5 * x * sinking - moved_middle[0]
        right_y = v_y - known_middle[1] + slope_before * step_y
        a = 0.5 * x_2 / mass + step
        b = x_3 / 6.0 + x * step - 2.0 * ramp
        a_y = 0.125 * x_2 / mass + step_y
        b_y = x_3 / 12.0 + x * step_y - 2.0 * ramp_y
    if parabolic:
        inverse = 1.0 / (a * b_y - a_y * b)
        sigma = (right * b_y - right_y * b) * inverse
        kappa = (a * right_y - a_y * right) * inverse
    else:
        sigma = right / a
        kappa = 0.0
    jump = sigma + kappa * x - slope_before
    return (
        sigma + kappa * x,
        sigma - kappa * x,
        d_free - sigma * x_3 / 6.0 - kappa * x_4 / 12.0,
        v_free - 0.5 * sigma * x_2 / mass - kappa * x_3 / 6.0,
        force + sigma * x,
        known_end[0] + jump * ramp - 2.0 * kappa * ramp_2,
        known_end[1] + jump * step - 2.0 * kappa * ramp,
    )
