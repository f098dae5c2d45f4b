"""One step of drum and soil where the half space answers a force with a velocity (paper, eqs 11 to 14, Figure 13).

For half spaces of relative degree 0 or 1 (`exact`). In each part of a step the force is a parabola,
F(τ) = F + σ τ + κ τ (x − τ), and the elastic depth is known up to it:

    e(τ) = e_known(τ) + Δσ R(τ) − 2 κ P(τ),   R = H0 ∫ s dτ,   P = ∫ R dτ,

with s the normalised step response and Δσ the change of slope at the part's start. Drum and soil agree at the part's middle
and end (Simpson's points, so that smooth motion is right to O(h⁴)): in loading in position, which the plastic layer
makes well posed; in unloading in velocity, the remaining position gap going into the plastic depth.

Within the step e_known is the quintic through the free motion's values and rates at this sample and the next two, and
R the cubic through R and s at 0 and h.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.drum_soil.state import AIR, LOADING, MAX_SPLITS, UNLOADING
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import inlined, njit

Array = NDArray[np.float64]
Pair = tuple[float, float]
Drum = tuple[float, float, float, float, float]
Constants = tuple[float, float, float]
Free = tuple[float, float, float, float, float, float]
Result = tuple[float, float, float, float, float, float, float]

# Columns of the array in which a step leaves where its force bends: time, jump of slope, jump of curvature.
BEND_TIME = 0
BEND_SLOPE = 1
BEND_CURVATURE = 2
BENDS_SHAPE = (MAX_SPLITS + 3, 3)

# What ends a part of a step.
_STEP_END = 0
_LOADING_ENDS = 1
_RELOADING = 2
_LIFT_OFF = 3
_CONTACT = 4
_APEX = 5

_ROOT_TOLERANCE = 1e-8
_ROOT_ITERATIONS = 40


@inlined
def solve_part(
    phase: int,
    x: float,
    drum: Drum,
    slope_before: float,
    moved_middle: Pair,
    moved_end: Pair,
    known_middle: Pair,
    known_end: Pair,
    answer_middle: tuple[float, float, float],
    answer_end: tuple[float, float, float],
    constants: Constants,
) -> Result:
    """Go on for x seconds in one phase.

    Parameters
    ----------
    phase
        LOADING, UNLOADING or AIR.
    x
        Length of the part, s.
    drum
        d, v, F, q, D at its start.
    slope_before
        Slope of the force that `known` goes on with.
    moved_middle, moved_end
        Velocity and travel that the exciter adds until the middle and the end, z up.
    known_middle, known_end
        e and e' there if the slope stayed.
    answer_middle, answer_end
        P, R and s there, H0 included.
    constants
        m_d, F_stat, p/F_stat.

    Returns
    -------
    sigma, kappa, depth, velocity, force, surface, surface_velocity : float
        The parabola of the force, and the state at the part's end.
    """
    d, v, force, q, datum = drum
    mass, static_load, plastic = constants
    ramp_2_y, ramp_y, step_y = answer_middle
    ramp_2, ramp, step = answer_end
    sinking = (static_load - force) / mass
    x_2 = x * x
    x_3 = x_2 * x / mass
    x_4 = x_3 * x
    d_free = d + x * v + 0.5 * x_2 * sinking - moved_end[1]
    v_free = v + x * sinking - moved_end[0]
    if phase == AIR:
        return (
            0.0,
            0.0,
            d_free,
            v_free,
            0.0,
            known_end[0] - slope_before * ramp,
            known_end[1] - slope_before * step,
        )
    if phase == LOADING:
        rest = q + datum
        right = d_free - rest - known_end[0] + slope_before * ramp
        d_y = d + 0.5 * x * v + 0.125 * x_2 * sinking - moved_middle[1]
        right_y = d_y - rest - known_middle[0] + slope_before * ramp_y
        a = x_3 / 6.0 + plastic * x + ramp
        b = x_4 / 12.0 + x * ramp - 2.0 * ramp_2
        a_y = x_3 / 48.0 + 0.5 * plastic * x + ramp_y
        b_y = x_4 / 64.0 + 0.25 * plastic * x_2 + x * ramp_y - 2.0 * ramp_2_y
    else:
        right = v_free - known_end[1] + slope_before * step
        v_y = v + 0.5 * x * sinking - moved_middle[0]
        right_y = v_y - known_middle[1] + slope_before * step_y
        a = 0.5 * x_2 / mass + step
        b = x_3 / 6.0 + x * step - 2.0 * ramp
        a_y = 0.125 * x_2 / mass + step_y
        b_y = x_3 / 12.0 + x * step_y - 2.0 * ramp_y
    inverse = 1.0 / (a * b_y - a_y * b)
    sigma = (right * b_y - right_y * b) * inverse
    kappa = (a * right_y - a_y * right) * inverse
    jump = sigma + kappa * x - slope_before
    return (
        sigma,
        kappa,
        d_free - sigma * x_3 / 6.0 - kappa * x_4 / 12.0,
        v_free - 0.5 * sigma * x_2 / mass - kappa * x_3 / 6.0,
        force + sigma * x,
        known_end[0] + jump * ramp - 2.0 * kappa * ramp_2,
        known_end[1] + jump * step - 2.0 * kappa * ramp,
    )


@inlined
def free_motion(
    h: float, e_0: float, w_0: float, e_1: float, w_1: float, e_2: float, w_2: float
) -> Free:
    """Return the quintic through values and rates of the free motion at 0, h and 2 h.

    As the cubic through those at 0 and h and the two coefficients of u² (1 − u)² (a + b (u − 2)) beside it.
    """
    rise = e_1 - e_0
    a = 0.25 * (e_2 - e_0 + 4.0 * rise - h * (2.0 * w_0 + 4.0 * w_1))
    b = 0.25 * (h * w_2 - (-12.0 * rise + h * (5.0 * w_0 + 8.0 * w_1)) - 12.0 * a)
    return e_0, w_0, e_1, w_1, a, b


@inlined
def _answer(x: float, h: float, ramp_h: float, step_h: float) -> tuple[float, float, float]:
    """Return P, R and s at 0 ≤ x ≤ h from R and s at h."""
    u = x / h
    ramp_2 = h * u * u * u * ((1.0 - 0.5 * u) * ramp_h + h * step_h * (0.25 * u - 1.0 / 3.0))
    ramp = u * u * ((3.0 - 2.0 * u) * ramp_h + (u - 1.0) * h * step_h)
    step = u * (6.0 * (1.0 - u) * ramp_h / h + (3.0 * u - 2.0) * step_h)
    return ramp_2, ramp, step


@inlined
def _known_surface(
    x: float,
    h: float,
    free: Free,
    answer_h: Pair,
    bends: Array,
    count: int,
) -> Pair:
    """Return e and e' at time x of the step if the force went on with its last slope."""
    e_0, w_0, e_1, w_1, a, b = free
    u = x / h
    v = 1.0 - u
    e = (1.0 + 2.0 * u) * v * v * e_0 + u * v * v * h * w_0
    e += u * u * (3.0 - 2.0 * u) * e_1 - u * u * v * h * w_1
    w = 6.0 * u * v * (e_1 - e_0) / h + v * (1.0 - 3.0 * u) * w_0 + u * (3.0 * u - 2.0) * w_1
    more = a + b * (u - 2.0)
    e += u * u * v * v * more
    w += u * v * (2.0 * (1.0 - 2.0 * u) * more + u * v * b) / h
    for j in range(count + 1):
        ramp_2, ramp, step = _answer(x - bends[j, BEND_TIME], h, answer_h[0], answer_h[1])
        e += bends[j, BEND_SLOPE] * ramp + bends[j, BEND_CURVATURE] * ramp_2
        w += bends[j, BEND_SLOPE] * step + bends[j, BEND_CURVATURE] * ramp
    return e, w


