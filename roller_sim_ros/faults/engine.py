# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All faults of a run: which are active in which revolution, and what they do there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.exciter import DriveFault, ExciterDrive
from roller_sim_ros.faults.catalogue import conflict, make_fault
from roller_sim_ros.faults.clock_skew import ClockSkew
from roller_sim_ros.faults.fault import (
    ExciterFault,
    Fault,
    FaultRefused,
    Installed,
    MessageEffect,
    MessageFault,
    SignalFault,
    Start,
)
from roller_sim_ros.faults.frozen_command_link import FrozenCommandLink
from roller_sim_ros.faults.load import Load
from roller_sim_ros.faults.lost_pulse import LostPulse
from roller_sim_ros.faults.schedule import Scheduled, Span, When, surely_overlap
from roller_sim_ros.faults.stale_position import StalePosition
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, ParameterError, Value
from roller_sim_ros.sensors import Slot
from roller_sim_ros.session import Block, Moment
from roller_sim_ros.site.streams import stream

Array = NDArray[np.float64]
REMEMBERED = 4
"""Revolutions of which is known what was active: what a sensor delivers late is of an earlier one."""


@dataclass(frozen=True)
class ActiveFault:
    """A fault that is active.

    Attributes
    ----------
    handle : int
        By which it is cleared.
    fault : Fault
        With its parameters.
    since_sample : int
        First sample of the session.
    since_revolution : int
        First revolution.
    live : bool
        Whether it was injected, not scheduled.
    effect : object
        What it does; None where there is nothing to remember.
    """

    handle: int
    fault: Fault
    since_sample: int
    since_revolution: int
    live: bool
    effect: Any


@dataclass
class _Entry:
    """A fault that may become active.

    Attributes
    ----------
    handle, fault, random
        As in `ActiveFault` and `Start`.
    when : When or None
        When it is active; None: from the next revolution on, as `span` says.
    span : Span or None
        Of an injected one.
    active : ActiveFault or None
        As it acts now.
    """

    handle: int
    fault: Fault
    random: Generator
    when: When | None
    span: Span | None
    active: ActiveFault | None = None

    @property
    def live(self) -> bool:
        """Whether it was injected."""
        return self.span is not None


