# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whom exciter and travel obey: the scenario, or a live command until it is released."""

from __future__ import annotations

from collections.abc import Iterator

from roller_sim_ros.session.command import Master
from roller_sim_ros.site import Site

Told = tuple[str, float | str, Master]
"""Name, value and master of an `Applied`."""


class Masters:
    """One master each of exciter and travel; changes wait until they are let take effect.

    Parameters
    ----------
    scenario : bool
        Whether there is a scenario, master of what nobody commands. Without one there are no masters: all stay NONE.

    Attributes
    ----------
    exciter, travel : Master
        Whom they obey.
    """

    def __init__(self, *, scenario: bool) -> None:
        self._first = Master.SCENARIO if scenario else Master.NONE
        self.exciter = self.travel = self._first
        self._next_exciter: Master | None = None
        self._next_travel: tuple[Master, float | None] | None = None
        self._driven_m_s: float | None = None

    def command_exciter(self) -> None:
        """Let the exciter obey live commands."""
        self._next_exciter = self._live(Master.COMMAND)

    def command_travel(self, speed_m_s: float) -> None:
        """Let the roller travel at a speed, m/s."""
        self._next_travel = (self._live(Master.CMD_VEL), speed_m_s)

    def release(self) -> None:
        """Hand both back to the scenario; without one the roller stops."""
        self._next_exciter = self._first
        self._next_travel = (self._first, None)

    def take_effect(self, site: Site) -> Iterator[Told]:
        """Let what was asked for take effect, and yield what changed by it."""
        if self._next_exciter is not None and self._next_exciter is not self.exciter:
            self.exciter = self._next_exciter
            yield "exciter.master", self.exciter.label, self.exciter
        self._next_exciter = None
        if self._next_travel is None:
            return
        (master, speed_m_s), self._next_travel = self._next_travel, None
        if master is not self.travel:
            self.travel = master
            yield "travel.master", master.label, master
        if speed_m_s != self._driven_m_s:
            site.drive(speed_m_s)
            self._driven_m_s = speed_m_s
            if speed_m_s is not None:
                yield "travel.speed_m_s", speed_m_s, master
            elif master is Master.NONE:
                yield "travel.speed_m_s", 0.0, master

    def _live(self, master: Master) -> Master:
        return master if self._first is Master.SCENARIO else Master.NONE
