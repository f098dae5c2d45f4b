# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The way of the accelerometer's messages: latency, and what faults make of it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from roller_sim_ros.faults.fault import MessageEffect, Parcel
from roller_sim_ros.sensors import Reading


class _Waiting(NamedTuple):
    reading: Reading
    due_s: float
    due_sample: int
    held: bool


class Delivery:
    """Hands readings on when they are due, in their order but where a fault holds some back.

    Parameters
    ----------
    latency_s : float
        Time from a sample to its delivery.
    """

    def __init__(self, latency_s: float = 0.0) -> None:
        self._latency_s = latency_s
        self._last_due_s = 0.0
        self._waiting: list[_Waiting] = []

    def put(
        self,
        reading: Reading,
        effects: Sequence[MessageEffect],
        now_s: float,
        now_sample: int,
    ) -> None:
        """Take a reading that was made by now.

        Parameters
        ----------
        reading : Reading
            The reading.
        effects : sequence of MessageEffect
            Faults of the messages of its revolution.
        now_s, now_sample : float, int
            Time and sample that the session has reached.
        """
        parcels = [Parcel(reading)]
        for effect in effects:
            parcels = [out for parcel in parcels for out in effect.pass_on(parcel)]
        for parcel in parcels:
            late_s = self._latency_s + parcel.late_s
            # A link keeps its order: what follows something late is not there before it.
            due_s = self._last_due_s = max(self._last_due_s, now_s + late_s if late_s else 0.0)
            held = parcel.held_until > now_sample
            due_sample = parcel.held_until if held else now_sample
            self._waiting.append(_Waiting(parcel.reading, due_s, due_sample, held))

    def due(self, now_s: float, now_sample: int) -> list[Reading]:
        """Return what is due by now, and forget it."""
        if not self._waiting:
            return []
        self._waiting.sort(key=_place)
        ready = [item for item in self._waiting if _is_due(item, now_s, now_sample)]
        self._waiting = [item for item in self._waiting if not _is_due(item, now_s, now_sample)]
        return [item.reading for item in ready]


def _place(item: _Waiting) -> tuple[int, bool]:
    """What was held back comes after what was made in the meantime."""
    return item.due_sample, item.held


def _is_due(item: _Waiting, now_s: float, now_sample: int) -> bool:
    return item.due_s <= now_s and item.due_sample <= now_sample