class FaultEngine:
    """Begins and ends faults where revolutions begin, and applies those of the revolution in question.

    Parameters
    ----------
    installed : Installed
        What there is for faults to act on.
    scheduled : sequence of Scheduled
        Faults of a scenario; their handles are 1, 2, …
    seed : int
        Of the run; every fault has random numbers of its own.

    Attributes
    ----------
    active : tuple of ActiveFault
        Those of the revolution that began last.
    held_back : tuple of str
        Scheduled faults that should be active and are not, because an active one excludes them, with the reason.

    Raises
    ------
    ParameterError
        If a scheduled fault cannot be; `name` is ``faults[0].id`` or ``faults[0].parameters.…``.
    """

    def __init__(
        self, installed: Installed, scheduled: Sequence[Scheduled] = (), seed: int = 0
    ) -> None:
        self._installed = installed
        self._seed = seed
        self._entries: list[_Entry] = []
        self._made: dict[str, int] = {}
        self._history: dict[int, tuple[ActiveFault, ...]] = {}
        self._load = Load()
        self._before = (0.0, 0.0)
        self.active: tuple[ActiveFault, ...] = ()
        self.held_back: tuple[str, ...] = ()
        for index, item in enumerate(scheduled):
            self._schedule(f"faults[{index}]", item)

    def inject(
        self,
        fault_id: str,
        parameters: Mapping[str, Value] | None = None,
        span: Span | None = None,
    ) -> int:
        """Let a fault be active from the next revolution on, and return its handle.

        Parameters
        ----------
        fault_id : str
            Of the catalogue.
        parameters : mapping
            What differs from the defaults.
        span : Span
            How long; until cleared when not given.

        Raises
        ------
        FaultRefused
            If there is no such fault, nothing that it acts on, or another one that excludes it.
        ParameterError
            If a parameter is unknown or its value refused.
        """
        fault = make_fault(fault_id, parameters)
        for entry in self._entries:
            if entry.active is not None or entry.live:
                reason = conflict(entry.fault, fault)
                if reason:
                    raise FaultRefused(f"{fault_id}: {reason}; clear handle {entry.handle} first")
        return self._enter(fault_id, parameters or {}, None, span or Span())

    def clear(self, handle: int) -> None:
        """End a fault with the revolution that runs; a scheduled one for good.

        Raises
        ------
        FaultRefused
            If there is none of this handle.
        """
        for entry in self._entries:
            if entry.handle == handle:
                self._entries.remove(entry)
                return
        known = ", ".join(str(entry.handle) for entry in self._entries) or "none"
        raise FaultRefused(f"there is no fault with the handle {handle}; there are {known}")

    def clear_all(self) -> None:
        """End all that were injected."""
        self._entries = [entry for entry in self._entries if not entry.live]

    def begin_revolution(self, moment: Moment, drive: ExciterDrive) -> None:
        """Begin and end faults, and set what keeps the drive from obeying."""
        self._switch(moment)
        self._history[moment.revolution] = self.active
        self._history.pop(moment.revolution - REMEMBERED, None)
        effects = [item.effect for item in self.active if isinstance(item.fault, ExciterFault)]
        drive.fault = None
        if effects:
            disturbed = DriveFault()
            for effect in effects:
                disturbed = effect.disturb(disturbed, drive.amplitude_m, self._load.mean_power_w())
            drive.fault = disturbed
        self._load.begin()

    def observe(self, block: Block) -> None:
        """Take notice of the load in a block."""
        self._load.observe(block)

    def signal(
        self, revolution: int, vertical: Array, horizontal: Array
    ) -> NDArray[np.uint8] | None:
        """Apply the faults of the accelerometer's signal in place."""
        clipped = None
        for item in self._of(revolution, SignalFault):
            more = item.effect.apply(vertical, horizontal, self._before)
            if more is not None:
                clipped = more
        if len(vertical):
            self._before = (float(vertical[-1]), float(horizontal[-1]))
        return clipped

    def clock_skew_ppm(self, revolution: int) -> float:
        """Return by how much the accelerometer's clock runs fast because of faults."""
        return sum(
            item.fault.skew_ppm
            for item in self._of(revolution, ClockSkew)
            if isinstance(item.fault, ClockSkew)
        )

    def message_effects(self, revolution: int) -> list[MessageEffect]:
        """Return the faults of messages in a revolution."""
        return [item.effect for item in self._of(revolution, MessageFault)]

    def loses_pulse(self, revolution: int) -> bool:
        """Return whether a pulse of the tacho is lost; asked once for each revolution that has one."""
        return any(item.effect.hits(revolution) for item in self._of(revolution, LostPulse))

    def stale(self, revolution: int, slot: Slot) -> StalePosition | None:
        """Return the fault by which position or speed is stale in a revolution."""
        for item in self._of(revolution, StalePosition):
            if isinstance(item.fault, StalePosition) and item.fault.slot is slot:
                return item.fault
        return None

    @property
    def link_frozen(self) -> bool:
        """Whether commands are lost."""
        return any(isinstance(item.fault, FrozenCommandLink) for item in self.active)

    def _of(self, revolution: int, kind: type[Fault]) -> list[ActiveFault]:
        return [item for item in self._history.get(revolution, ()) if isinstance(item.fault, kind)]

    def _schedule(self, at: str, item: Scheduled) -> None:
        try:
            self._enter(item.id, item.parameters, item.when, None)
            _check_together(self._entries)
        except FaultRefused as error:
            raise ParameterError(f"{at}.id", item.id, str(error)) from None
        except ParameterError as error:
            name = f"{at}.parameters.{error.name}"
            raise ParameterError(name, error.value, error.reason) from None

    def _enter(
        self, fault_id: str, parameters: Mapping[str, Value], when: When | None, span: Span | None
    ) -> int:
        fault = make_fault(fault_id, parameters)
        fault.check(self._installed)
        number = self._made.get(fault_id, 0)
        self._made[fault_id] = number + 1
        random = stream(self._seed, f"faults/{fault_id}/{number}")
        handle = sum(self._made.values())
        self._entries.append(_Entry(handle, fault, random, when, span))
        return handle

    def _switch(self, moment: Moment) -> None:
        active: list[_Entry] = []
        held_back: list[str] = []
        ended: list[_Entry] = []
        # What is active stays so, whatever comes up now.
        for entry in sorted(self._entries, key=_newness):
            if not _wanted(entry, moment):
                entry.active = None
                if entry.live:
                    ended.append(entry)
                continue
            reasons = [conflict(other.fault, entry.fault) for other in active]
            reason = next((item for item in reasons if item), None)
            if reason is not None:
                entry.active = None
                held_back.append(f"{entry.fault.group} (handle {entry.handle}): {reason}")
                continue
            if entry.active is None:
                entry.active = _begun(entry, moment)
            active.append(entry)
        for entry in ended:
            self._entries.remove(entry)
        running = [entry.active for entry in active if entry.active is not None]
        self.active = tuple(sorted(running, key=_rank))
        self.held_back = tuple(held_back)


def _wanted(entry: _Entry, moment: Moment) -> bool:
    if entry.when is None:
        entry.when = (entry.span or Span()).since(moment)
    return entry.when.holds(moment)


def _begun(entry: _Entry, moment: Moment) -> ActiveFault:
    begin = getattr(entry.fault, "begin", None)
    return ActiveFault(
        handle=entry.handle,
        fault=entry.fault,
        since_sample=moment.revolution * SAMPLES_PER_REVOLUTION,
        since_revolution=moment.revolution,
        live=entry.live,
        effect=begin(Start(moment.revolution, entry.random)) if begin else None,
    )


def _check_together(entries: Sequence[_Entry]) -> None:
    """Refuse the last of some faults where it is sure to overlap with one that excludes it."""
    *others, last = entries
    for other in others:
        reason = conflict(other.fault, last.fault)
        if reason and surely_overlap(other.when, last.when):
            raise FaultRefused(f"overlaps with fault {other.handle}: {reason}")


def _newness(entry: _Entry) -> tuple[bool, int]:
    return entry.active is None, entry.handle


def _rank(item: ActiveFault) -> tuple[int, int]:
    fault = item.fault
    return fault.rank if isinstance(fault, SignalFault) else 0, item.handle
