# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the lanes of the two-pole kernel know of their trajectories: one row of `LANES` numbers for each fact.

All rows lie in one flat array, so that the compiler sees that they do not overlap and computes several lanes with one
instruction. A row's name stands for the place of its first lane.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.two_pole import gauss_thrusts, joint_answer, two_pole_answer
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import njit

Array = NDArray[np.float64]

LANES = 8

EMPTY = 3.0
"""Phase of a lane without a trajectory."""

_ROWS = 78

(
    # The state, in the order of `drum_soil.state`, and whether the step at hand changes the phase.
    DEPTH,
    VELOCITY,
    FORCE,
    SURFACE,
    SURFACE_RATE,
    PLASTIC,
    DATUM,
    PHASE,
    CHANGES,
    # The drum: h, h/2, h²/2, h²/8, m_d, F_stat, F_stat/m_d, p/F_stat.
    STEP,
    HALF_STEP,
    HALF_SQUARE,
    EIGHTH_SQUARE,
    MASS,
    STATIC_LOAD,
    STATIC_SINKING,
    PLASTIC_COMPLIANCE,
    # The exciter: its acceleration, times ω, ω; velocity and travel until end and middle for sin φ and for cos φ.
    AMPLITUDE,
    AMPLITUDE_RATE,
    OMEGA,
    END_VELOCITY_SINE,
    END_VELOCITY_COSINE,
    END_TRAVEL_SINE,
    END_TRAVEL_COSINE,
    MIDDLE_TRAVEL_SINE,
    MIDDLE_TRAVEL_COSINE,
    # The half space: ω0, Q, H0, ω0², ω0/Q, H0 F_stat; free solutions at end and middle.
    NATURAL_FREQUENCY,
    QUALITY,
    COMPLIANCE,
    STIFFNESS,
    DAMPING,
    REST,
    END_C1,
    END_C2,
    END_C2_RATE,
    MIDDLE_C1,
    MIDDLE_C2,
    # Loading, as in `parts.solve_part`: R, P and s at h, h³/m_d, h⁴/m_d, and the equations for slope and bulge.
    RAMP,
    RAMP_2,
    STEP_ANSWER,
    CUBE,
    FOURTH,
    SQUARE,
    A_END,
    B_END,
    A_MIDDLE,
    B_MIDDLE,
    INVERSE,
    # Unloading, as in `two_pole.joint_part`: free solutions, weights of the exciter at the Gauss points.
    JOINT_C1,
    JOINT_C2,
    JOINT_C2_RATE,
    PULL_1,
    PULL_2,
    PULL_3,
    PULL_RATE_1,
    PULL_RATE_2,
    PULL_RATE_3,
    JOINT_STIFFNESS,
    TWICE_JOINT_DECAY,
    JOINT_SHARE,
    SHARE_LESS_ONE,
    INVERSE_SUM,
    COSINE_1,
    COSINE_2,
    COSINE_3,
    COSINE_END,
    SINE_1,
    SINE_2,
    SINE_3,
    SINE_END,
    # What the whole step at hand comes to, as in `parts.Result`: for the lane whose phase changes in it.
    NEXT_SLOPE_START,
    NEXT_SLOPE_END,
    NEXT_DEPTH,
    NEXT_VELOCITY,
    NEXT_FORCE,
    NEXT_SURFACE,
    NEXT_SURFACE_RATE,
    # Steps whose phases did not settle.
    UNSETTLED,
) = range(0, LANES * _ROWS, LANES)

SIZE = LANES * _ROWS


