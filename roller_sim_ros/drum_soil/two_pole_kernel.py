# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The kernel for the paper's two-pole half space."""

from __future__ import annotations

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.contact import split_step
from roller_sim_ros.drum_soil.finite_memory import Array
from roller_sim_ros.drum_soil.modes import Modes
from roller_sim_ros.drum_soil.parts import solve_part
from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.drum_soil.state import STILL_SLOPE, STILL_VELOCITY
from roller_sim_ros.drum_soil.two_pole import (
    gauss_thrusts,
    joint_answer,
    joint_part,
    two_pole_answer,
    two_pole_free,
)
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import njit

AIR, LOADING, UNLOADING, TWO_POLE = at.AIR, at.LOADING, at.UNLOADING, at.TWO_POLE


@njit
def advance(
    samples: int,
    first: int,
    state: Array,
    constants: Array,
    sine: Array,
    cosine: Array,
    modes: Modes,
    bends: Array,
    out: Array,
) -> None:
    """Write the samples first … first + samples − 1 of a revolution and step over them.

    Parameters
    ----------
    samples, first : int
        How many, and the first one's index in the revolution.
    state : ndarray, shape (STATE_SIZE,)
        Physical state at the first sample; on return at the sample after the last.
    constants : ndarray, shape (CONSTANTS_SIZE,)
        Of the revolution.
    sine, cosine : ndarray, shape (samples per revolution + 1,)
        Of the eccentric at the revolution's samples.
    modes : ndarray, shape (ROWS, 0)
        None: this half space has no modes.
    bends : ndarray, shape BENDS_SHAPE
        Scratch.
    out : ndarray, shape (OUT_ROWS, samples)
        Receives the samples.
    """
    h = constants[at.STEP]
    omega = constants[at.OMEGA]
    mass = constants[at.MASS]
    static_load = constants[at.STATIC_LOAD]
    total_rate = constants[at.ACCELERATION_RATE]
    vertical = constants[at.VERTICAL_SINE]
    rate = vertical * total_rate
    plastic = constants[at.PLASTIC_COMPLIANCE]
    drum_constants = (mass, static_load, plastic)
    two_pole = (
        constants[at.NATURAL_FREQUENCY],
        constants[at.QUALITY],
        constants[at.STATIC_COMPLIANCE],
    )
    answer_middle, motion_middle = two_pole_answer(0.5 * h, two_pole)
    answer_end, motion_end = two_pole_answer(h, two_pole)
    joint = joint_answer(h, two_pole, mass)
    d = state[at.DEPTH]
    v = state[at.VELOCITY]
    force = state[at.FORCE]
    e = state[at.SURFACE]
    w = state[at.SURFACE_VELOCITY]
    q = state[at.PLASTIC]
    datum = state[at.DATUM]
    phase = int(state[at.PHASE])
    unsettled_steps = 0

    for i in range(samples):
        j = first + i
        total = constants[at.START_ACCELERATION] + total_rate * (j * h)
        amplitude = vertical * total
        out[at.OUT_VERTICAL, i] = amplitude * sine[j] + (force - static_load) / mass
        out[at.OUT_HORIZONTAL, i] = total * (
            constants[at.HORIZONTAL_SINE] * sine[j] + constants[at.HORIZONTAL_COSINE] * cosine[j]
        )
        out[at.OUT_FORCE, i] = force
        out[at.OUT_DEPTH, i] = d
        out[at.OUT_SURFACE, i] = e
        out[at.OUT_PLASTIC, i] = q
        out[at.OUT_DATUM, i] = datum
        out[at.OUT_PHASE, i] = phase

        if phase == UNLOADING:
            thrusts = gauss_thrusts(h, omega, sine[j], cosine[j], amplitude, rate)
            result = joint_part(e, w, q + datum, thrusts, joint, two_pole, drum_constants)
            changes = result[1] > STILL_SLOPE or result[4] < 0.0
        else:
            result = solve_part(
                phase,
                h,
                True,
                (d, v, force, q, datum),
                0.0,
                exciter_motion(0.5 * h, omega, sine[j], cosine[j], amplitude, rate),
                exciter_motion(h, omega, sine[j], cosine[j], amplitude, rate),
                two_pole_free(e, w, force, motion_middle, two_pole),
                two_pole_free(e, w, force, motion_end, two_pole),
                answer_middle,
                answer_end,
                drum_constants,
            )
            if phase == LOADING:
                changes = (
                    result[3] < result[6] - STILL_VELOCITY or result[0] + result[1] < -STILL_SLOPE
                )
            else:
                changes = result[2] > result[5] + q + datum
        if v < 0.0 and result[3] >= 0.0 and result[3] - v > STILL_VELOCITY and not changes:
            if phase == AIR and result[2] < result[5] + datum:
                # Clear of the surface, only the plastic depth is renewed: no location needed.
                q, datum = renewed(result[2], result[5], datum, 0.0, AIR, plastic)
            else:
                changes = True
        if changes:
            phase, new, _, unsettled = split_step(
                phase,
                (d, v, force, e, w, q, datum),
                h,
                drum_constants,
                (omega, sine[j], cosine[j], amplitude, rate),
                TWO_POLE,
                (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
                (0.0, 0.0),
                two_pole,
                modes,
                bends,
                result,
            )
            d, v, force, e, w, q, datum = new
            unsettled_steps += unsettled
        else:
            if phase == LOADING:
                q += plastic * (result[4] - force)
            d, v, force, e, w = result[2], result[3], result[4], result[5], result[6]

    state[at.DEPTH] = d
    state[at.VELOCITY] = v
    state[at.FORCE] = force
    state[at.SURFACE] = e
    state[at.SURFACE_VELOCITY] = w
    state[at.PLASTIC] = q
    state[at.DATUM] = datum
    state[at.PHASE] = phase
    state[at.UNSETTLED_STEPS] += unsettled_steps
