# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Commands: what is asked and by whom, and why it may be refused."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import lookup
from roller_sim_ros.site import MAX_SPEED_M_S


class Refusal(IntEnum):
    """Why a command was refused; the values of ExciterState.refusal_code."""

    NONE = 0
    NOT_FINITE = 1
    NEGATIVE = 2
    OUT_OF_RANGE = 3
    NOT_ACTIVE = 4
    TIMEOUT = 5
    DAMAGED = 6


class Master(IntEnum):
    """Whom the exciter or the travel obeys; the values of the messages' ``master`` fields."""

    NONE = 0
    """There is no scenario: what was configured or commanded last holds."""
    SCENARIO = 1
    COMMAND = 2
    """A live exciter command, until released."""
    CMD_VEL = 3
    """A live travel command, until released."""

    @property
    def label(self) -> str:
        """The master as a reader wants it."""
        return self.name.lower()


class CommandRefused(RollerSimError):
    """A command to the exciter or to the travel was refused as a whole.

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
    master : Master
        Whom it obeys.
    """

    vibrating: bool
    commanded_frequency_hz: float
    commanded_amplitude_m: float
    frequency_hz: float
    amplitude_m: float
    force_amplitude_n: float
    applied_sample: int
    master: Master = Master.NONE


@dataclass(frozen=True)
class Applied:
    """A command, a parameter change or a change of the master that took effect.

    Attributes
    ----------
    sample : int
        Index of the first sample it acts on, a multiple of 128.
    name : str
        Dotted name of the parameter; ``travel.speed_m_s`` of a travel command; ``exciter.master`` or
        ``travel.master``.
    value : bool, int, float or str
        New value, SI; of a master its label.
    master : Master
        On whose account.
    """

    sample: int
    name: str
    value: bool | int | float | str
    master: Master = Master.NONE


def checked_speed(speed_m_s: float) -> float:
    """Return a commanded travel speed as it is.

    Raises
    ------
    CommandRefused
        If it is not finite or beyond what a roller does.
    """
    if not math.isfinite(speed_m_s):
        raise CommandRefused(Refusal.NOT_FINITE, f"speed {speed_m_s} m/s: must be finite")
    if abs(speed_m_s) > MAX_SPEED_M_S:
        raise CommandRefused(
            Refusal.OUT_OF_RANGE,
            f"speed {speed_m_s:g} m/s: must be at most {MAX_SPEED_M_S:g} m/s forth or back",
        )
    return float(speed_m_s)
