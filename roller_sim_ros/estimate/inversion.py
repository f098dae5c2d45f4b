# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Soil force and drum depth of a steady motion, straight from its acceleration: the machine is the force plate.

F_s = m_d (z'' − F_e sin φ/m_d) + F_stat, eq. (11), and the depth is the acceleration integrated twice, order by order.
What the ground adds is then a statement without any run of the model: in contact the drum's depth is elastic depth
plus plastic depth plus a datum, and the elastic depth is the half space's answer to the force.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.exciter import DIRECTIONS
from roller_sim_ros.parameters import Configuration

Array = NDArray[np.float64]

CONTACT = 0.03
"""Share of F_stat below which a force may be that of a drum in the air."""

SIGMAS = 4.0
"""Standard deviations of its noise below which a force may be none, and a rise none."""

LEAST_RISE = 1e-3
"""Share of F_stat below which a rise is rounding."""


@dataclass(frozen=True)
class Inverted:
    """What a waveform says of force and depth, all without a model of the ground.

    Attributes
    ----------
    force : ndarray, shape (n,)
        F_s, N, at each sample of the period.
    depth : ndarray, shape (n,)
        Drum depth about its mean, m, positive down; the drum's sinking from period to period does not show.
    contact : ndarray of int, shape (m,)
        Samples in contact, contact after contact.
    loaded : ndarray, shape (m,)
        Rises of the force since the contact began, added up, N: what the plastic layer has yielded to.
    basis : ndarray, shape (m, contacts + 1)
        Orthonormal; what the depth in contact may have beside elastic and plastic: a datum for each contact, and an
        even sinking.
    """

    force: Array
    depth: Array
    contact: NDArray[np.int64]
    loaded: Array
    basis: Array


def invert(vertical: Array, noise: float, period: int, known: Configuration) -> Inverted:
    """Return force and depth of a steady motion.

    Parameters
    ----------
    vertical : ndarray, shape (n,)
        One period of vertical acceleration without its mean, m/s², positive up, from phase zero on.
    noise : float
        Standard deviation of one of its samples, m/s².
    period : int
        Revolutions in it.
    known : Configuration
        Machine and exciter.
    """
    count = len(vertical)
    omega = 2.0 * math.pi * known.exciter.frequency_hz
    share = DIRECTIONS[known.exciter.kind](known.exciter.tilt_rad).vertical_sine
    thrust = share * known.exciter.amplitude_m * omega**2
    phase = 2.0 * math.pi * period * np.arange(count) / count
    mass, load = known.machine.drum_mass_kg, known.machine.static_load_n
    force = mass * (vertical - thrust * np.sin(phase)) + load
    orders = np.fft.rfft(vertical)
    rates = np.arange(len(orders)) * omega / period
    orders[1:] /= rates[1:] ** 2
    orders[0] = 0.0
    force_noise = SIGMAS * mass * noise
    in_contact = force > max(CONTACT * load, force_noise)
    contact, number, loaded = _loading(force, in_contact, max(LEAST_RISE * load, force_noise))
    basis = np.zeros((len(contact), (int(number.max()) + 1 if len(number) else 0) + 1))
    basis[np.arange(len(contact)), number] = 1.0
    since = np.argmin(in_contact) if not in_contact.all() else 0
    basis[:, -1] = ((contact - since) % count) / count - 0.5
    return Inverted(
        force, np.fft.irfft(orders, count), contact, loaded, np.linalg.qr(basis)[0].copy()
    )


def _loading(
    force: Array, in_contact: NDArray[np.bool_], least_rise: float
) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Return samples in contact, the contact that each belongs to, and the rises of the force since it began.

    A rise counts once it is `least_rise` above the last low, so that noise adds nothing up.
    """
    count = len(force)
    start = 0 if in_contact.all() else int(np.argmin(in_contact))
    samples, numbers, rises = [], [], []
    number, inside, rising = -1, False, True
    total = extreme = 0.0
    for i in (start + np.arange(count)) % count:
        if not in_contact[i]:
            inside = False
            continue
        now = float(force[i])
        if not inside:
            # Up to the first sample that counts as contact the force has risen from nothing.
            inside, rising, extreme, total = True, True, now, 0.0
            number += 1
        elif rising:
            if now > extreme:
                total += now - extreme
                extreme = now
            elif now < extreme - least_rise:
                rising, extreme = False, now
        elif now < extreme:
            extreme = now
        elif now > extreme + least_rise:
            rising = True
            total += now - extreme
            extreme = now
        samples.append(i)
        numbers.append(number)
        rises.append(total)
    return np.array(samples, dtype=np.int64), np.array(numbers, dtype=np.int64), np.array(rises)
