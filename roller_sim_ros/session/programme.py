"""What a scenario has the exciter do."""

from __future__ import annotations

from typing import Protocol

from roller_sim_ros.session.command import ExciterCommand
from roller_sim_ros.site import Position


class Programme(Protocol):
    """The exciter's part of a scenario, asked once every 128 samples while the scenario is master."""

    def command(self, time_s: float, position: Position) -> ExciterCommand:
        """Return what the exciter is to do; a function of its arguments alone.

        Parameters
        ----------
        time_s : float
            Since the start of the session.
        position : Position
            Where the roller is.
        """
        ...
