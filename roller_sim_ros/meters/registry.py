# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All meter values; a new one is one file and one line here."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters.ccv import Ccv
from roller_sim_ros.meters.cmv import Cmv
from roller_sim_ros.meters.drum import DrumMotion
from roller_sim_ros.meters.e_vib import EVib
from roller_sim_ros.meters.harmonics import Harmonics
from roller_sim_ros.meters.k_s import KS
from roller_sim_ros.meters.omega import Omega
from roller_sim_ros.meters.rmv import Rmv


class MeterDefinition(Protocol):
    """What every meter value says of itself."""

    @property
    def name(self) -> str:
        """Short name, as in topics and columns."""
        ...

    @property
    def label(self) -> str:
        """Name as it is written."""
        ...

    @property
    def unit(self) -> str:
        """Unit, empty for a pure number."""
        ...

    @property
    def source(self) -> str:
        """Where its definition is from."""
        ...

    @property
    def verified(self) -> bool:
        """Whether all of the definition was read in that source."""
        ...


class HarmonicMeter(MeterDefinition, Protocol):
    """A value that follows from the harmonics of the vertical acceleration."""

    @property
    def orders(self) -> tuple[float, ...]:
        """Orders it needs."""
        ...

    def value(self, harmonics: Harmonics) -> float:
        """Return the meter value, NaN where an amplitude is unknown."""
        ...


class DrumMeter(MeterDefinition, Protocol):
    """A value that needs the eccentric's phase and the machine too."""

    def value(self, motion: DrumMotion) -> NDArray[np.float64]:
        """Return the meter value of each motion, NaN where there is none."""
        ...


METERS: tuple[HarmonicMeter, ...] = (
    Cmv(),
    Rmv(),
    Ccv(),
)

DRUM_METERS: tuple[DrumMeter, ...] = (
    Omega(),
    EVib(),
    KS(),
)

ORDERS: tuple[float, ...] = tuple(sorted({order for meter in METERS for order in meter.orders}))
"""Every order that a meter needs."""

IN_MESSAGE = ("cmv", "rmv")
"""Values that the meter's own message has fields for."""

TRUE_METERS = tuple(meter for meter in METERS if meter.name in IN_MESSAGE)
"""Those that the truth tells, too."""

FURTHER: tuple[MeterDefinition, ...] = tuple(
    meter for meter in (*METERS, *DRUM_METERS) if meter.name not in IN_MESSAGE
)
"""All others: each on a topic of its own."""


def column(meter: MeterDefinition) -> str:
    """Return the name of a value in tables, with its unit, as in ``k_s_n_m``."""
    unit = meter.unit.lower().replace("/", "_")
    return f"{meter.name}_{unit}" if unit else meter.name


def evaluate(harmonics: Harmonics, meters: Iterable[HarmonicMeter] = METERS) -> dict[str, float]:
    """Return {name: value} of meters that the acceleration suffices for, all of them when not told."""
    return {meter.name: meter.value(harmonics) for meter in meters}


def evaluate_drum(motion: DrumMotion) -> dict[str, NDArray[np.float64]]:
    """Return {name: values} of all meters that need phase and machine, each of the motions' shape (...)."""
    return {meter.name: meter.value(motion) for meter in DRUM_METERS}
