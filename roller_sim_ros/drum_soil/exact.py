"""The kernel for the exact half space: its finite memory is the motion its surface would go on with.

History is kept as a physical quantity, the free response c(t) and its rate c'(t) at the coming samples if the force
stayed as it is. A step whose force changes by ΔF adds ΔF (R(t+h) − R(t))/h; a change of slope inside the step adds the
difference that its place makes. While the drum flies the force does not change and nothing is added.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.drum_soil.velocity_contact import (
    KINK_SLOPE,
    KINK_TIME,
    solve_part,
    split_step,
)
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import inlined, njit

Array = NDArray[np.float64]

AIR, LOADING, UNLOADING = at.AIR, at.LOADING, at.UNLOADING


@inlined
def _add_kink(
    free: Array,
    free_rate: Array,
    base: int,
    memory: int,
    ramp: Array,
    step: Array,
    theta: float,
    h: float,
    change: float,
) -> None:
    """Add what a change of slope at fraction θ of the last step adds to the coming motion.

    Δσ H0 [R(t + (1−θ) h) − (1−θ) R(t + h) − θ R(t)] at the coming samples t = k h, with R between samples the cubic
    through R and s.
    """
    u = 1.0 - theta
    h00 = (1.0 + 2.0 * u) * theta * theta - theta
    h01 = u * u * (3.0 - 2.0 * u) - u
    h10 = u * theta * theta * h
    h11 = -u * u * theta * h
    r00 = 6.0 * u * theta / h
    r10 = theta * (1.0 - 3.0 * u) - theta
    r11 = u * (3.0 * u - 2.0) - u
    for k in range(memory):
        free[base + k] += change * (
            h00 * ramp[k] + h01 * ramp[k + 1] + h10 * step[k] + h11 * step[k + 1]
        )
        free_rate[base + k] += change * (
            r00 * (ramp[k + 1] - ramp[k]) + r10 * step[k] + r11 * step[k + 1]
        )


@njit
def advance(
    samples: int,
    first: int,
    state: Array,
    constants: Array,
    sine: Array,
    cosine: Array,
    phase_angle: Array,
    ramp: Array,
    step: Array,
    force_answer: Array,
    force_answer_rate: Array,
    free: Array,
    free_rate: Array,
    kinks: Array,
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
    sine, cosine, phase_angle : ndarray, shape (samples per revolution + 1,)
        Of the eccentric at the revolution's samples.
    ramp, step : ndarray, shape (memory + 1,)
        H0 R and H0 s at k h.
    force_answer, force_answer_rate : ndarray, shape (memory,)
        (R_{k+1} − R_k) H0/h and its rate.
    free, free_rate : ndarray, shape (memory + 1 + samples per revolution,)
        Coming free motion of the surface, from the present sample on; moved down on return.
    kinks : ndarray, shape (MAX_SPLITS + 1, 2)
        Scratch.
    out : ndarray, shape (OUT_ROWS, samples)
        Receives the samples.
    """
    memory = force_answer.shape[0]
    h = constants[at.STEP]
    omega = constants[at.OMEGA]
    mass = constants[at.MASS]
    static_load = constants[at.STATIC_LOAD]
    plastic = constants[at.PLASTIC_COMPLIANCE]
    compliance = constants[at.STATIC_COMPLIANCE]
    total_rate = constants[at.ACCELERATION_RATE]
    vertical = constants[at.VERTICAL_SINE]
    rate = vertical * total_rate
    answer_h = (ramp[1], step[1])
    tuple_constants = (mass, static_load, plastic)
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

        lift, rise = exciter_motion(h, omega, sine[j], cosine[j], amplitude, rate)
        known = (free[i + 1], free_rate[i + 1])
        slope, d_1, v_1, force_1, e_1, w_1 = solve_part(
            phase,
            h,
            (d, v, force, q, datum),
            0.0,
            lift,
            rise,
            known,
            answer_h,
            tuple_constants,
        )
        if phase == LOADING:
            changes = slope < 0.0 or v_1 < w_1
        elif phase == UNLOADING:
            changes = slope > 0.0 or force_1 < 0.0
        else:
            changes = d_1 > e_1 + q + datum
        count = 0
        force_0 = force
        if (changes or (v < 0.0 and v_1 >= 0.0)) and not (
            phase == AIR and not changes and _renew_only(d_1, e_1, datum)
        ):
            d, v, force, e, w, q, datum, phase, count, unsettled = split_step(
                (d, v, force, e, w, q, datum, phase),
                h,
                known,
                answer_h,
                tuple_constants,
                (omega, phase_angle[j], amplitude, rate),
                kinks,
            )
            unsettled_steps += unsettled
        else:
            if phase == LOADING:
                q += plastic * slope * h
            elif phase == UNLOADING:
                q = d_1 - e_1 - datum
            elif v < 0.0 and v_1 >= 0.0:
                q, datum = renewed(d_1, e_1, q, datum, 0.0, AIR, plastic)
            d, v, force, e, w = d_1, v_1, force_1, e_1, w_1

        # The step's force joins the history: what is beyond the memory has settled under the force before it.
        base = i + 1
        free[base + memory] = compliance * force_0
        free_rate[base + memory] = 0.0
        change = force - force_0
        if change != 0.0:
            for k in range(memory):
                free[base + k] += change * force_answer[k]
                free_rate[base + k] += change * force_answer_rate[k]
            free[base + memory] += change * compliance
        for n in range(1, count):
            _add_kink(
                free,
                free_rate,
                base,
                memory,
                ramp,
                step,
                kinks[n, KINK_TIME] / h,
                h,
                kinks[n, KINK_SLOPE],
            )

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


@inlined
def _renew_only(d: float, e: float, datum: float) -> bool:
    """Whether an apex in the air needs no location: the drum is clear of the surface, only q becomes zero."""
    return d < e + datum
