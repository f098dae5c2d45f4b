# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Operating modes of a vibrating drum (Adam's and the paper's terms) and how they are told apart.

=================== ================================================================================
CONTINUOUS_CONTACT  the drum never leaves the ground
PARTIAL_UPLIFT      it does, and the motion repeats every revolution
DOUBLE_JUMP         the motion repeats every second revolution
QUAD_JUMP           the motion repeats every fourth revolution
CHAOTIC             it repeats every eighth revolution or not at all
UNKNOWN             none of these can be said: window filling, frequency changing, no vibration, …
=================== ================================================================================

The field has no name for a period of 8, the next doubling on the way to chaos; it is counted as chaotic,
and the period beside the mode tells the two apart.

A motion that has not settled does not repeat and is labelled CHAOTIC unless the drum keeps contact.
Rocking needs a second degree of freedom, which neither the model nor a single accelerometer has.
"""

from __future__ import annotations

from enum import IntEnum

from roller_sim_ros.meters.period import NO_PERIOD


class Mode(IntEnum):
    """Operating mode, with the values of the messages' ``mode`` fields."""

    UNKNOWN = 0
    CONTINUOUS_CONTACT = 1
    PARTIAL_UPLIFT = 2
    DOUBLE_JUMP = 3
    QUAD_JUMP = 4
    CHAOTIC = 5

    @property
    def label(self) -> str:
        """The mode as a reader wants it, as in ``double jump``."""
        return self.name.lower().replace("_", " ")


_BY_PERIOD = {2: Mode.DOUBLE_JUMP, 4: Mode.QUAD_JUMP, 8: Mode.CHAOTIC, NO_PERIOD: Mode.CHAOTIC}


def true_mode(air_fraction: float, period: int | None) -> Mode:
    """Return the mode from the contact states.

    Parameters
    ----------
    air_fraction : float
        Share of the samples without contact; NaN when unknown.
    period : int or None
        Period in revolutions, 0 for none, None for unknown.
    """
    if air_fraction == 0.0:
        return Mode.CONTINUOUS_CONTACT
    if period is None or not air_fraction > 0.0:
        return Mode.UNKNOWN
    return _BY_PERIOD.get(period, Mode.PARTIAL_UPLIFT)


def metered_mode(lifts: bool | None, period: int | None) -> Mode:
    """Return the mode from what a meter knows, the acceleration alone.

    Parameters
    ----------
    lifts : bool or None
        Whether the motion shows a flight (`roller_sim_ros.meters.flight`), None when that cannot be told:
        then a period of 1 gives UNKNOWN, and a longer one is taken to come from flights.
    period : int or None
        Period in revolutions, 0 for none, None for unknown.
    """
    if period is None:
        return Mode.UNKNOWN
    if lifts is False:
        return Mode.CONTINUOUS_CONTACT
    if period == 1:
        return Mode.UNKNOWN if lifts is None else Mode.PARTIAL_UPLIFT
    return _BY_PERIOD[period]
