# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a scenario has the exciter do, and the moment of which it is asked."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from roller_sim_ros.session.command import ExciterCommand
from roller_sim_ros.site import Position


class Moment(NamedTuple):
    """When and where a revolution begins.

    Attributes
    ----------
    time_s : float
        Since the start of the session.
    revolution : int
        Revolutions, or stretches of 128 samples below the sampling floor, since then.
    position : Position
        Where the roller is.
    """

    time_s: float
    revolution: int
    position: Position


class Programme(Protocol):
    """The exciter's part of a scenario, asked once every 128 samples while the scenario is master."""

    def command(self, moment: Moment) -> ExciterCommand:
        """Return what the exciter is to do; a function of the moment alone."""
        ...
