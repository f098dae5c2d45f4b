"""Exciter commands: what is asked, and why it may be refused."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import lookup


class Refusal(IntEnum):
    """Why a command was refused; the values of ExciterState.refusal_code."""

    NONE = 0
    NOT_FINITE = 1
    NEGATIVE = 2
    OUT_OF_RANGE = 3
    NOT_ACTIVE = 4
    TIMEOUT = 5


class CommandRefused(RollerSimError):
    """An exciter command was refused as a whole.

    Attributes
    ----------
    code : Refusal
        The reason as a code; the message names field, value and bound.
    """

    def __init__(self, code: Refusal, reason: str) -> None:
        super().__init__(reason)
        self.code = code


@dataclass(frozen=True)
class ExciterCommand:
    """A valid command.

    Attributes
    ----------
    vibrate : bool
        False lets the exciter run down; frequency and amplitude are kept for later.
    frequency_hz, amplitude_m : float
        Commanded frequency and nominal amplitude.

    Raises
    ------
    CommandRefused
        On construction, if a value is not finite, negative or beyond the parameter's bound.
    """

    vibrate: bool
    frequency_hz: float
    amplitude_m: float

    def __post_init__(self) -> None:
        for field, name in (("frequency", "frequency_hz"), ("amplitude", "amplitude_m")):
            value = float(getattr(self, name))
            object.__setattr__(self, name, value)
            quantity, _ = lookup(f"exciter.{name}")
            if not math.isfinite(value):
                raise CommandRefused(
                    Refusal.NOT_FINITE, f"{field} {value} {quantity.unit}: must be finite"
                )
            if value < 0.0:
                raise CommandRefused(
                    Refusal.NEGATIVE, f"{field} {value:g} {quantity.unit}: must not be negative"
                )
            if quantity.maximum is not None and value > quantity.maximum:
                raise CommandRefused(
                    Refusal.OUT_OF_RANGE,
                    f"{field} {value:g} {quantity.unit}: must be at most "
                    f"{quantity.maximum:g} {quantity.unit}",
                )


@dataclass(frozen=True)
class ExciterStatus:
    """What the exciter does and what it was told.

    Attributes
    ----------
    vibrating : bool
        Whether it is told to vibrate.
    commanded_frequency_hz, commanded_amplitude_m : float
        Of the last accepted command.
    frequency_hz, amplitude_m : float
        Now.
    force_amplitude_n : float
        F_e = m_d A ω² now, N.
    applied_sample : int
        Sample at which the last accepted command took effect.
    """

    vibrating: bool
    commanded_frequency_hz: float
    commanded_amplitude_m: float
    frequency_hz: float
    amplitude_m: float
    force_amplitude_n: float
    applied_sample: int


@dataclass(frozen=True)
class Applied:
    """A command or a parameter change that took effect.

    Attributes
    ----------
    sample : int
        Index of the first sample it acts on, a multiple of 128.
    name : str
        Dotted name of the parameter.
    value : bool, int, float or str
        New value, SI.
    """

    sample: int
    name: str
    value: bool | int | float | str
