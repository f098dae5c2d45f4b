# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One step of drum and soil through the phases of Figure 13, each change located inside the step.

The same for all half spaces; what they do within a part of the step comes from `finite_memory`, `two_pole` and `modes`.
Loading ends when the drum no longer sinks into the soil (d' = e'), reloading begins when the force rises again, the
drum lifts off when the force is zero and meets the soil at zero gap; the soil is renewed at the drum's apex.
"""

from __future__ import annotations

from roller_sim_ros.drum_soil.finite_memory import (
    BEND_CURVATURE,
    BEND_SLOPE,
    BEND_TIME,
    Array,
    Free,
)
from roller_sim_ros.drum_soil.location import (
    APEX,
    CONTACT,
    LIFT_OFF,
    LOADING_ENDS,
    RELOADING,
    STEP_END,
    event_value,
    locate,
)
from roller_sim_ros.drum_soil.modes import Modes, carry
from roller_sim_ros.drum_soil.part_of_step import Exciter, State, part_of_step, thrust_at
from roller_sim_ros.drum_soil.parts import Constants, Pair, Result
from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.drum_soil.state import (
    AIR,
    LOADING,
    MAX_SPLITS,
    MODES,
    STILL_SLOPE,
    STILL_VELOCITY,
    TWO_POLE,
    UNLOADING,
)
from roller_sim_ros.drum_soil.two_pole import joint_force
from roller_sim_ros.jit import njit

_SHORTEST_PART = 1e-6
"""Fraction of the step below which a part is none: an event there is one at the part's start or end."""

_STILL = (0.0, STILL_VELOCITY, STILL_SLOPE, 0.0, 0.0, 0.0)
"""By event, how far its function must have fallen below zero."""


@njit
def split_step(
    phase: int,
    state: State,
    h: float,
    constants: Constants,
    exciter: Exciter,
    half_space: int,
    free: Free,
    answer_h: Pair,
    two_pole: tuple[float, float, float],
    modes: Modes,
    bends: Array,
    result: Result,
) -> tuple[int, State, int, int]:
    """Take one step in which phases change, each change located inside the step.

    Parameters
    ----------
    phase, state
        At the sample; the state is d, v, F, e, e', q, D.
    h
        Sample period, s.
    constants
        m_d, F_stat, p/F_stat.
    exciter
        ω, sine and cosine at the sample, vertical exciter acceleration and its rate there.
    half_space
        FINITE_MEMORY, TWO_POLE or MODES.
    free, answer_h
        Finite memory: from `free_motion`, and R and s at h, H0 included.
    two_pole
        Two-pole: ω0, Q, H0; modes: H0 as the last.
    modes : ndarray, shape (ROWS, m)
        Modes: see `modes`; their distance from rest is moved on by the step.
    bends : ndarray, shape BENDS_SHAPE
        Receives where the force bends, from a constant one before the step to a constant one after it.
    result
        Of the whole step, had no phase changed.

    Returns
    -------
    phase, state
        At the next sample.
    count : int
        Bends written.
    unsettled : int
        1 when the phases did not settle within MAX_SPLITS parts.
    """
    plastic = constants[2]
    d, v, force, e, w, q, datum = state
    t = 0.0
    slope_before = 0.0
    count = 0
    unsettled = 0
    bends[0, BEND_TIME] = 0.0
    bends[0, BEND_SLOPE] = 0.0
    bends[0, BEND_CURVATURE] = 0.0
    for split in range(MAX_SPLITS + 1):
        rest = h - t
        if rest <= 0.0:
            break
        state = (d, v, force, e, w, q, datum)
        if split > 0:
            result = part_of_step(
                phase,
                t,
                rest,
                slope_before,
                state,
                h,
                constants,
                exciter,
                half_space,
                free,
                answer_h,
                two_pole,
                modes,
                bends,
                count,
            )
        length = rest
        event = STEP_END
        at_start = 0.0
        if split == MAX_SPLITS:
            # The last part is taken as it stands, but for the sign of the force.
            unsettled = 1
        elif phase == LOADING:
            event, at_start = LOADING_ENDS, v - w
        elif phase == AIR:
            event, at_start = CONTACT, e + q + datum - d
        elif result[4] < 0.0:
            event, at_start = LIFT_OFF, force
        else:
            event, at_start = RELOADING, -result[0]
        if event != STEP_END:
            at_end = event_value(event, result, q, datum)
            if at_end < -_STILL[event]:
                length = locate(
                    event,
                    at_start,
                    at_end,
                    rest,
                    phase,
                    t,
                    slope_before,
                    state,
                    h,
                    constants,
                    exciter,
                    half_space,
                    free,
                    answer_h,
                    two_pole,
                    modes,
                    bends,
                    count,
                    result,
                )
            elif event == LOADING_ENDS and result[0] + result[1] < -STILL_SLOPE:
                length = 0.0
            else:
                event = STEP_END
        if v < 0.0 and result[3] >= 0.0 and result[3] - v > STILL_VELOCITY and unsettled == 0:
            apex = locate(
                APEX,
                -v,
                -result[3],
                rest,
                phase,
                t,
                slope_before,
                state,
                h,
                constants,
                exciter,
                half_space,
                free,
                answer_h,
                two_pole,
                modes,
                bends,
                count,
                result,
            )
            if apex < length or event == STEP_END:
                event = APEX
                length = apex
        if rest - length < _SHORTEST_PART * h:
            length = rest
        if length > _SHORTEST_PART * h:
            if length < rest:
                result = part_of_step(
                    phase,
                    t,
                    length,
                    slope_before,
                    state,
                    h,
                    constants,
                    exciter,
                    half_space,
                    free,
                    answer_h,
                    two_pole,
                    modes,
                    bends,
                    count,
                )
            slope_start, slope_end, d, v, force_1, e, w = result
            curvature = (slope_end - slope_start) / length
            if half_space == MODES:
                carry(length, slope_start, curvature, modes)
            bends[count, BEND_SLOPE] = slope_start - slope_before
            bends[count, BEND_CURVATURE] += curvature
            count += 1
            slope_before = slope_end
            t = t + length if length < rest else h
            bends[count, BEND_TIME] = t
            bends[count, BEND_SLOPE] = 0.0
            bends[count, BEND_CURVATURE] = -curvature
            if phase == LOADING:
                q += plastic * (force_1 - force)
            elif phase == UNLOADING:
                q = d - e - datum
            force = max(force_1, 0.0)
        if event == LOADING_ENDS:
            phase = UNLOADING
            if half_space == TWO_POLE:
                # This half space answers a force with an acceleration: the force falls to what moves both alike.
                thrust = thrust_at(t, exciter)
                force = max(joint_force(e, w, thrust, two_pole, constants), 0.0)
        elif event == RELOADING or event == CONTACT:
            phase = LOADING
        elif event == LIFT_OFF:
            phase = AIR
            force = 0.0
        elif event == APEX:
            # At the apex itself the velocity is zero, not the rounding error that would find the apex again.
            v = 0.0
            if phase == UNLOADING:
                w = 0.0
            q, datum = renewed(d, e, datum, force, phase, plastic)
        else:
            break
    bends[count, BEND_SLOPE] = -slope_before
    return phase, (d, v, force, e, w, q, datum), count + 1, unsettled
