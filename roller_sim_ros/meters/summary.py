# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The settled values of a run: what `roller-sim run` prints and what reference values are compared with."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.mode import Mode, true_mode
from roller_sim_ros.meters.period import period as repeats_after
from roller_sim_ros.meters.registry import ORDERS, evaluate
from roller_sim_ros.parameters import GRAVITY_M_S2, SAMPLES_PER_REVOLUTION
from roller_sim_ros.session.block import AIR

SUMMARY_REVOLUTIONS = 64


@dataclass(frozen=True)
class Summary:
    """Settled values over some revolutions.

    Attributes
    ----------
    period : int or None
        1, 2, 4 or 8 revolutions, 0 for none, None when there are too few revolutions to tell.
    force_ratio_max : float
        max F_s / F_stat.
    cmv, rmv : float
        From the DFT of all the revolutions; NaN when there is no vibration or, for RMV, an odd
        number.
    acceleration_max_g, acceleration_min_g : float
        Extreme vertical coordinate accelerations in units of g = 9.81 m/s².
    air_fraction : float
        Share of the samples without contact.
    blows_per_period : int
        Contacts that begin in one period; 0 when there is none.
    mode : Mode
        Operating mode from the contact states.
    """

    period: int | None
    force_ratio_max: float
    cmv: float
    rmv: float
    acceleration_max_g: float
    acceleration_min_g: float
    air_fraction: float
    blows_per_period: int
    mode: Mode


def summarise(
    vertical: NDArray[np.floating],
    soil_force: NDArray[np.floating],
    contact_state: NDArray[np.uint8],
    static_load_n: float,
    samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
) -> Summary:
    """Return the settled values over all the samples given, the last 64 revolutions of a run.

    Parameters
    ----------
    vertical : ndarray, shape (revolutions × samples_per_revolution,)
        Vertical coordinate acceleration of the drum, m/s².
    soil_force : ndarray, same shape
        F_s, N.
    contact_state : ndarray of uint8, same shape
        LOADING, UNLOADING or AIR.
    static_load_n : float
        F_stat, N.
    samples_per_revolution : int
        Samples in one revolution.

    Raises
    ------
    ValueError
        If the samples are not whole revolutions, or none.
    """
    samples = len(vertical)
    if samples == 0 or samples % samples_per_revolution:
        raise ValueError(
            f"{samples} samples are no whole revolutions of {samples_per_revolution} samples"
        )
    revolutions = samples // samples_per_revolution
    known = [order for order in ORDERS if (order * revolutions).is_integer()]
    values = dict.fromkeys(("cmv", "rmv"), math.nan)
    harmonics = order_amplitudes(vertical, known, samples_per_revolution)
    if known == list(ORDERS) and harmonics.amplitude(1.0) > 0.0:
        values = evaluate(harmonics)
    period = repeats_after(vertical, samples_per_revolution)
    air = np.asarray(contact_state) == AIR
    air_fraction = float(np.count_nonzero(air)) / samples
    return Summary(
        period=period,
        force_ratio_max=float(np.max(soil_force)) / static_load_n,
        cmv=values["cmv"],
        rmv=values["rmv"],
        acceleration_max_g=float(np.max(vertical)) / GRAVITY_M_S2,
        acceleration_min_g=float(np.min(vertical)) / GRAVITY_M_S2,
        air_fraction=air_fraction,
        blows_per_period=blows(air, period, samples_per_revolution),
        mode=true_mode(air_fraction, period),
    )


def blows(
    air: NDArray[np.bool_], period: int | None, samples_per_revolution: int = SAMPLES_PER_REVOLUTION
) -> int:
    """Return the number of contacts that begin within the last `period` revolutions.

    Parameters
    ----------
    air : ndarray of bool
        Whether the drum is in the air, more than one period of it.
    period : int or None
        Period in revolutions; 0 (none) and None (unknown) give 0.
    samples_per_revolution : int
        Samples in one revolution.
    """
    if not period:
        return 0
    last = air[-(period * samples_per_revolution + 1) :]
    return int(np.count_nonzero(last[:-1] & ~last[1:]))
