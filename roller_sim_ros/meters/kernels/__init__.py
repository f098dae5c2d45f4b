# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Loops over samples that numpy would need dozens of calls for; compiled."""

from functools import cache

import numpy as np

from roller_sim_ros.meters.kernels.branch import mean_modulus
from roller_sim_ros.meters.kernels.contact import contacts_begun, note_contact
from roller_sim_ros.meters.kernels.fall import CANNOT_TELL, LIFTS, lifting
from roller_sim_ros.meters.kernels.fundamental import fundamentals, soil_forces
from roller_sim_ros.meters.kernels.line_contact import modulus
from roller_sim_ros.meters.kernels.orders import keep, window_sums
from roller_sim_ros.meters.kernels.repetition import first_period, note_changes

__all__ = [
    "CANNOT_TELL",
    "LIFTS",
    "contacts_begun",
    "first_period",
    "fundamentals",
    "keep",
    "lifting",
    "mean_modulus",
    "modulus",
    "note_changes",
    "note_contact",
    "soil_forces",
    "warm_up",
    "window_sums",
]


@cache
def warm_up() -> None:
    """Compile the loops, so that the first full window of a run is not late."""
    one, few, index = np.zeros(1), np.zeros((1, 4)), np.zeros(1, dtype=np.int64)
    waves, air = np.zeros((4, 2)), np.zeros((2, 4), dtype=np.bool_)
    keep(waves, np.zeros(4), np.zeros(2), np.zeros((2, 1, 1)), 0, np.zeros((2, 1, 4)), 0)
    window_sums(np.zeros((2, 1, 4)), 0, 1.0, np.zeros(1, dtype=np.complex128))
    note_changes(few, few, np.zeros((3, 1)), 0, index, np.zeros(4))
    first_period(few, np.zeros((3, 1)), 0, index, 4, 0.01)
    note_contact(np.zeros(4), np.zeros(4), 2, 0, air, np.zeros(2))
    contacts_begun(air, 0, 1)
    lifting(np.ones((2, 8)), (1, 0.7, 3, 0.1), (1, 0.7, 3, 0.1), -9.0, 0.1, np.zeros((2, 8)))
    modulus(1e-9, 12.0, 0.75, 2.1, 0.25)
    fundamentals(few, np.zeros(4), np.zeros(4), np.zeros(1, dtype=np.complex128))
    soil_forces(few, one, one, one, np.zeros(4), few)
    mean_modulus(few, few, one, one, one, 0.25, 2, 0.4, 0.9, one)
