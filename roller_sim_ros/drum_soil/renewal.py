# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The fresh-soil rule (paper, 'Soil model': 'the drum will hit fresh soil every cycle')."""

from __future__ import annotations

from roller_sim_ros.drum_soil.state import AIR
from roller_sim_ros.jit import inlined


@inlined
def renewed(
    d: float, e: float, datum: float, force: float, phase: int, plastic: float
) -> tuple[float, float]:
    """Return plastic depth and datum after the drum's vertical velocity turned from up to down.

    The plastic depth becomes what fresh soil has under the present force, q := p F_s/F_stat (zero in the air), and the
    datum follows a drum that has not climbed out of its rut, D := max(D, d − e − q). D is never set back, and in
    contact d = e + q + D stays true, so the force does not jump.

    Parameters
    ----------
    d, e, datum
        Depth of the drum, elastic depth, datum, m, positive down.
    force
        Soil force, N.
    phase
        Contact state.
    plastic
        p/F_stat, m/N.
    """
    fresh = plastic * force
    datum = max(datum, d - e - fresh)
    if phase == AIR:
        return fresh, datum
    return d - e - datum, datum