@njit
def load(lanes: Array, lane: int, state: Array, constants: Array) -> None:
    """Put a trajectory into a lane.

    Parameters
    ----------
    lanes : ndarray, shape (SIZE,)
        All lanes.
    lane : int
        0 … LANES − 1.
    state : ndarray, shape (STATE_SIZE,)
        Physical state.
    constants : ndarray, shape (CONSTANTS_SIZE,)
        Of a revolution of constant amplitude.
    """
    x = lanes
    n = lane
    h = constants[at.STEP]
    omega = constants[at.OMEGA]
    mass = constants[at.MASS]
    static_load = constants[at.STATIC_LOAD]
    plastic = constants[at.PLASTIC_COMPLIANCE]
    natural = constants[at.NATURAL_FREQUENCY]
    quality = constants[at.QUALITY]
    compliance = constants[at.STATIC_COMPLIANCE]
    two_pole = (natural, quality, compliance)
    amplitude = constants[at.VERTICAL_SINE] * constants[at.START_ACCELERATION]
    for k in range(at.PHASE + 1):
        x[DEPTH + LANES * k + n] = state[k]
    x[CHANGES + n] = 0.0
    x[UNSETTLED + n] = 0.0

    x[STEP + n] = h
    x[HALF_STEP + n] = 0.5 * h
    x[HALF_SQUARE + n] = 0.5 * (h * h)
    x[EIGHTH_SQUARE + n] = 0.125 * (h * h)
    x[MASS + n] = mass
    x[STATIC_LOAD + n] = static_load
    x[STATIC_SINKING + n] = static_load / mass
    x[PLASTIC_COMPLIANCE + n] = plastic

    x[AMPLITUDE + n] = amplitude
    x[AMPLITUDE_RATE + n] = amplitude * omega
    x[OMEGA + n] = omega
    # With the sine 1 and the cosine 0, and the other way round, the functions give their coefficients.
    x[END_VELOCITY_SINE + n], x[END_TRAVEL_SINE + n] = exciter_motion(
        h, omega, 1.0, 0.0, amplitude, 0.0
    )
    x[END_VELOCITY_COSINE + n], x[END_TRAVEL_COSINE + n] = exciter_motion(
        h, omega, 0.0, 1.0, amplitude, 0.0
    )
    _, x[MIDDLE_TRAVEL_SINE + n] = exciter_motion(0.5 * h, omega, 1.0, 0.0, amplitude, 0.0)
    _, x[MIDDLE_TRAVEL_COSINE + n] = exciter_motion(0.5 * h, omega, 0.0, 1.0, amplitude, 0.0)

    x[NATURAL_FREQUENCY + n] = natural
    x[QUALITY + n] = quality
    x[COMPLIANCE + n] = compliance
    x[STIFFNESS + n] = natural * natural
    x[DAMPING + n] = natural / quality
    x[REST + n] = compliance * static_load
    answer_middle, motion_middle = two_pole_answer(0.5 * h, two_pole)
    answer_end, motion_end = two_pole_answer(h, two_pole)
    x[END_C1 + n], x[END_C2 + n], x[END_C2_RATE + n] = motion_end
    x[MIDDLE_C1 + n], x[MIDDLE_C2 + n], _ = motion_middle
    _load_loading(x, n, h, mass, plastic, answer_middle, answer_end)
    _load_unloading(x, n, h, omega, mass, two_pole)


@njit
def _load_loading(
    x: Array,
    n: int,
    h: float,
    mass: float,
    plastic: float,
    answer_middle: tuple[float, float, float],
    answer_end: tuple[float, float, float],
) -> None:
    # The same expressions as in parts.solve_part, for the same bits.
    ramp_2_y, ramp_y, _ = answer_middle
    ramp_2, ramp, step = answer_end
    square = h * h
    cube = square * h / mass
    fourth = cube * h
    a = cube / 6.0 + plastic * h + ramp
    b = fourth / 12.0 + h * ramp - 2.0 * ramp_2
    a_y = cube / 48.0 + 0.5 * plastic * h + ramp_y
    b_y = fourth / 64.0 + 0.25 * plastic * square + h * ramp_y - 2.0 * ramp_2_y
    x[RAMP + n] = ramp
    x[RAMP_2 + n] = ramp_2
    x[STEP_ANSWER + n] = step
    x[SQUARE + n] = square
    x[CUBE + n] = cube
    x[FOURTH + n] = fourth
    x[A_END + n] = a
    x[B_END + n] = b
    x[A_MIDDLE + n] = a_y
    x[B_MIDDLE + n] = b_y
    x[INVERSE + n] = 1.0 / (a * b_y - a_y * b)


@njit
def _load_unloading(
    x: Array, n: int, h: float, omega: float, mass: float, two_pole: tuple[float, float, float]
) -> None:
    motion, pulls, pull_rates, share, decay, stiffness = joint_answer(h, two_pole, mass)
    x[JOINT_C1 + n], x[JOINT_C2 + n], x[JOINT_C2_RATE + n] = motion
    x[PULL_1 + n], x[PULL_2 + n], x[PULL_3 + n] = pulls
    x[PULL_RATE_1 + n], x[PULL_RATE_2 + n], x[PULL_RATE_3 + n] = pull_rates
    x[JOINT_STIFFNESS + n] = stiffness
    x[TWICE_JOINT_DECAY + n] = 2.0 * decay
    x[JOINT_SHARE + n] = share
    x[SHARE_LESS_ONE + n] = share - 1.0
    natural, _, compliance = two_pole
    x[INVERSE_SUM + n] = natural * natural * compliance + 1.0 / mass
    cosines = gauss_thrusts(h, omega, 1.0, 0.0, 1.0, 0.0)
    sines = gauss_thrusts(h, omega, 0.0, 1.0, 1.0, 0.0)
    x[COSINE_1 + n], x[COSINE_2 + n], x[COSINE_3 + n] = cosines[0], cosines[1], cosines[2]
    x[SINE_1 + n], x[SINE_2 + n], x[SINE_3 + n] = sines[0], sines[1], sines[2]
    x[COSINE_END + n] = cosines[4]
    x[SINE_END + n] = sines[4]


@njit
def unload(lanes: Array, lane: int, state: Array) -> None:
    """Take a trajectory's state out of its lane.

    Parameters
    ----------
    lanes : ndarray, shape (SIZE,)
        All lanes.
    lane : int
        0 … LANES − 1.
    state : ndarray, shape (STATE_SIZE,)
        Receives the state; the count of unsettled steps is added to.
    """
    for k in range(at.PHASE + 1):
        state[k] = lanes[DEPTH + LANES * k + lane]
    state[at.UNSETTLED_STEPS] += lanes[UNSETTLED + lane]
    lanes[UNSETTLED + lane] = 0.0
