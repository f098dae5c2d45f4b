# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A part of a step that is being split: what its half space does, put together with drum and exciter."""

from __future__ import annotations

from roller_sim_ros.drum_soil.finite_memory import Array, Free, answer_within, known_surface
from roller_sim_ros.drum_soil.modes import Modes, answers_and_motion
from roller_sim_ros.drum_soil.parts import Constants, Pair, Result, solve_part
from roller_sim_ros.drum_soil.state import MODES, TWO_POLE, UNLOADING
from roller_sim_ros.drum_soil.two_pole import (
    gauss_thrusts,
    joint_answer,
    joint_part,
    two_pole_answer,
    two_pole_answer_at_twice,
    two_pole_free,
)
from roller_sim_ros.exciter.force import exciter_motion, small_turn
from roller_sim_ros.jit import inlined

State = tuple[float, float, float, float, float, float, float]
"""d, v, F, e, e', q, D."""
Exciter = tuple[float, float, float, float, float]
"""ω, sine and cosine at the sample, vertical exciter acceleration there and its rate."""

_SHORTEST_PARABOLA = 0.05
"""Fraction of the step below which the force of a part is taken as linear: its bulge would be mostly noise."""


@inlined
def thrust_at(t: float, exciter: Exciter) -> float:
    """Return the vertical exciter acceleration at time t of the step, m/s²."""
    omega, sine, cosine, amplitude, rate = exciter
    sine_t, cosine_t = small_turn(omega * t)
    return (amplitude + rate * t) * (sine * cosine_t + cosine * sine_t)


@inlined
def part_of_step(
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
    omega, sine_0, cosine_0, amplitude, rate = exciter
    sine_t, cosine_t = small_turn(omega * t)
    sine = sine_0 * cosine_t + cosine_0 * sine_t
    cosine = cosine_0 * cosine_t - sine_0 * sine_t
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
        answer_y, motion_y = two_pole_answer(y, two_pole)
        answer_x, motion_x = two_pole_answer_at_twice(x, motion_y, two_pole)
        known_y = two_pole_free(e, w, force, motion_y, two_pole)
        known_x = two_pole_free(e, w, force, motion_x, two_pole)
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
