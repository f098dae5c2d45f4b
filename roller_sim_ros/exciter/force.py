# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the eccentric's force does to the drum over a (part of a) step (paper, eqs 11 and 12)."""

from __future__ import annotations

from roller_sim_ros.jit import inlined


@inlined
def exciter_motion(
    step_s: float,
    omega: float,
    sine: float,
    cosine: float,
    amplitude: float,
    amplitude_rate: float,
) -> tuple[float, float]:
    """Return the exciter's contribution to velocity and travel over one step, z up.

    Integrates (amplitude + amplitude_rate τ) sin(φ + ωτ) once and twice over 0…step_s, by power series in
    ω·step_s: exact to 1e-12 for 64 samples per revolution and more, to 3e-11 for 32.

    Parameters
    ----------
    step_s, omega
        Length of the step in s, angular frequency in rad/s.
    sine, cosine
        Of the eccentric's phase φ at the start of the step.
    amplitude, amplitude_rate
        Vertical exciter acceleration F_e/m_d in m/s² at the start, and its rate in m/s³.

    Returns
    -------
    velocity, travel : float
        In m/s and m.
    """
    x = omega * step_s
    xx = x * x
    h2 = step_s * step_s
    cos_0 = step_s * (1.0 - xx * (1.0 / 6.0 - xx * (1.0 / 120.0 - xx / 5040.0)))
    sin_0 = step_s * x * (0.5 - xx * (1.0 / 24.0 - xx * (1.0 / 720.0 - xx / 40320.0)))
    cos_1 = h2 * (0.5 - xx * (1.0 / 8.0 - xx * (1.0 / 144.0 - xx / 5760.0)))
    sin_1 = h2 * x * (1.0 / 3.0 - xx * (1.0 / 30.0 - xx * (1.0 / 840.0 - xx / 45360.0)))
    travel_cos_0 = h2 * (0.5 - xx * (1.0 / 24.0 - xx * (1.0 / 720.0 - xx / 40320.0)))
    travel_sin_0 = h2 * x * (1.0 / 6.0 - xx * (1.0 / 120.0 - xx * (1.0 / 5040.0 - xx / 362880.0)))
    travel_cos_1 = (
        h2 * step_s * (1.0 / 6.0 - xx * (1.0 / 40.0 - xx * (1.0 / 1008.0 - xx / 51840.0)))
    )
    travel_sin_1 = h2 * step_s * x * (1.0 / 12.0 - xx * (1.0 / 180.0 - xx / 6720.0))
    velocity = sine * (amplitude * cos_0 + amplitude_rate * cos_1) + cosine * (
        amplitude * sin_0 + amplitude_rate * sin_1
    )
    travel = sine * (amplitude * travel_cos_0 + amplitude_rate * travel_cos_1) + cosine * (
        amplitude * travel_sin_0 + amplitude_rate * travel_sin_1
    )
    return velocity, travel


@inlined
def small_turn(angle: float) -> tuple[float, float]:
    """Return sine and cosine of an angle up to 2π/32, by power series: exact to rounding."""
    y = angle * angle
    sine = angle * (
        1.0
        - y
        * (
            1.0 / 6.0
            - y * (1.0 / 120.0 - y * (1.0 / 5040.0 - y * (1.0 / 362880.0 - y / 39916800.0)))
        )
    )
    cosine = 1.0 - y * (
        0.5
        - y
        * (
            1.0 / 24.0
            - y * (1.0 / 720.0 - y * (1.0 / 40320.0 - y * (1.0 / 3628800.0 - y / 479001600.0)))
        )
    )
    return sine, cosine
