"""All meter values; a new one is one file and one line here."""

from __future__ import annotations

from typing import Protocol

from roller_sim_ros.meters.cmv import Cmv
from roller_sim_ros.meters.harmonics import Harmonics
from roller_sim_ros.meters.rmv import Rmv


class HarmonicMeter(Protocol):
    """A value that follows from the harmonics of the vertical acceleration."""

    @property
    def name(self) -> str:
        """Short name, as in messages and tables."""
        ...

    @property
    def unit(self) -> str:
        """Unit, empty for a pure number."""
        ...

    @property
    def orders(self) -> tuple[float, ...]:
        """Orders it needs."""
        ...

    @property
    def source(self) -> str:
        """Where its definition is from."""
        ...

    @property
    def verified(self) -> bool:
        """Whether all of the definition was read in that source."""
        ...

    def value(self, harmonics: Harmonics) -> float:
        """Return the meter value, NaN where an amplitude is unknown."""
        ...


METERS: tuple[HarmonicMeter, ...] = (
    Cmv(),
    Rmv(),
)

ORDERS: tuple[float, ...] = tuple(sorted({order for meter in METERS for order in meter.orders}))
"""Every order that a meter needs."""


def evaluate(harmonics: Harmonics) -> dict[str, float]:
    """Return {name: value} of all meters."""
    return {meter.name: meter.value(harmonics) for meter in METERS}