@njit
def _part(
    phase: int,
    t: float,
    x: float,
    slope_before: float,
    drum: Drum,
    h: float,
    free: Free,
    answer_h: Pair,
    constants: Constants,
    exciter: tuple[float, float, float, float],
    bends: Array,
    count: int,
) -> Result:
    """As `solve_part`, for the part of the step from t to t + x."""
    omega, phase_angle, amplitude, rate = exciter
    angle = phase_angle + omega * t
    sine, cosine = math.sin(angle), math.cos(angle)
    amplitude_t = amplitude + rate * t
    y = 0.5 * x
    return solve_part(
        phase,
        x,
        drum,
        slope_before,
        exciter_motion(y, omega, sine, cosine, amplitude_t, rate),
        exciter_motion(x, omega, sine, cosine, amplitude_t, rate),
        _known_surface(t + y, h, free, answer_h, bends, count),
        _known_surface(t + x, h, free, answer_h, bends, count),
        _answer(y, h, answer_h[0], answer_h[1]),
        _answer(x, h, answer_h[0], answer_h[1]),
        constants,
    )


@inlined
def _event_value(event: int, x: float, result: Result, q: float, datum: float) -> float:
    """Return the function that falls through zero at the event."""
    sigma, kappa, d, v, force, e, w = result
    if event == _LOADING_ENDS:
        return v - w
    if event == _RELOADING:
        return kappa * x - sigma
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
    drum: Drum,
    h: float,
    free: Free,
    answer_h: Pair,
    constants: Constants,
    exciter: tuple[float, float, float, float],
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
            phase, t, x, slope_before, drum, h, free, answer_h, constants, exciter, bends, count
        )
        f = _event_value(event, x, result, drum[3], drum[4])
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
    state: tuple[float, float, float, float, float, float, float, int],
    h: float,
    free: Free,
    answer_h: Pair,
    constants: Constants,
    exciter: tuple[float, float, float, float],
    bends: Array,
) -> tuple[float, float, float, float, float, float, float, int, int, int]:
    """Take one step in which phases change, each change located inside the step.

    Parameters
    ----------
    state
        d, v, F, e, e', q, D, phase at the sample.
    h
        Sample period, s.
    free
        From `free_motion`: how the surface would move if the force stayed as it is.
    answer_h
        R and s at h, H0 included.
    constants
        m_d, F_stat, p/F_stat.
    exciter
        ω, phase at the sample, vertical exciter acceleration and its rate there.
    bends : ndarray, shape BENDS_SHAPE
        Receives where the force bends, from a constant one before the step to a constant one after it.

    Returns
    -------
    d, v, F, e, e', q, D, phase : at the next sample
    count : int
        Bends written.
    unsettled : int
        1 when the phases did not settle within MAX_SPLITS parts.
    """
    d, v, force, e, w, q, datum, phase = state
    plastic = constants[2]
    t = 0.0
    slope_before = 0.0
    count = 0
    unsettled = 0
    bends[0, BEND_TIME] = 0.0
    bends[0, BEND_SLOPE] = 0.0
    bends[0, BEND_CURVATURE] = 0.0
    for split in range(MAX_SPLITS + 1):
        rest = h - t
        if rest <= 1e-9 * h:
            break
        drum = (d, v, force, q, datum)
        result = _part(
            phase, t, rest, slope_before, drum, h, free, answer_h, constants, exciter, bends, count
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
            # The slope at the start is that of the parabola over the rest of the step.
            event, at_start = _RELOADING, -result[0] - result[1] * rest
        if event != _STEP_END:
            at_end = _event_value(event, rest, result, q, datum)
            if at_end < 0.0:
                length = _locate(
                    event, at_start, at_end, rest, phase, t, slope_before, drum, h, free,
                    answer_h, constants, exciter, bends, count,
                )
            elif event == _LOADING_ENDS and result[0] < 0.0:
                length = 0.0
            else:
                event = _STEP_END
        if v < 0.0 and result[3] >= 0.0 and unsettled == 0:
            apex = _locate(
                _APEX, -v, -result[3], rest, phase, t, slope_before, drum, h, free, answer_h,
                constants, exciter, bends, count,
            )
            if apex < length or event == _STEP_END:
                event = _APEX
                length = apex
        if length > 0.0:
            if length < rest:
                result = _part(
                    phase, t, length, slope_before, drum, h, free, answer_h, constants, exciter,
                    bends, count,
                )
            sigma, kappa, d, v, force_1, e, w = result
            bends[count, BEND_SLOPE] = sigma + kappa * length - slope_before
            bends[count, BEND_CURVATURE] -= 2.0 * kappa
            count += 1
            slope_before = sigma - kappa * length
            t += length
            bends[count, BEND_TIME] = t
            bends[count, BEND_SLOPE] = 0.0
            bends[count, BEND_CURVATURE] = 2.0 * kappa
            if phase == LOADING:
                q += plastic * (force_1 - force)
            elif phase == UNLOADING:
                q = d - e - datum
            force = max(force_1, 0.0)
        if event == _LOADING_ENDS:
            phase = UNLOADING
        elif event == _RELOADING or event == _CONTACT:
            phase = LOADING
        elif event == _LIFT_OFF:
            phase = AIR
            force = 0.0
        elif event == _APEX:
            # At the apex itself the velocity is zero, not the rounding error that would find the apex again.
            v = 0.0
            q, datum = renewed(d, e, q, datum, force, phase, plastic)
        else:
            break
    bends[count, BEND_SLOPE] = -slope_before
    return d, v, force, e, w, q, datum, phase, count + 1, unsettled
