"""One step of drum and soil where the half space answers a force with a velocity (paper, eqs 11 to 14, Figure 13).

For half spaces of relative degree 0 or 1 (`exact`): the elastic depth is known up to a force that is linear in each
part of the step, e(τ) = e_known(τ) + Δσ H0 R(τ), with R the normalised ramp response. Loading is solved for the slope σ
of the force at position level (the plastic layer makes that well posed), unloading at velocity level, the remaining
position gap going into the plastic depth.

Within the step e_known is the cubic through its values and rates at both ends, and R the cubic through R and R' = s at
0 and h: both are off by O(h⁴).
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

# Columns of the array that a step leaves its changes of slope in.
KINK_TIME = 0
KINK_SLOPE = 1

# What ends a part of a step.
_STEP_END = 0
_LOADING_ENDS = 1
_RELOADING = 2
_LIFT_OFF = 3
_CONTACT = 4
_APEX = 5

_ROOT_TOLERANCE = 1e-7
_ROOT_ITERATIONS = 40


@inlined
def solve_part(
    phase: int,
    x: float,
    drum: tuple[float, float, float, float, float],
    slope_before: float,
    lift: float,
    rise: float,
    known: tuple[float, float],
    answer: tuple[float, float],
    constants: tuple[float, float, float],
) -> tuple[float, float, float, float, float, float]:
    """Go on for x seconds in one phase.

    Parameters
    ----------
    phase
        LOADING, UNLOADING or AIR.
    drum
        d, v, F, q, D at the start of the part.
    slope_before
        Slope of the force that `known` goes on with.
    lift, rise
        Velocity and travel that the exciter adds, z up.
    known
        e and e' at the end of the part if the slope stayed.
    answer
        H0 R(x) and H0 s(x): what a unit change of slope adds to them.
    constants
        m_d, F_stat, p/F_stat.

    Returns
    -------
    slope, depth, velocity, force, surface, surface_velocity : float
        Slope of the force over the part, and the state at its end.
    """
    d, v, force, q, datum = drum
    e_known, w_known = known
    ramp, step = answer
    mass, static_load, plastic = constants
    sinking = (static_load - force) / mass
    half_square = 0.5 * x * x
    sixth_cube = half_square * x / 3.0
    d_free = d + v * x + sinking * half_square - rise
    v_free = v + sinking * x - lift
    if phase == LOADING:
        slope = (d_free - q - datum - e_known + slope_before * ramp) / (
            sixth_cube / mass + plastic * x + ramp
        )
    elif phase == UNLOADING:
        slope = (v_free - w_known + slope_before * step) / (half_square / mass + step)
    else:
        slope = 0.0
    return (
        slope,
        d_free - slope * sixth_cube / mass,
        v_free - slope * half_square / mass,
        force + slope * x,
        e_known + (slope - slope_before) * ramp,
        w_known + (slope - slope_before) * step,
    )


@inlined
def _ramp_and_step(x: float, h: float, ramp_h: float, step_h: float) -> tuple[float, float]:
    """Return R(x) in s and s(x) for 0 ≤ x ≤ h from their values at h."""
    u = x / h
    ramp = u * u * ((3.0 - 2.0 * u) * ramp_h + (u - 1.0) * h * step_h)
    step = u * (6.0 * (1.0 - u) * ramp_h / h + (3.0 * u - 2.0) * step_h)
    return ramp, step


@inlined
def _known_surface(
    x: float,
    h: float,
    ends: tuple[float, float, float, float],
    answer_h: tuple[float, float],
    kinks: Array,
    count: int,
) -> tuple[float, float]:
    """Return e and e' at time x of the step if the force went on with its last slope."""
    e_0, w_0, e_1, w_1 = ends
    ramp_h, step_h = answer_h
    u = x / h
    v = 1.0 - u
    e = (1.0 + 2.0 * u) * v * v * e_0 + u * v * v * h * w_0
    e += u * u * (3.0 - 2.0 * u) * e_1 - u * u * v * h * w_1
    w = 6.0 * u * v * (e_1 - e_0) / h + v * (1.0 - 3.0 * u) * w_0 + u * (3.0 * u - 2.0) * w_1
    for j in range(count):
        ramp, step = _ramp_and_step(x - kinks[j, KINK_TIME], h, ramp_h, step_h)
        e += kinks[j, KINK_SLOPE] * ramp
        w += kinks[j, KINK_SLOPE] * step
    return e, w


@njit
def _part(
    phase: int,
    t: float,
    x: float,
    slope_before: float,
    drum: tuple[float, float, float, float, float],
    h: float,
    ends: tuple[float, float, float, float],
    answer_h: tuple[float, float],
    constants: tuple[float, float, float],
    exciter: tuple[float, float, float, float],
    kinks: Array,
    count: int,
) -> tuple[float, float, float, float, float, float]:
    """As `solve_part`, for the part of the step from t to t + x."""
    omega, phase_angle, amplitude, amplitude_rate = exciter
    angle = phase_angle + omega * t
    lift, rise = exciter_motion(
        x,
        omega,
        math.sin(angle),
        math.cos(angle),
        amplitude + amplitude_rate * t,
        amplitude_rate,
    )
    known = _known_surface(t + x, h, ends, answer_h, kinks, count)
    answer = _ramp_and_step(x, h, answer_h[0], answer_h[1])
    return solve_part(phase, x, drum, slope_before, lift, rise, known, answer, constants)


