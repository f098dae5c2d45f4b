# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What every fault declares: where it acts, its parameters, and what a correct meter does under it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, IntEnum
from typing import ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.exciter import DriveFault
from roller_sim_ros.parameters import ParameterGroup
from roller_sim_ros.sensors import Reading, Slot

Array = NDArray[np.float64]


class FaultRefused(RollerSimError):
    """A fault cannot be: there is no such fault, nothing that it acts on, or another one that it excludes."""


class Stage(Enum):
    """Where a fault acts."""

    SIGNAL = "signal"
    """The accelerometer's analogue signal, before range and converter."""
    CLOCK = "clock"
    """The accelerometer's clock."""
    MESSAGE = "message"
    """The accelerometer's messages on their way."""
    TACHO = "tacho"
    POSITION = "position"
    COMMAND = "command"
    EXCITER = "exciter"
    """The exciter itself: the only stage that changes the true motion."""


class Behaviour(IntEnum):
    """What a correct meter does; the values of FaultState.expected."""

    UNAFFECTED = 0
    """Its value stays within a tolerance of the true one."""
    FLAGGED = 1
    """It says that the value is not to be trusted, by a status, NaN or silence."""
    NAN = 2
    """It gives NaN."""


@dataclass(frozen=True)
class Expectation:
    """What a correct meter does under a fault.

    Attributes
    ----------
    behaviour : Behaviour
        What it does.
    tolerance_percent : float
        UNAFFECTED: largest deviation of CMV from the true one.
    within_revolutions : int
        After how many revolutions of the fault it must.
    """

    behaviour: Behaviour
    tolerance_percent: float = 0.0
    within_revolutions: int = 0

    def text(self) -> str:
        """Return the expectation as a reader wants it."""
        if self.behaviour is Behaviour.UNAFFECTED:
            return f"unaffected within {self.tolerance_percent:g} %"
        what = "NaN" if self.behaviour is Behaviour.NAN else "flagged"
        return f"{what} within {self.within_revolutions} revolutions"


class Start(NamedTuple):
    """What a fault begins with.

    Attributes
    ----------
    revolution : int
        The first one.
    random : Generator
        Random numbers of its own.
    """

    revolution: int
    random: Generator


class Installed(NamedTuple):
    """What there is for faults to act on.

    Attributes
    ----------
    slots : frozenset of Slot
        What is measured.
    range_m_s2 : float
        Range of the accelerometer; 0: none.
    """

    slots: frozenset[Slot]
    range_m_s2: float = 0.0


@dataclass(frozen=True)
class Fault(ParameterGroup):
    """Base of all faults; the fields are the parameters, `group` is the id.

    Attributes
    ----------
    stage : Stage
        Where it acts.
    excludes : mapping
        Ids of faults that cannot be at the same time, and why.
    """

    stage: ClassVar[Stage]
    excludes: ClassVar[dict[str, str]] = {}

    def check(self, installed: Installed) -> None:
        """Check that there is something for the fault to act on.

        Raises
        ------
        FaultRefused
            If not.
        """

    def expectation(self) -> Expectation:
        """Return what a correct meter does under the fault."""
        raise NotImplementedError

    def require(self, installed: Installed, slot: Slot) -> None:
        """Refuse the fault where nothing measures what it acts on."""
        if slot not in installed.slots:
            raise FaultRefused(f"{self.group}: there is no sensor for the {slot.value}")


class SignalEffect(Protocol):
    """A fault of the signal while it is active."""

    def apply(
        self, vertical: Array, horizontal: Array, before: tuple[float, float]
    ) -> NDArray[np.uint8] | None:
        """Change signals in place, m/s²; return of each sample on how many axes it was clipped, if it was.

        Parameters
        ----------
        vertical, horizontal : ndarray, shape (n,)
            The next samples.
        before : tuple of float
            (vertical, horizontal) that went out last.
        """
        ...


@dataclass(frozen=True)
class SignalFault(Fault):
    """A fault of the accelerometer's signal.

    Attributes
    ----------
    rank : int
        Place in the chain from the element to the output: lower ones act first.
    """

    stage: ClassVar[Stage] = Stage.SIGNAL
    rank: ClassVar[int]

    def begin(self, start: Start) -> SignalEffect:
        """Return the fault as it acts from now on."""
        raise NotImplementedError


class Parcel(NamedTuple):
    """A reading on its way.

    Attributes
    ----------
    reading : Reading
        The reading.
    late_s : float
        By how much it is late.
    held_until : int
        Sample of the session that has to be reached first; 0: none.
    """

    reading: Reading
    late_s: float = 0.0
    held_until: int = 0


class MessageEffect(Protocol):
    """A fault of the messages while it is active."""

    def pass_on(self, parcel: Parcel) -> list[Parcel]:
        """Return what becomes of a parcel."""
        ...


@dataclass(frozen=True)
class MessageFault(Fault):
    """A fault of the accelerometer's messages."""

    stage: ClassVar[Stage] = Stage.MESSAGE

    def begin(self, start: Start) -> MessageEffect:
        """Return the fault as it acts from now on."""
        raise NotImplementedError


class ExciterEffect(Protocol):
    """A fault of the exciter while it is active."""

    def disturb(self, fault: DriveFault, amplitude_m: float, power_w: float) -> DriveFault:
        """Return what keeps the drive from obeying in the next revolution.

        Parameters
        ----------
        fault : DriveFault
            What does already.
        amplitude_m : float
            Amplitude now.
        power_w : float
            Mean power that the drum gave to the soil in the previous revolution.
        """
        ...


@dataclass(frozen=True)
class ExciterFault(Fault):
    """A fault of the exciter: the true motion changes, and a correct meter goes with it."""

    stage: ClassVar[Stage] = Stage.EXCITER

    def begin(self, start: Start) -> ExciterEffect:
        """Return the fault as it acts from now on."""
        raise NotImplementedError


class Chosen:
    """Decides for each revolution whether it is hit, in order and once.

    Parameters
    ----------
    start : Start
        First revolution and random numbers.
    probability : float
        Of each to be hit.
    """

    def __init__(self, start: Start, probability: float) -> None:
        self._next = start.revolution
        self._random = start.random
        self._probability = probability
        self._hit = False

    def hits(self, revolution: int) -> bool:
        """Return whether a revolution, not before the last one asked for, is hit."""
        while self._next <= revolution:
            self._hit = bool(self._random.random() < self._probability)
            self._next += 1
        return self._hit
