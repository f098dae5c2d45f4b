# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's two-pole half space inside one step (paper, eq. 9 with two poles; eqs 11 to 14).

The surface obeys e'' + (ω0/Q) e' + ω0² e = ω0² H0 F. Its depth and rate are its whole history, and its motion under a
force that is a parabola in time is known in closed form, so there is no discretisation to warp. (The bilinear
transform, prewarped at ω0 as in the paper, is right at ω0 but makes the damping at working frequencies too small, by
(ω0 h)²/12: 8 % at ω0 h = 1, which is reached on stiff ground at low frequency.)

In unloading drum and surface move as one body of mass m_d + 1/(ω0² H0): this half space answers a force with an
acceleration, so the force follows from the joint acceleration.
"""

from __future__ import annotations

import math

from roller_sim_ros.drum_soil.parts import Constants, Pair, Result
from roller_sim_ros.exciter.force import small_turn
from roller_sim_ros.jit import inlined, njit

TwoPole = tuple[float, float, float]
Triple = tuple[float, float, float]
Thrusts = tuple[float, float, float, float, float, float, float]

# Three-point Gauss-Legendre quadrature on (0, 1).
_GAUSS_OFFSET = 0.5 * math.sqrt(0.6)
_NODES = (0.5 - _GAUSS_OFFSET, 0.5, 0.5 + _GAUSS_OFFSET)
_OUTER_WEIGHT = 5.0 / 18.0
_INNER_WEIGHT = 8.0 / 18.0


@njit
def oscillation(x: float, decay: float, stiffness: float) -> Triple:
    """Return the free solutions of y'' + 2 decay y' + stiffness y = 0 at x.

    Returns
    -------
    c1, c2, c2_rate : float
        y for (y, y') = (1, 0) and for (0, 1) at the start, and the latter's rate; c1' = −stiffness c2.
    """
    square = decay * decay - stiffness
    turn = math.sqrt(abs(square)) * x
    if turn < 0.03:
        # Near critical damping, and in a short time: the series of both branches.
        damped = math.exp(-decay * x)
        y = square * x * x
        c2 = damped * x * (1.0 + y * (1.0 / 6.0 + y * (1.0 / 120.0 + y * (1.0 / 5040.0))))
        even = damped * (1.0 + y * (0.5 + y * (1.0 / 24.0 + y * (1.0 / 720.0 + y / 40320.0))))
    elif square > 0.0:
        slow = 0.5 * math.exp(turn - decay * x)
        fast = 0.5 * math.exp(-turn - decay * x)
        c2 = (slow - fast) / turn * x
        even = slow + fast
    else:
        damped = math.exp(-decay * x)
        c2 = damped * math.sin(turn) / turn * x
        even = damped * math.cos(turn)
    return even + decay * c2, c2, even - decay * c2


@inlined
def twice(motion: Triple, stiffness: float) -> Triple:
    """Return the free solutions at 2 x from those at x."""
    c1, c2, c2_rate = motion
    both = stiffness * c2 * c2
    return c1 * c1 - both, c2 * (c1 + c2_rate), c2_rate * c2_rate - both


@inlined
def together(first: Triple, second: Triple, stiffness: float) -> Pair:
    """Return the solution for (0, 1) and its rate at x + y from the free solutions at x and at y."""
    return (
        first[0] * second[1] + first[1] * second[2],
        first[2] * second[2] - stiffness * first[1] * second[1],
    )


@njit
def two_pole_answer(x: float, two_pole: TwoPole) -> tuple[Triple, Triple]:
    """Return P, R and s at x, H0 included, and the free solutions there.

    Parameters
    ----------
    x
        Time, s.
    two_pole
        ω0, Q, H0.
    """
    omega, quality, _ = two_pole
    motion = oscillation(x, 0.5 * omega / quality, omega * omega)
    return _answer(x, motion, two_pole), motion


@inlined
def two_pole_answer_at_twice(x: float, half: Triple, two_pole: TwoPole) -> tuple[Triple, Triple]:
    """As `two_pole_answer`, from the free solutions at x/2."""
    motion = twice(half, two_pole[0] * two_pole[0])
    return _answer(x, motion, two_pole), motion


@inlined
def _answer(x: float, motion: Triple, two_pole: TwoPole) -> Triple:
    omega, quality, compliance = two_pole
    stiffness = omega * omega
    damping = omega / quality
    step = 1.0 - motion[0]
    ramp = x - motion[1] - damping / stiffness * step
    ramp_2 = 0.5 * x * x - (step + damping * ramp) / stiffness
    return compliance * ramp_2, compliance * ramp, compliance * step


@inlined
def two_pole_free(e: float, w: float, force: float, motion: Triple, two_pole: TwoPole) -> Pair:
    """Return e and e' after a time, if the force stayed, from those before and the free solutions."""
    omega, _, compliance = two_pole
    c1, c2, c2_rate = motion
    rest = compliance * force
    return rest + (e - rest) * c1 + w * c2, w * c2_rate - omega * omega * (e - rest) * c2


@inlined
def joint_force(
    e: float, w: float, thrust: float, two_pole: TwoPole, constants: Constants
) -> float:
    """Return F for which drum and surface accelerate alike, N.

    Parameters
    ----------
    e, w
        Elastic depth and rate.
    thrust
        Vertical exciter acceleration, m/s², z up.
    two_pole
        ω0, Q, H0.
    constants
        m_d, F_stat, p/F_stat.
    """
    omega, quality, compliance = two_pole
    mass, static_load, _ = constants
    stiffness = omega * omega
    return (static_load / mass - thrust + stiffness * e + omega / quality * w) / (
        stiffness * compliance + 1.0 / mass
    )


@inlined
def gauss_thrusts(
    x: float, omega: float, sine: float, cosine: float, amplitude: float, rate: float
) -> Thrusts:
    """Return the exciter's vertical acceleration at the Gauss points of (0, x), and it and its rate at both ends.

    Returns
    -------
    at_1, at_2, at_3, rate_start, at_end, rate_end, at_start : float
        m/s² and m/s³.
    """
    sine_1, cosine_1 = small_turn(omega * _NODES[0] * x)
    sine_2, cosine_2 = small_turn(omega * _NODES[1] * x)
    sine_3, cosine_3 = small_turn(omega * _NODES[2] * x)
    turn_sine, turn_cosine = small_turn(omega * x)
    at_1 = (amplitude + rate * _NODES[0] * x) * (sine * cosine_1 + cosine * sine_1)
    at_2 = (amplitude + rate * _NODES[1] * x) * (sine * cosine_2 + cosine * sine_2)
    at_3 = (amplitude + rate * _NODES[2] * x) * (sine * cosine_3 + cosine * sine_3)
    sine_end = sine * turn_cosine + cosine * turn_sine
    cosine_end = cosine * turn_cosine - sine * turn_sine
    end = amplitude + rate * x
    return (
        at_1,
        at_2,
        at_3,
        amplitude * omega * cosine + rate * sine,
        end * sine_end,
        end * omega * cosine_end + rate * sine_end,
        amplitude * sine,
    )


@njit
def joint_answer(
    x: float, two_pole: TwoPole, mass: float
) -> tuple[Triple, Triple, Triple, float, float, float]:
    """Return what `joint_part` needs of the joint oscillator for a part of x seconds.

    Returns
    -------
    motion : free solutions at x
    pulls, pull_rates : weights of the exciter's acceleration at the Gauss points in depth and velocity
    share, decay, stiffness : m_d over the joint mass, half the damping and the stiffness over the joint mass
    """
    omega, quality, compliance = two_pole
    soil_mass = 1.0 / (omega * omega * compliance)
    total = mass + soil_mass
    decay = 0.5 * soil_mass * omega / quality / total
    stiffness = 1.0 / (compliance * total)
    share = mass / total
    half = oscillation(0.5 * x, decay, stiffness)
    _, middle, middle_rate = half
    # The Gauss points lie symmetrically about the middle.
    _, last, last_rate = oscillation((1.0 - _NODES[2]) * x, decay, stiffness)
    apart = oscillation(_GAUSS_OFFSET * x, decay, stiffness)
    first, first_rate = together(half, apart, stiffness)
    outer = share * _OUTER_WEIGHT * x
    inner = share * _INNER_WEIGHT * x
    return (
        twice(half, stiffness),
        (outer * first, inner * middle, outer * last),
        (outer * first_rate, inner * middle_rate, outer * last_rate),
        share,
        decay,
        stiffness,
    )


@inlined
def joint_part(
    e: float,
    w: float,
    offset: float,
    thrusts: Thrusts,
    answer: tuple[Triple, Triple, Triple, float, float, float],
    two_pole: TwoPole,
    constants: Constants,
) -> Result:
    """Go on to the part's end in unloading, drum and surface moving as one.

    Parameters
    ----------
    e, w
        Elastic depth and rate at the start.
    offset
        q + D, depth of the drum below the elastic surface, m.
    thrusts
        From `gauss_thrusts`.
    answer
        From `joint_answer`.
    two_pole
        ω0, Q, H0.
    constants
        m_d, F_stat, p/F_stat.

    Returns
    -------
    slope_start, slope_end, depth, velocity, force, surface, surface_velocity : float
        As `solve_part`.
    """
    motion, pulls, pull_rates, share, decay, stiffness = answer
    mass, static_load, _ = constants
    rest = two_pole[2] * static_load
    y = e - rest
    e_1 = (
        rest
        + y * motion[0]
        + w * motion[1]
        - (pulls[0] * thrusts[0] + pulls[1] * thrusts[1] + pulls[2] * thrusts[2])
    )
    w_1 = (
        w * motion[2]
        - stiffness * y * motion[1]
        - (pull_rates[0] * thrusts[0] + pull_rates[1] * thrusts[1] + pull_rates[2] * thrusts[2])
    )
    force_1 = joint_force(e_1, w_1, thrusts[4], two_pole, constants)
    # F' = −m (a' + e''') with the joint motion's e''' = −2 decay e'' − stiffness e' − share a'.
    a_1 = (static_load - force_1) / mass - thrusts[4]
    slope_1 = mass * (2.0 * decay * a_1 + stiffness * w_1 + (share - 1.0) * thrusts[5])
    a_0 = -2.0 * decay * w - stiffness * y - share * thrusts[6]
    slope_0 = mass * (2.0 * decay * a_0 + stiffness * w + (share - 1.0) * thrusts[3])
    return slope_0, slope_1, e_1 + offset, w_1, force_1, e_1, w_1
