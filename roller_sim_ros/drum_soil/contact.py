"""One step of drum and soil through the phases of Figure 13, each change located inside the step.

The same for all half spaces; what they do within a part of the step comes from `finite_memory`, `two_pole` and `modes`.
Loading ends when the drum no longer sinks into the soil (d' = e'), reloading begins when the force rises again, the
drum lifts off when the force is zero and meets the soil at zero gap; the soil is renewed at the drum's apex.
"""

from __future__ import annotations

import math

from roller_sim_ros.drum_soil.finite_memory import (
    BEND_CURVATURE,
    BEND_SLOPE,
    BEND_TIME,
    Array,
    Free,
    answer_within,
    known_surface,
)
from roller_sim_ros.drum_soil.modes import Modes, answers_and_motion, carry
from roller_sim_ros.drum_soil.parts import Constants, Pair, Result, solve_part
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
from roller_sim_ros.drum_soil.two_pole import (
    gauss_thrusts,
    joint_answer,
    joint_force,
    joint_part,
    two_pole_answer,
    two_pole_free,
)
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import inlined, njit

State = tuple[float, float, float, float, float, float, float]
Exciter = tuple[float, float, float, float]

# What ends a part of a step.
_STEP_END = 0
_LOADING_ENDS = 1
_RELOADING = 2
_LIFT_OFF = 3
_CONTACT = 4
_APEX = 5

_SHORTEST_PART = 1e-6
"""Fraction of the step below which a part is none: an event there is one at the part's start or end."""
_SHORTEST_PARABOLA = 0.05
"""Fraction of the step below which the force of a part is taken as linear: its bulge would be mostly noise."""

_STILL = (0.0, STILL_VELOCITY, STILL_SLOPE, 0.0, 0.0, 0.0)
"""By event, how far its function must have fallen below zero."""

_ROOT_TOLERANCE = 1e-8
_ROOT_ITERATIONS = 40


@inlined
def _part(
    phase: int,
    t: float,
    x: float,
    slope_before: float,
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
    count: int,
) -> Result:
    """As `solve_part`, for the part of the step from t to t + x."""
    d, v, force, e, w, q, datum = state
    omega, phase_angle, amplitude, rate = exciter
    angle = phase_angle + omega * t
    sine, cosine = math.sin(angle), math.cos(angle)
    amplitude_t = amplitude + rate * t
    y = 0.5 * x
    if half_space == TWO_POLE:
        if phase == UNLOADING:
            thrusts = gauss_thrusts(x, omega, sine, cosine, amplitude_t, rate)
            return joint_part(
                e,
                w,
                q + datum,
                thrusts,
                joint_answer(x, two_pole, constants[0]),
                two_pole,
                constants,
            )
        answer_x, motion_x = two_pole_answer(x, two_pole)
        known_x = two_pole_free(e, w, force, motion_x, two_pole)
        # In the air only the end is asked for.
        answer_y, known_y = answer_x, known_x
        if phase == LOADING:
            answer_y, motion_y = two_pole_answer(y, two_pole)
            known_y = two_pole_free(e, w, force, motion_y, two_pole)
        slope_before = 0.0
    elif half_space == MODES:
        answer_y, answer_x, known_y, known_x = answers_and_motion(x, force, two_pole[2], modes)
        slope_before = 0.0
    else:
        answer_y = answer_within(y, h, answer_h[0], answer_h[1])
        answer_x = answer_within(x, h, answer_h[0], answer_h[1])
        known_y = known_surface(t + y, h, free, answer_h, bends, count)
        known_x = known_surface(t + x, h, free, answer_h, bends, count)
    return solve_part(
        phase,
        x,
        x > _SHORTEST_PARABOLA * h,
        (d, v, force, q, datum),
        slope_before,
        exciter_motion(y, omega, sine, cosine, amplitude_t, rate),
        exciter_motion(x, omega, sine, cosine, amplitude_t, rate),
        known_y,
        known_x,
        answer_y,
        answer_x,
        constants,
    )


@inlined
def _event_value(event: int, result: Result, q: float, datum: float) -> float:
    """Return the function that falls through zero at the event."""
    _, slope_end, d, v, force, e, w = result
    if event == _LOADING_ENDS:
        return v - w
    if event == _RELOADING:
        return -slope_end
    if event == _LIFT_OFF:
        return force
    if event == _CONTACT:
        return e + q + datum - d
    return -v


@njit
def _locate(
    event: int,
    at_start: float,
    at_end: float,
    length: float,
    phase: int,
    t: float,
    slope_before: float,
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
    count: int,
) -> float:
    """Return the time into the part at which the event happens (regula falsi, Illinois variant)."""
    if at_start <= 0.0:
        return 0.0
    low, f_low = 0.0, at_start
    high, f_high = length, at_end
    side = 0
    x = high
    for _ in range(_ROOT_ITERATIONS):
        last = x
        x = high - f_high * (high - low) / (f_high - f_low)
        if abs(x - last) < _ROOT_TOLERANCE * h:
            break
        result = _part(
            phase,
            t,
            x,
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
        f = _event_value(event, result, state[5], state[6])
        if f <= 0.0:
            high, f_high = x, f
            if side == -1:
                f_low *= 0.5
            side = -1
        else:
            low, f_low = x, f
            if side == 1:
                f_high *= 0.5
            side = 1
        if f_high == f_low:
            break
    return x


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
        ω, phase at the sample, vertical exciter acceleration and its rate there.
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
        result = _part(
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
        event = _STEP_END
        at_start = 0.0
        if split == MAX_SPLITS:
            # The last part is taken as it stands, but for the sign of the force.
            unsettled = 1
        elif phase == LOADING:
            event, at_start = _LOADING_ENDS, v - w
        elif phase == AIR:
            event, at_start = _CONTACT, e + q + datum - d
        elif result[4] < 0.0:
            event, at_start = _LIFT_OFF, force
        else:
            event, at_start = _RELOADING, -result[0]
        if event != _STEP_END:
            at_end = _event_value(event, result, q, datum)
            if at_end < -_STILL[event]:
                length = _locate(
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
                )
            elif event == _LOADING_ENDS and result[0] + result[1] < -STILL_SLOPE:
                length = 0.0
            else:
                event = _STEP_END
        if v < 0.0 and result[3] >= 0.0 and result[3] - v > STILL_VELOCITY and unsettled == 0:
            apex = _locate(
                _APEX,
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
            )
            if apex < length or event == _STEP_END:
                event = _APEX
                length = apex
        if rest - length < _SHORTEST_PART * h:
            length = rest
        if length > _SHORTEST_PART * h:
            if length < rest:
                result = _part(
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
        if event == _LOADING_ENDS:
            phase = UNLOADING
            if half_space == TWO_POLE:
                # This half space answers a force with an acceleration: the force falls to what moves both alike.
                thrust = (exciter[2] + exciter[3] * t) * math.sin(exciter[1] + exciter[0] * t)
                force = max(joint_force(e, w, thrust, two_pole, constants), 0.0)
        elif event == _RELOADING or event == _CONTACT:
            phase = LOADING
        elif event == _LIFT_OFF:
            phase = AIR
            force = 0.0
        elif event == _APEX:
            # At the apex itself the velocity is zero, not the rounding error that would find the apex again.
            v = 0.0
            if phase == UNLOADING:
                w = 0.0
            q, datum = renewed(d, e, datum, force, phase, plastic)
        else:
            break
    bends[count, BEND_SLOPE] = -slope_before
    return phase, (d, v, force, e, w, q, datum), count + 1, unsettled
