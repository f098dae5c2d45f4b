# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A whole step of several two-pole trajectories at once, without branches; a lane whose phase changes waits.

Each phase has a loop over all lanes that computes the step of that phase and keeps it where the lane is in it. The
compiler makes these loops into vector instructions: there is no branch in them, and none of their numbers depends on
another lane's. Expressions are those of `drum_soil.parts` and `drum_soil.two_pole`, in the same order, with what is
constant over a revolution computed beforehand: the results have the same bits as `drum_soil.two_pole_kernel`.
"""

from __future__ import annotations

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.state import STILL_SLOPE, STILL_VELOCITY
from roller_sim_ros.jit import inlined
from roller_sim_ros.sweep import lane_rows as of
from roller_sim_ros.sweep.lane_rows import LANES, Array


@inlined
def step_in_air(x: Array, sine: float, cosine: float) -> int:
    """Step the lanes that are in the air.

    Parameters
    ----------
    x : ndarray, shape (SIZE,)
        The lanes. The state goes on, or CHANGES is set where the drum lands in this step or turns near the ground.
    sine, cosine : float
        Of the eccentric's phase at the sample.

    Returns
    -------
    int
        How many lanes wait.
    """
    waiting = 0
    for n in range(LANES):
        here = x[of.PHASE + n] == at.AIR
        marked = x[of.CHANGES + n]
        d, v = x[of.DEPTH + n], x[of.VELOCITY + n]
        e, w = x[of.SURFACE + n], x[of.SURFACE_RATE + n]
        q, datum = x[of.PLASTIC + n], x[of.DATUM + n]
        h, sinking = x[of.STEP + n], x[of.STATIC_SINKING + n]
        travel = sine * x[of.END_TRAVEL_SINE + n] + cosine * x[of.END_TRAVEL_COSINE + n]
        added = sine * x[of.END_VELOCITY_SINE + n] + cosine * x[of.END_VELOCITY_COSINE + n]
        d_1 = d + h * v + x[of.HALF_SQUARE + n] * sinking - travel
        v_1 = v + h * sinking - added
        e_1 = e * x[of.END_C1 + n] + w * x[of.END_C2 + n]
        w_1 = w * x[of.END_C2_RATE + n] - x[of.STIFFNESS + n] * e * x[of.END_C2 + n]
        lands = d_1 > e_1 + q + datum
        apex = (v < 0.0) & (v_1 >= 0.0) & (v_1 - v > STILL_VELOCITY)
        clear = d_1 < e_1 + datum
        waits = here & (lands | (apex & (not clear)))
        goes = here & (not waits)
        # The fresh-soil rule in the air: no plastic depth is left, and the datum follows the drum.
        renews = goes & apex
        deeper = renews & (d_1 - e_1 > datum)
        x[of.DEPTH + n] = d_1 if goes else d
        x[of.VELOCITY + n] = v_1 if goes else v
        x[of.SURFACE + n] = e_1 if goes else e
        x[of.SURFACE_RATE + n] = w_1 if goes else w
        x[of.PLASTIC + n] = 0.0 if renews else q
        x[of.DATUM + n] = d_1 - e_1 if deeper else datum
        x[of.NEXT_SLOPE_START + n] = 0.0 if here else x[of.NEXT_SLOPE_START + n]
        x[of.NEXT_SLOPE_END + n] = 0.0 if here else x[of.NEXT_SLOPE_END + n]
        x[of.NEXT_DEPTH + n] = d_1 if here else x[of.NEXT_DEPTH + n]
        x[of.NEXT_VELOCITY + n] = v_1 if here else x[of.NEXT_VELOCITY + n]
        x[of.NEXT_FORCE + n] = 0.0 if here else x[of.NEXT_FORCE + n]
        x[of.NEXT_SURFACE + n] = e_1 if here else x[of.NEXT_SURFACE + n]
        x[of.NEXT_SURFACE_RATE + n] = w_1 if here else x[of.NEXT_SURFACE_RATE + n]
        x[of.CHANGES + n] = 1.0 if waits else marked
        waiting += 1 if waits else 0
    return waiting


@inlined
def step_unloading(x: Array, sine: float, cosine: float) -> int:
    """As `step_in_air`, for the lanes that are unloading: drum and surface move as one."""
    waiting = 0
    for n in range(LANES):
        here = x[of.PHASE + n] == at.UNLOADING
        marked = x[of.CHANGES + n]
        d, v, force = x[of.DEPTH + n], x[of.VELOCITY + n], x[of.FORCE + n]
        e, w = x[of.SURFACE + n], x[of.SURFACE_RATE + n]
        q, datum = x[of.PLASTIC + n], x[of.DATUM + n]
        amplitude, mass = x[of.AMPLITUDE + n], x[of.MASS + n]
        thrust_1 = amplitude * (sine * x[of.COSINE_1 + n] + cosine * x[of.SINE_1 + n])
        thrust_2 = amplitude * (sine * x[of.COSINE_2 + n] + cosine * x[of.SINE_2 + n])
        thrust_3 = amplitude * (sine * x[of.COSINE_3 + n] + cosine * x[of.SINE_3 + n])
        thrust = amplitude * (sine * x[of.COSINE_END + n] + cosine * x[of.SINE_END + n])
        thrust_rate = x[of.AMPLITUDE_RATE + n] * (
            cosine * x[of.COSINE_END + n] - sine * x[of.SINE_END + n]
        )
        rest = x[of.REST + n]
        y = e - rest
        c_2, stiffness = x[of.JOINT_C2 + n], x[of.JOINT_STIFFNESS + n]
        pulled = (
            x[of.PULL_1 + n] * thrust_1 + x[of.PULL_2 + n] * thrust_2 + x[of.PULL_3 + n] * thrust_3
        )
        pulled_rate = (
            x[of.PULL_RATE_1 + n] * thrust_1
            + x[of.PULL_RATE_2 + n] * thrust_2
            + x[of.PULL_RATE_3 + n] * thrust_3
        )
        e_1 = rest + y * x[of.JOINT_C1 + n] + w * c_2 - pulled
        w_1 = w * x[of.JOINT_C2_RATE + n] - stiffness * y * c_2 - pulled_rate
        known = x[of.STATIC_SINKING + n] - thrust
        force_1 = (known + x[of.STIFFNESS + n] * e_1 + x[of.DAMPING + n] * w_1) / x[
            of.INVERSE_SUM + n
        ]
        a_1 = (x[of.STATIC_LOAD + n] - force_1) / mass - thrust
        slope_1 = mass * (
            x[of.TWICE_JOINT_DECAY + n] * a_1
            + stiffness * w_1
            + x[of.SHARE_LESS_ONE + n] * thrust_rate
        )
        a_0 = (
            -x[of.TWICE_JOINT_DECAY + n] * w
            - stiffness * y
            - x[of.JOINT_SHARE + n] * (amplitude * sine)
        )
        slope_0 = mass * (
            x[of.TWICE_JOINT_DECAY + n] * a_0
            + stiffness * w
            + x[of.SHARE_LESS_ONE + n] * (x[of.AMPLITUDE_RATE + n] * cosine)
        )
        d_1 = e_1 + (q + datum)
        apex = (v < 0.0) & (w_1 >= 0.0) & (w_1 - v > STILL_VELOCITY)
        waits = here & ((slope_1 > STILL_SLOPE) | (force_1 < 0.0) | apex)
        goes = here & (not waits)
        x[of.DEPTH + n] = d_1 if goes else d
        x[of.VELOCITY + n] = w_1 if goes else v
        x[of.FORCE + n] = force_1 if goes else force
        x[of.SURFACE + n] = e_1 if goes else e
        x[of.SURFACE_RATE + n] = w_1 if goes else w
        x[of.NEXT_SLOPE_START + n] = slope_0 if here else x[of.NEXT_SLOPE_START + n]
        x[of.NEXT_SLOPE_END + n] = slope_1 if here else x[of.NEXT_SLOPE_END + n]
        x[of.NEXT_DEPTH + n] = d_1 if here else x[of.NEXT_DEPTH + n]
        x[of.NEXT_VELOCITY + n] = w_1 if here else x[of.NEXT_VELOCITY + n]
        x[of.NEXT_FORCE + n] = force_1 if here else x[of.NEXT_FORCE + n]
        x[of.NEXT_SURFACE + n] = e_1 if here else x[of.NEXT_SURFACE + n]
        x[of.NEXT_SURFACE_RATE + n] = w_1 if here else x[of.NEXT_SURFACE_RATE + n]
        x[of.CHANGES + n] = 1.0 if waits else marked
        waiting += 1 if waits else 0
    return waiting


@inlined
def step_loading(x: Array, sine: float, cosine: float) -> int:
    """As `step_in_air`, for the lanes that are loading: the plastic layer yields."""
    waiting = 0
    for n in range(LANES):
        here = x[of.PHASE + n] == at.LOADING
        marked = x[of.CHANGES + n]
        d, v, force = x[of.DEPTH + n], x[of.VELOCITY + n], x[of.FORCE + n]
        e, w = x[of.SURFACE + n], x[of.SURFACE_RATE + n]
        q, datum = x[of.PLASTIC + n], x[of.DATUM + n]
        h, mass = x[of.STEP + n], x[of.MASS + n]
        cube, fourth = x[of.CUBE + n], x[of.FOURTH + n]
        sinking = (x[of.STATIC_LOAD + n] - force) / mass
        travel = sine * x[of.END_TRAVEL_SINE + n] + cosine * x[of.END_TRAVEL_COSINE + n]
        travel_y = sine * x[of.MIDDLE_TRAVEL_SINE + n] + cosine * x[of.MIDDLE_TRAVEL_COSINE + n]
        added = sine * x[of.END_VELOCITY_SINE + n] + cosine * x[of.END_VELOCITY_COSINE + n]
        d_free = d + h * v + x[of.HALF_SQUARE + n] * sinking - travel
        v_free = v + h * sinking - added
        d_y = d + x[of.HALF_STEP + n] * v + x[of.EIGHTH_SQUARE + n] * sinking - travel_y
        settled = x[of.COMPLIANCE + n] * force
        away = e - settled
        known = settled + away * x[of.END_C1 + n] + w * x[of.END_C2 + n]
        known_rate = w * x[of.END_C2_RATE + n] - x[of.STIFFNESS + n] * away * x[of.END_C2 + n]
        known_y = settled + away * x[of.MIDDLE_C1 + n] + w * x[of.MIDDLE_C2 + n]
        rest = q + datum
        right = d_free - rest - known
        right_y = d_y - rest - known_y
        a, b = x[of.A_END + n], x[of.B_END + n]
        a_y, b_y = x[of.A_MIDDLE + n], x[of.B_MIDDLE + n]
        sigma = (right * b_y - right_y * b) * x[of.INVERSE + n]
        kappa = (a * right_y - a_y * right) * x[of.INVERSE + n]
        jump = sigma + kappa * h
        slope_1 = sigma - kappa * h
        ramp, ramp_2, answer = x[of.RAMP + n], x[of.RAMP_2 + n], x[of.STEP_ANSWER + n]
        d_1 = d_free - sigma * cube / 6.0 - kappa * fourth / 12.0
        v_1 = v_free - 0.5 * sigma * x[of.SQUARE + n] / mass - kappa * cube / 6.0
        force_1 = force + sigma * h
        e_1 = known + jump * ramp - 2.0 * kappa * ramp_2
        w_1 = known_rate + jump * answer - 2.0 * kappa * ramp
        q_1 = q + x[of.PLASTIC_COMPLIANCE + n] * (force_1 - force)
        apex = (v < 0.0) & (v_1 >= 0.0) & (v_1 - v > STILL_VELOCITY)
        ends = (v_1 < w_1 - STILL_VELOCITY) | (jump + slope_1 < -STILL_SLOPE)
        waits = here & (ends | apex)
        goes = here & (not waits)
        x[of.DEPTH + n] = d_1 if goes else d
        x[of.VELOCITY + n] = v_1 if goes else v
        x[of.FORCE + n] = force_1 if goes else force
        x[of.SURFACE + n] = e_1 if goes else e
        x[of.SURFACE_RATE + n] = w_1 if goes else w
        x[of.PLASTIC + n] = q_1 if goes else q
        x[of.NEXT_SLOPE_START + n] = jump if here else x[of.NEXT_SLOPE_START + n]
        x[of.NEXT_SLOPE_END + n] = slope_1 if here else x[of.NEXT_SLOPE_END + n]
        x[of.NEXT_DEPTH + n] = d_1 if here else x[of.NEXT_DEPTH + n]
        x[of.NEXT_VELOCITY + n] = v_1 if here else x[of.NEXT_VELOCITY + n]
        x[of.NEXT_FORCE + n] = force_1 if here else x[of.NEXT_FORCE + n]
        x[of.NEXT_SURFACE + n] = e_1 if here else x[of.NEXT_SURFACE + n]
        x[of.NEXT_SURFACE_RATE + n] = w_1 if here else x[of.NEXT_SURFACE_RATE + n]
        x[of.CHANGES + n] = 1.0 if waits else marked
        waiting += 1 if waits else 0
    return waiting
