# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The kernel for the exact half space: its finite memory is the motion its surface would go on with.

History is kept as a physical quantity, the free motion and its rate at the coming samples if the force stayed as it
is. A step adds what its force does later: in a whole step a chord and a bulge, in a split one each bend of the force.
While the drum flies the force does not change and nothing is added.
"""

from __future__ import annotations

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.contact import split_step
from roller_sim_ros.drum_soil.finite_memory import (
    BEND_CURVATURE,
    BEND_SLOPE,
    BEND_TIME,
    Array,
    free_motion,
)
from roller_sim_ros.drum_soil.modes import Modes
from roller_sim_ros.drum_soil.parts import solve_part
from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.drum_soil.state import STILL_SLOPE, STILL_VELOCITY
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import inlined, njit

AIR, LOADING, UNLOADING, FINITE_MEMORY = at.AIR, at.LOADING, at.UNLOADING, at.FINITE_MEMORY


@inlined
def _add_bend(
    free: Array,
    free_rate: Array,
    base: int,
    memory: int,
    ramp_2: Array,
    ramp: Array,
    step: Array,
    h: float,
    time: float,
    slope: float,
    curvature: float,
) -> None:
    """Add what a bend of the force at a time of the last step adds to the coming motion at k h.

    P and R between samples are the cubics through their values and their derivatives' values.
    """
    v = time / h
    u = 1.0 - v
    h00 = (1.0 + 2.0 * u) * v * v
    h01 = u * u * (3.0 - 2.0 * u)
    h10 = u * v * v * h
    h11 = -u * u * v * h
    r01 = 6.0 * u * v / h
    r10 = v * (1.0 - 3.0 * u)
    r11 = u * (3.0 * u - 2.0)
    for k in range(memory):
        ramp_u = h00 * ramp[k] + h01 * ramp[k + 1] + h10 * step[k] + h11 * step[k + 1]
        ramp_2_u = h00 * ramp_2[k] + h01 * ramp_2[k + 1] + h10 * ramp[k] + h11 * ramp[k + 1]
        step_u = r01 * (ramp[k + 1] - ramp[k]) + r10 * step[k] + r11 * step[k + 1]
        free[base + k] += slope * ramp_u + curvature * ramp_2_u
        free_rate[base + k] += slope * step_u + curvature * ramp_u


@njit
def advance(
    samples: int,
    first: int,
    state: Array,
    constants: Array,
    sine: Array,
    cosine: Array,
    middle: Array,
    ramp_2: Array,
    ramp: Array,
    step: Array,
    chord: Array,
    chord_rate: Array,
    bulge_rate: Array,
    free: Array,
    free_rate: Array,
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
    middle : ndarray, shape (3,)
        P, R and s at h/2, H0 included here and below.
    ramp_2, ramp, step : ndarray, shape (memory + 1,)
        P, R and s at k h.
    chord, chord_rate : ndarray, shape (memory,)
        (R_{k+1} − R_k)/h and its rate: what a force that has risen evenly by 1 N adds.
    bulge_rate : ndarray, shape (memory,)
        Rate of what the bulge τ (h − τ) of the force adds; its value is chord_rate · h³/6.
    free, free_rate : ndarray, shape (memory + 1 + samples per revolution,)
        Coming free motion of the surface, from the present sample on; moved down on return.
    modes : ndarray, shape (ROWS, 0)
        None: this half space has no modes.
    bends : ndarray, shape BENDS_SHAPE
        Scratch.
    out : ndarray, shape (OUT_ROWS, samples)
        Receives the samples.
    """
    memory = chord.shape[0]
    h = constants[at.STEP]
    omega = constants[at.OMEGA]
    mass = constants[at.MASS]
    static_load = constants[at.STATIC_LOAD]
    plastic = constants[at.PLASTIC_COMPLIANCE]
    compliance = constants[at.STATIC_COMPLIANCE]
    total_rate = constants[at.ACCELERATION_RATE]
    vertical = constants[at.VERTICAL_SINE]
    rate = vertical * total_rate
    answer_middle = (middle[0], middle[1], middle[2])
    answer_end = (ramp_2[1], ramp[1], step[1])
    bulge = h * h * h / 6.0
    over_h = 1.0 / h
    drum_constants = (mass, static_load, plastic)
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

        e_next, w_next, e_2, w_2 = free[i + 1], free_rate[i + 1], free[i + 2], free_rate[i + 2]
        # The quintic of `free_motion` at h/2; first what does not wait for the step before.
        known_middle = (
            0.5625 * e_next
            + 0.0859375 * e_2
            - h * (0.28125 * w_next + 0.0234375 * w_2)
            + (0.3515625 * e + 0.0703125 * h * w),
            over_h * (1.5 * e_next - 0.046875 * e_2)
            - 0.1875 * w_next
            + 0.015625 * w_2
            - (1.453125 * over_h * e + 0.234375 * w),
        )
        slope_start, slope_end, d_1, v_1, force_1, e_1, w_1 = solve_part(
            phase,
            h,
            True,
            (d, v, force, q, datum),
            0.0,
            exciter_motion(0.5 * h, omega, sine[j], cosine[j], amplitude, rate),
            exciter_motion(h, omega, sine[j], cosine[j], amplitude, rate),
            known_middle,
            (e_next, w_next),
            answer_middle,
            answer_end,
            drum_constants,
        )
        if phase == LOADING:
            changes = slope_start + slope_end < -STILL_SLOPE or v_1 < w_1 - STILL_VELOCITY
        elif phase == UNLOADING:
            changes = slope_end > STILL_SLOPE or force_1 < 0.0
        else:
            changes = d_1 > e_1 + q + datum
        count = 0
        force_0 = force
        # An apex clear of the surface needs no location: only the plastic depth is renewed.
        at_apex = v < 0.0 and v_1 >= 0.0 and v_1 - v > STILL_VELOCITY
        if changes or (at_apex and not (phase == AIR and d_1 < e_1 + datum)):
            phase, new, count, unsettled = split_step(
                phase,
                (d, v, force, e, w, q, datum),
                h,
                drum_constants,
                (omega, sine[j], cosine[j], amplitude, rate),
                FINITE_MEMORY,
                free_motion(h, e, w, e_next, w_next, e_2, w_2),
                (ramp[1], step[1]),
                (0.0, 0.0, 0.0),
                modes,
                bends,
                (slope_start, slope_end, d_1, v_1, force_1, e_1, w_1),
            )
            d, v, force, e, w, q, datum = new
            unsettled_steps += unsettled
        else:
            if phase == LOADING:
                q += plastic * (force_1 - force)
            elif phase == UNLOADING:
                q = d_1 - e_1 - datum
            elif at_apex:
                q, datum = renewed(d_1, e_1, datum, 0.0, AIR, plastic)
            d, v, force, e, w = d_1, v_1, force_1, e_1, w_1

        # The step's force joins the history: what is beyond the memory has settled under the force before it.
        base = i + 1
        free[base + memory] = compliance * force_0
        free_rate[base + memory] = 0.0
        change = force - force_0
        if count > 0:
            for n in range(count):
                _add_bend(
                    free,
                    free_rate,
                    base,
                    memory,
                    ramp_2,
                    ramp,
                    step,
                    h,
                    bends[n, BEND_TIME],
                    bends[n, BEND_SLOPE],
                    bends[n, BEND_CURVATURE],
                )
        elif phase != AIR:
            kappa = (slope_start - slope_end) / (2.0 * h)
            bulge_value = bulge * kappa
            for k in range(memory):
                free[base + k] += change * chord[k] + bulge_value * chord_rate[k]
                free_rate[base + k] += change * chord_rate[k] + kappa * bulge_rate[k]
        free[base + memory] += change * compliance

    for k in range(memory + 1):
        free[k] = free[samples + k]
        free_rate[k] = free_rate[samples + k]
    state[at.DEPTH] = d
    state[at.VELOCITY] = v
    state[at.FORCE] = force
    state[at.SURFACE] = e
    state[at.SURFACE_VELOCITY] = w
    state[at.PLASTIC] = q
    state[at.DATUM] = datum
    state[at.PHASE] = phase
    state[at.UNSETTLED_STEPS] += unsettled_steps
