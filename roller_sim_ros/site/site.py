# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground under the drum, wherever the roller is."""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple, Protocol

from roller_sim_ros.parameters import Soil

MAX_SPEED_M_S = 5.0
"""Travel speed beyond which a command is refused; rollers reach 3 to 4 m/s on the road."""


class Position(NamedTuple):
    """Where the roller is on its lane.

    Attributes
    ----------
    chainage_m : float
        Position of the drum's axle along the lane.
    pass_number : int
        Passes begun, from 1; every reversal begins one.
    speed_m_s : float
        Travel speed, positive towards growing chainage; 0 while standing.
    finished : bool
        Whether what was planned has been driven.
    """

    chainage_m: float = 0.0
    pass_number: int = 1
    speed_m_s: float = 0.0
    finished: bool = False


class Site(Protocol):
    """What a session asks of its site, once every 128 samples."""

    @property
    def position(self) -> Position:
        """Where the roller is now."""
        ...

    @property
    def decides(self) -> Collection[str]:
        """Dotted names of the parameters that the site decides, whatever is configured."""
        ...

    def move(self, duration_s: float, force_ratio: float) -> None:
        """Travel on for the time of one revolution, and leave behind what a pass does to the ground.

        Parameters
        ----------
        duration_s : float
            Time of the revolution.
        force_ratio : float
            Amplitude of the exciter's force over the static load, at its end.
        """
        ...

    def drive(self, speed_m_s: float | None) -> None:
        """Travel at a speed until told otherwise; None: as planned, from where the roller is."""
        ...

    def soil(self, configured: Soil) -> Soil:
        """Return the ground under the drum, from the configured one where the site says nothing else."""
        ...


class UniformSite:
    """Ground that is the configured one everywhere; the roller vibrates on the spot until it is driven."""

    def __init__(self) -> None:
        self._chainage_m = 0.0
        self._pass_number = 1
        self._speed_m_s = 0.0
        self._forward = True

    @property
    def position(self) -> Position:
        """Return where the roller was driven."""
        return Position(self._chainage_m, self._pass_number, self._speed_m_s)

    @property
    def decides(self) -> Collection[str]:
        """Return no parameter: all ground is as configured."""
        return ()

    def move(self, duration_s: float, force_ratio: float) -> None:
        """Travel on; the ground stays as it is."""
        del force_ratio
        self._chainage_m += self._speed_m_s * duration_s

    def drive(self, speed_m_s: float | None) -> None:
        """Travel at a speed; as planned, the roller stands."""
        self._speed_m_s = speed_m_s or 0.0
        if self._speed_m_s and (self._speed_m_s > 0.0) != self._forward:
            self._forward = not self._forward
            self._pass_number += 1

    def soil(self, configured: Soil) -> Soil:
        """Return the configured ground."""
        return configured
