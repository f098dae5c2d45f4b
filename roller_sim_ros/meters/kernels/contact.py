# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Force and flights of the last revolutions, kept in rings."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.jit import njit

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@njit
def note_contact(
    force: Array, state: Array, in_the_air: int, slot: int, air: Flags, forces: Array
) -> tuple[int, float]:
    """Put the newest revolution into the rings; return the ring's samples without contact and its greatest force.

    Parameters
    ----------
    force, state : ndarray, shape (samples,)
        F_s, N, and contact states.
    in_the_air : int
        The state that is none.
    slot : int
        Its place in the rings.
    air : ndarray of bool, shape (window, samples)
        Receives whether there is no contact.
    forces : ndarray, shape (window,)
        Receives the greatest force; NaN if there is one in it.
    """
    window, samples = air.shape
    greatest = force[0]
    for i in range(samples):
        value = force[i]
        if value > greatest or value != value:
            greatest = value
        air[slot, i] = state[i] == in_the_air
    forces[slot] = greatest
    without, most = 0, forces[0]
    for n in range(window):
        if forces[n] > most or forces[n] != forces[n]:
            most = forces[n]
        for i in range(samples):
            without += air[n, i]
    return without, most


@njit
def contacts_begun(air: Flags, newest: int, revolutions: int) -> int:
    """Return the number of contacts that begin within the last revolutions, fewer than the ring has.

    Parameters
    ----------
    air : ndarray of bool, shape (window, samples)
        As `note_contact` fills it.
    newest : int
        Place of the newest revolution.
    revolutions : int
        How many; at least one.
    """
    window, samples = air.shape
    begun = 0
    was = air[(newest - revolutions) % window, samples - 1]
    for n in range(revolutions):
        row = (newest - revolutions + 1 + n) % window
        for i in range(samples):
            now = air[row, i]
            if was and not now:
                begun += 1
            was = now
    return begun
