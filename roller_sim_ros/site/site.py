"""The ground under the drum, wherever the roller is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from roller_sim_ros.parameters import Soil


@dataclass(frozen=True)
class Position:
    """Where the roller is on its lane.

    Attributes
    ----------
    chainage_m : float
        Position of the drum's axle along the lane.
    pass_number : int
        Passes begun, from 1.
    speed_m_s : float
        Travel speed, positive towards growing chainage; 0 while standing.
    """

    chainage_m: float = 0.0
    pass_number: int = 1
    speed_m_s: float = 0.0


class Site(Protocol):
    """What a session asks of its site, once every 128 samples."""

    @property
    def position(self) -> Position:
        """Where the roller is now."""
        ...

    def move(self, duration_s: float) -> None:
        """Travel on for the time of one revolution, and leave behind what a pass does to the ground."""
        ...

    def soil(self, configured: Soil) -> Soil:
        """Return the ground under the drum, from the configured one where the site says nothing else."""
        ...


class UniformSite:
    """Ground that is the configured one everywhere; the roller vibrates on the spot."""

    @property
    def position(self) -> Position:
        """Return the start of the lane."""
        return Position()

    def move(self, duration_s: float) -> None:
        """Stay."""

    def soil(self, configured: Soil) -> Soil:
        """Return the configured ground."""
        return configured