@inlined
def _event_value(
    event: int,
    result: tuple[float, float, float, float, float, float],
    q: float,
    datum: float,
) -> float:
    """Return the function that falls through zero at the event."""
    _, d, v, force, e, w = result
    if event == _LOADING_ENDS:
        return v - w
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
    drum: tuple[float, float, float, float, float],
    h: float,
    ends: tuple[float, float, float, float],
    answer_h: tuple[float, float],
    constants: tuple[float, float, float],
    exciter: tuple[float, float, float, float],
    kinks: Array,
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
            phase, t, x, slope_before, drum, h, ends, answer_h, constants, exciter, kinks, count
        )
        f = _event_value(event, result, drum[3], drum[4])
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
    known_end: tuple[float, float],
    answer_h: tuple[float, float],
    constants: tuple[float, float, float],
    exciter: tuple[float, float, float, float],
    kinks: Array,
) -> tuple[float, float, float, float, float, float, float, int, int, int]:
    """Take one step in which phases change, each change located inside the step.

    Parameters
    ----------
    state
        d, v, F, e, e', q, D, phase at the sample.
    h
        Sample period, s.
    known_end
        e and e' at the next sample if the force stayed as it is.
    answer_h
        H0 R(h) and H0 s(h).
    constants
        m_d, F_stat, p/F_stat.
    exciter
        ω, phase at the sample, vertical exciter acceleration and its rate there.
    kinks : ndarray, shape (MAX_SPLITS + 1, 2)
        Receives the times in the step and the changes of slope there, the first at 0 from slope 0.

    Returns
    -------
    d, v, F, e, e', q, D, phase : at the next sample
    count : int
        Kinks written.
    unsettled : int
        1 when the phases did not settle within MAX_SPLITS parts.
    """
    d, v, force, e, w, q, datum, phase = state
    plastic = constants[2]
    ends = (e, w, known_end[0], known_end[1])
    t = 0.0
    slope_before = 0.0
    count = 0
    unsettled = 0
    for split in range(MAX_SPLITS + 1):
        rest = h - t
        if rest <= 1e-9 * h:
            break
        drum = (d, v, force, q, datum)
        result = _part(
            phase, t, rest, slope_before, drum, h, ends, answer_h, constants, exciter, kinks, count
        )
        slope = result[0]
        length = rest
        event = _STEP_END
        if split == MAX_SPLITS:
            # The last part is taken as it stands, but for the sign of the force.
            unsettled = 1
        elif phase == LOADING:
            if slope < 0.0:
                phase = UNLOADING
                continue
            if result[2] < result[5]:
                event = _LOADING_ENDS
                length = _locate(
                    event, v - w, result[2] - result[5], rest, phase, t, slope_before, drum, h,
                    ends, answer_h, constants, exciter, kinks, count,
                )
        elif phase == UNLOADING:
            if slope > 0.0:
                # The mean slope over (0, x) crosses zero at about twice the time at which the slope does.
                event = _RELOADING
                half = _part(
                    phase, t, 0.5 * rest, slope_before, drum, h, ends, answer_h, constants,
                    exciter, kinks, count,
                )
                bend = slope - half[0]
                length = 0.0
                if bend > 0.0:
                    length = min(rest, max(0.0, 0.5 * (rest - 0.5 * rest * slope / bend)))
            elif result[3] < 0.0:
                event = _LIFT_OFF
                length = _locate(
                    event, force, result[3], rest, phase, t, slope_before, drum, h, ends,
                    answer_h, constants, exciter, kinks, count,
                )
        elif result[1] > result[4] + q + datum:
            event = _CONTACT
            length = _locate(
                event, e + q + datum - d, result[4] + q + datum - result[1], rest, phase, t,
                slope_before, drum, h, ends, answer_h, constants, exciter, kinks, count,
            )
        if v < 0.0 and result[2] >= 0.0 and split < MAX_SPLITS:
            apex = _locate(
                _APEX, -v, -result[2], rest, phase, t, slope_before, drum, h, ends, answer_h,
                constants, exciter, kinks, count,
            )
            if apex < length or event == _STEP_END:
                event = _APEX
                length = apex
        if length > 0.0:
            if length < rest:
                result = _part(
                    phase, t, length, slope_before, drum, h, ends, answer_h, constants, exciter,
                    kinks, count,
                )
                slope = result[0]
            kinks[count, KINK_TIME] = t
            kinks[count, KINK_SLOPE] = slope - slope_before
            count += 1
            slope_before = slope
            _, d, v, force, e, w = result
            t += length
            if phase == LOADING:
                q += plastic * slope * length
            elif phase == UNLOADING:
                q = d - e - datum
            force = max(force, 0.0)
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
    return d, v, force, e, w, q, datum, phase, count, unsettled
