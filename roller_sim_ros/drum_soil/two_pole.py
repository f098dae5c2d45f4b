"""The kernel for the paper's two-pole half space (paper, eqs 9, 10, 13; Figure 13).

The surface obeys e'' = Ω² (H0 F − e) − (Ω/Q) e', stepped by the bilinear transform (trapezoidal rule). The transform
is prewarped at ω0: for a step x, Ω = (2/x) tan(ω0 x/2). Loading is solved at position level together with the plastic
layer; in unloading drum and surface move as one body, and the force follows from their joint acceleration, because this
half space answers a force with an acceleration.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.renewal import renewed
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.jit import inlined, njit

Array = NDArray[np.float64]
State = tuple[float, float, float, float, float, float, float]

AIR, LOADING, UNLOADING = at.AIR, at.LOADING, at.UNLOADING

_STEP_END = 0
_LOADING_ENDS = 1
_RELOADING = 2
_LIFT_OFF = 3
_CONTACT = 4
_APEX = 5

_ROOT_TOLERANCE = 1e-7
_ROOT_ITERATIONS = 40


@inlined
def warped(natural_frequency: float, x: float) -> float:
    """Return Ω in rad/s with which the bilinear transform of step x is exact at ω0."""
    return 2.0 / x * math.tan(0.5 * natural_frequency * x)


@inlined
def joint_force(
    e: float, w: float, pull: float, ground: tuple[float, float, float], mass: float
) -> float:
    """Return F for which drum and surface accelerate alike, N.

    Parameters
    ----------
    e, w
        Elastic depth and rate.
    pull
        Downward force on the drum beside F: F_stat less the exciter's, N.
    ground
        Ω, Q, H0.
    mass
        m_d, kg.
    """
    omega, quality, compliance = ground
    stiffness = omega * omega
    return (pull / mass + stiffness * e + omega / quality * w) / (
        stiffness * compliance + 1.0 / mass
    )


@inlined
def step_part(
    phase: int,
    x: float,
    state: State,
    exciter: tuple[float, float, float, float],
    ground: tuple[float, float, float],
    constants: tuple[float, float, float],
) -> State:
    """Go on for x seconds in one phase.

    Parameters
    ----------
    phase
        LOADING, UNLOADING or AIR.
    state
        d, v, F, e, e', q, D at the start.
    exciter
        Velocity and travel that the exciter adds (z up), its vertical acceleration at the start and at the end.
    ground
        Ω for this x, Q, H0.
    constants
        m_d, F_stat, p/F_stat.

    Returns
    -------
    State at the end.
    """
    d, v, force, e, w, q, datum = state
    lift, rise, thrust_0, thrust_1 = exciter
    omega, quality, compliance = ground
    mass, static_load, plastic = constants
    half = 0.5 * x
    stiffness = omega * omega
    damping = omega / quality
    if phase == UNLOADING:
        force = joint_force(e, w, static_load - mass * thrust_0, ground, mass)
        inertia = 1.0 + stiffness * compliance * mass
        a_0 = stiffness * (compliance * force - e) - damping * w
        w_half = w + half * a_0
        e_half = e + half * (w + w_half)
        a_1 = (
            stiffness * (compliance * (static_load - mass * thrust_1) - e_half) - damping * w_half
        ) / (inertia + half * (half * stiffness + damping))
        w_1 = w_half + half * a_1
        e_1 = e_half + half * half * a_1
        force_1 = static_load - mass * (thrust_1 + a_1)
        return e_1 + q + datum, w_1, force_1, e_1, w_1, q, datum
    # The surface for a force F_1 at the end: e_1 = e_free + e_gain F_1, w_1 = w_free + w_gain F_1.
    denominator = 1.0 + half * (half * stiffness + damping)
    a_0 = stiffness * (compliance * force - e) - damping * w
    w_free = (w + half * (a_0 - stiffness * (e + half * w))) / denominator
    w_gain = half * stiffness * compliance / denominator
    e_free = e + half * (w + w_free)
    e_gain = half * w_gain
    sinking = (static_load - force) / mass
    d_free = d + x * (v + half * sinking) - rise
    v_free = v + x * sinking - lift
    if phase == AIR:
        return d_free, v_free, 0.0, e_free, w_free, q, datum
    inertia = x * x / (6.0 * mass)
    force_1 = (
        d_free + inertia * force - e_free - q + plastic * force - datum
    ) / (inertia + e_gain + plastic)
    change = force_1 - force
    return (
        d_free - inertia * change,
        v_free - half * change / mass,
        force_1,
        e_free + e_gain * force_1,
        w_free + w_gain * force_1,
        q + plastic * change,
        datum,
    )


@njit
def _part(
    phase: int,
    t: float,
    x: float,
    state: State,
    constants: tuple[float, float, float],
    two_pole: tuple[float, float, float],
    drive: tuple[float, float, float, float],
) -> State:
    """As `step_part`, for the part of a step from t to t + x."""
    omega, phase_angle, amplitude, rate = drive
    natural_frequency, quality, compliance = two_pole
    angle = phase_angle + omega * t
    sine = math.sin(angle)
    amplitude_0 = amplitude + rate * t
    amplitude_1 = amplitude_0 + rate * x
    lift, rise = exciter_motion(x, omega, sine, math.cos(angle), amplitude_0, rate)
    exciter = (lift, rise, amplitude_0 * sine, amplitude_1 * math.sin(angle + omega * x))
    return step_part(
        phase, x, state, exciter, (warped(natural_frequency, x), quality, compliance), constants
    )


@inlined
def _event_value(event: int, state: State) -> float:
    """Return the function that falls through zero at the event."""
    d, v, force, e, w, q, datum = state
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
    h: float,
    state: State,
    constants: tuple[float, float, float],
    two_pole: tuple[float, float, float],
    drive: tuple[float, float, float, float],
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
        f = _event_value(event, _part(phase, t, x, state, constants, two_pole, drive))
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
    constants: tuple[float, float, float],
    two_pole: tuple[float, float, float],
    drive: tuple[float, float, float, float],
) -> tuple[int, State, int]:
    """Take one step in which phases change, each change located inside the step.

    Parameters
    ----------
    phase, state
        At the sample.
    h
        Sample period, s.
    constants
        m_d, F_stat, p/F_stat.
    two_pole
        ω0, Q, H0.
    drive
        ω, phase at the sample, vertical exciter acceleration and its rate there.

    Returns
    -------
    phase, state : at the next sample
    unsettled : int
        1 when the phases did not settle within MAX_SPLITS parts.
    """
    t = 0.0
    unsettled = 0
    mass, static_load, plastic = constants
    for split in range(at.MAX_SPLITS + 1):
        rest = h - t
        if rest <= 1e-9 * h:
            break
        end = _part(phase, t, rest, state, constants, two_pole, drive)
        length = rest
        event = _STEP_END
        if split == at.MAX_SPLITS:
            # The last part is taken as it stands, but for the sign of the force.
            unsettled = 1
        elif phase == LOADING:
            if end[1] < end[4] or end[2] < state[2]:
                event = _LOADING_ENDS
                length = 0.0
                if end[1] < end[4]:
                    length = _locate(
                        event, state[1] - state[4], end[1] - end[4], rest, phase, t, h, state,
                        constants, two_pole, drive,
                    )
        elif phase == UNLOADING:
            start_force = _joint_force_at(t, state, mass, static_load, two_pole, drive, h)
            if start_force <= 0.0:
                event = _LIFT_OFF
                length = 0.0
            elif end[2] > start_force:
                # The mean slope over (0, x) crosses zero at about twice the time at which the slope does.
                event = _RELOADING
                half = _part(phase, t, 0.5 * rest, state, constants, two_pole, drive)
                slope = (end[2] - start_force) / rest
                bend = slope - (half[2] - start_force) / (0.5 * rest)
                length = 0.0
                if bend > 0.0:
                    length = min(rest, max(0.0, 0.5 * (rest - 0.5 * rest * slope / bend)))
            elif end[2] < 0.0:
                event = _LIFT_OFF
                length = _locate(
                    event, start_force, end[2], rest, phase, t, h, state, constants, two_pole,
                    drive,
                )
        elif _event_value(_CONTACT, end) < 0.0:
            event = _CONTACT
            length = _locate(
                event, _event_value(_CONTACT, state), _event_value(_CONTACT, end), rest, phase, t,
                h, state, constants, two_pole, drive,
            )
        if state[1] < 0.0 and end[1] >= 0.0 and split < at.MAX_SPLITS:
            apex = _locate(
                _APEX, -state[1], -end[1], rest, phase, t, h, state, constants, two_pole, drive
            )
            if apex < length or event == _STEP_END:
                event = _APEX
                length = apex
        if length > 0.0:
            if length < rest:
                end = _part(phase, t, length, state, constants, two_pole, drive)
            state = (end[0], end[1], max(end[2], 0.0), end[3], end[4], end[5], end[6])
            t += length
        d, v, force, e, w, q, datum = state
        if event == _LOADING_ENDS:
            phase = UNLOADING
        elif event == _RELOADING or event == _CONTACT:
            phase = LOADING
        elif event == _LIFT_OFF:
            phase = AIR
            state = (d, v, 0.0, e, w, q, datum)
        elif event == _APEX:
            # At the apex itself the velocity is zero, not the rounding error that would find the apex again.
            q, datum = renewed(d, e, q, datum, force, phase, plastic)
            state = (d, 0.0, force, e, 0.0 if phase == UNLOADING else w, q, datum)
        else:
            break
    return phase, state, unsettled


@inlined
def _joint_force_at(
    t: float,
    state: State,
    mass: float,
    static_load: float,
    two_pole: tuple[float, float, float],
    drive: tuple[float, float, float, float],
    h: float,
) -> float:
    """Return the unloading force at time t of the step, which at the end of loading is below F (relative degree 2)."""
    omega, phase_angle, amplitude, rate = drive
    thrust = (amplitude + rate * t) * math.sin(phase_angle + omega * t)
    ground = (warped(two_pole[0], h - t), two_pole[1], two_pole[2])
    return joint_force(state[3], state[4], static_load - mass * thrust, ground, mass)


@njit
def advance(
    samples: int,
    first: int,
    state: Array,
    constants: Array,
    sine: Array,
    cosine: Array,
    phase_angle: Array,
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
    out : ndarray, shape (OUT_ROWS, samples)
        Receives the samples.
    """
    h = constants[at.STEP]
    omega = constants[at.OMEGA]
    mass = constants[at.MASS]
    static_load = constants[at.STATIC_LOAD]
    compliance = constants[at.STATIC_COMPLIANCE]
    total_rate = constants[at.ACCELERATION_RATE]
    vertical = constants[at.VERTICAL_SINE]
    rate = vertical * total_rate
    natural_frequency = constants[at.NATURAL_FREQUENCY]
    quality = constants[at.QUALITY]
    drum_constants = (mass, static_load, constants[at.PLASTIC_COMPLIANCE])
    two_pole = (natural_frequency, quality, compliance)
    ground = (warped(natural_frequency, h), quality, compliance)
    now = (
        state[at.DEPTH],
        state[at.VELOCITY],
        state[at.FORCE],
        state[at.SURFACE],
        state[at.SURFACE_VELOCITY],
        state[at.PLASTIC],
        state[at.DATUM],
    )
    phase = int(state[at.PHASE])
    unsettled_steps = 0

    for i in range(samples):
        j = first + i
        total = constants[at.START_ACCELERATION] + total_rate * (j * h)
        amplitude = vertical * total
        thrust = amplitude * sine[j]
        out[at.OUT_VERTICAL, i] = thrust + (now[2] - static_load) / mass
        out[at.OUT_HORIZONTAL, i] = total * (
            constants[at.HORIZONTAL_SINE] * sine[j] + constants[at.HORIZONTAL_COSINE] * cosine[j]
        )
        out[at.OUT_FORCE, i] = now[2]
        out[at.OUT_DEPTH, i] = now[0]
        out[at.OUT_SURFACE, i] = now[3]
        out[at.OUT_PLASTIC, i] = now[5]
        out[at.OUT_DATUM, i] = now[6]
        out[at.OUT_PHASE, i] = phase

        lift, rise = exciter_motion(h, omega, sine[j], cosine[j], amplitude, rate)
        thrust_1 = (amplitude + rate * h) * sine[j + 1]
        end = step_part(
            phase, h, now, (lift, rise, thrust, thrust_1), ground, drum_constants
        )
        if phase == LOADING:
            changes = end[1] < end[4] or end[2] < now[2]
        elif phase == UNLOADING:
            changes = end[2] > now[2] or end[2] < 0.0
        else:
            changes = end[0] > end[3] + end[5] + end[6]
        if now[1] < 0.0 and end[1] >= 0.0 and not changes:
            if phase == AIR and end[0] < end[3] + end[6]:
                # Clear of the surface, only the plastic depth is renewed: no location needed.
                q, datum = renewed(
                    end[0], end[3], end[5], end[6], 0.0, AIR, drum_constants[2]
                )
                end = (end[0], end[1], 0.0, end[3], end[4], q, datum)
            else:
                changes = True
        if changes:
            phase, now, unsettled = split_step(
                phase, now, h, drum_constants, two_pole, (omega, phase_angle[j], amplitude, rate)
            )
            unsettled_steps += unsettled
        else:
            now = end

    state[at.DEPTH] = now[0]
    state[at.VELOCITY] = now[1]
    state[at.FORCE] = now[2]
    state[at.SURFACE] = now[3]
    state[at.SURFACE_VELOCITY] = now[4]
    state[at.PLASTIC] = now[5]
    state[at.DATUM] = now[6]
    state[at.PHASE] = phase
    state[at.UNSETTLED_STEPS] += unsettled_steps
