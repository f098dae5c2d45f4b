# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages that never come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from numpy.random import Generator

from roller_sim_ros.faults.fault import Behaviour, Expectation, MessageFault, Parcel, Start
from roller_sim_ros.parameters.quantity import parameter


@dataclass(frozen=True)
class Dropout(MessageFault):
    """Stretches of samples are lost, whatever messages they are in."""

    group: ClassVar[str] = "dropout"

    probability: float = parameter(0.2, "", "of each stretch to be lost", minimum=0.0, maximum=1.0)
    stretch_samples: int = parameter(
        16, "", "length of a stretch, in samples", minimum=1, maximum=100000
    )

    def begin(self, start: Start) -> _Losses:
        """Return the fault as it acts from now on."""
        return _Losses(self, start.random)

    def expectation(self) -> Expectation:
        """The samples' index jumps."""
        return Expectation(Behaviour.FLAGGED, within_revolutions=10)


class _Losses:
    def __init__(self, fault: Dropout, random: Generator) -> None:
        self._fault = fault
        self._random = random
        self._stretch = -1
        self._lost = False

    def pass_on(self, parcel: Parcel) -> list[Parcel]:
        """Cut what is lost out of a reading."""
        reading, length = parcel.reading, self._fault.stretch_samples
        first, end = reading.first_sample, reading.first_sample + len(reading)
        kept: list[tuple[int, int]] = []
        while first < end:
            stretch = first // length
            if stretch != self._stretch:
                self._stretch = stretch
                self._lost = bool(self._random.random() < self._fault.probability)
            stop = min(end, (stretch + 1) * length)
            if not self._lost:
                if kept and kept[-1][1] == first:
                    kept[-1] = (kept[-1][0], stop)
                else:
                    kept.append((first, stop))
            first = stop
        start = reading.first_sample
        if kept == [(start, end)]:
            return [parcel]
        return [parcel._replace(reading=reading.part(a - start, b - start)) for a, b in kept]
