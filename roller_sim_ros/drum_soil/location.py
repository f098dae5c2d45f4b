# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where in a part of a step an event happens.

The part that reaches over the event says about where: its force is a parabola, and position and velocity are known with
their rates at both ends. Two or three evaluations of shorter parts then make it as exact as the step itself.
"""

from __future__ import annotations

from roller_sim_ros.drum_soil.finite_memory import Array, Free
from roller_sim_ros.drum_soil.modes import Modes
from roller_sim_ros.drum_soil.part_of_step import Exciter, State, part_of_step, thrust_at
from roller_sim_ros.drum_soil.parts import Constants, Pair, Result
from roller_sim_ros.jit import inlined, njit

# What ends a part of a step.
STEP_END = 0
LOADING_ENDS = 1
RELOADING = 2
LIFT_OFF = 3
CONTACT = 4
APEX = 5

_CLOSE = 1e-4
"""Fraction of the step: an interpolation that moves the event by less is right to far below 1e-8 of it."""
_ITERATIONS = 40


@inlined
def event_value(event: int, result: Result, q: float, datum: float) -> float:
    """Return the function that falls through zero at the event."""
    _, slope_end, d, v, force, e, w = result
    if event == LOADING_ENDS:
        return v - w
    if event == RELOADING:
        return -slope_end
    if event == LIFT_OFF:
        return force
    if event == CONTACT:
        return e + q + datum - d
    return -v


@inlined
def _cubic_root(length: float, f_0: float, rate_0: float, f_1: float, rate_1: float) -> float:
    """Return about where the cubic through values and rates at 0 and `length` falls through zero."""
    rise = f_1 - f_0
    a, b = length * rate_0, length * rate_1
    c_2 = 3.0 * rise - 2.0 * a - b
    c_3 = a + b - 2.0 * rise
    u = -f_0 / rise
    for _ in range(2):
        u -= (f_0 + u * (a + u * (c_2 + u * c_3))) / (a + u * (2.0 * c_2 + 3.0 * u * c_3))
    return length * u


@inlined
def _guess(
    event: int,
    at_start: float,
    at_end: float,
    t: float,
    length: float,
    state: State,
    result: Result,
    constants: Constants,
    exciter: Exciter,
) -> float:
    """Return about where the event is, from the part that reaches over it."""
    _, v, force, _, w, _, _ = state
    slope_start, slope_end, _, v_1, force_1, _, w_1 = result
    if event == CONTACT:
        return _cubic_root(length, at_start, w - v, at_end, w_1 - v_1)
    if event == LIFT_OFF:
        return _cubic_root(length, at_start, slope_start, at_end, slope_end)
    if event == APEX:
        mass, static_load, _ = constants
        rising = thrust_at(t, exciter) - (static_load - force) / mass
        rising_1 = thrust_at(t + length, exciter) - (static_load - force_1) / mass
        return _cubic_root(length, at_start, rising, at_end, rising_1)
    # Where the slope of the force changes its sign.
    if slope_start * slope_end < 0.0:
        return length * slope_start / (slope_start - slope_end)
    return length * at_start / (at_start - at_end)


@njit
def locate(
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
    result: Result,
) -> float:
    """Return the time into the part at which the event happens.

    By inverse quadratic interpolation inside a bracket, from a guess; `result` is that of the whole part.
    """
    if at_start <= 0.0:
        return 0.0
    low, f_low = 0.0, at_start
    high, f_high = length, at_end
    x = _guess(event, at_start, at_end, t, length, state, result, constants, exciter)
    if not low < x < high:
        x = high - f_high * (high - low) / (f_high - f_low)
    for _ in range(_ITERATIONS):
        shorter = part_of_step(
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
        f = event_value(event, shorter, state[5], state[6])
        last = x
        below = (x - low) / (f - f_low)
        above = (high - x) / (f_high - f)
        x = last - f * below + f * f_low * (above - below) / (f_high - f_low)
        if f <= 0.0:
            high, f_high = last, f
        else:
            low, f_low = last, f
        if not low < x < high:
            x = high - f_high * (high - low) / (f_high - f_low)
            if not low < x < high:
                return last
        if abs(x - last) < _CLOSE * h:
            break
    return x
