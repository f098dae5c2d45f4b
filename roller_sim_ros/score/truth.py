# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The truth of a trace, revolution by revolution, and the faults that were active."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.samples import NANOSECONDS, stamp_ns
from roller_sim_ros.faults.fault import Behaviour, Expectation
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

STEADY = 1e-9
"""Relative difference below which two frequencies are the same."""


@dataclass(frozen=True)
class Truth:
    """True values at the end of each revolution; all arrays have the shape (revolutions,).

    Attributes
    ----------
    last_sample : ndarray of int64
        Index of the revolution's last sample.
    stamp_ns : ndarray of int64
        Its time, ns since the epoch.
    log_ns : ndarray of int64
        When the message that holds it was recorded, ns since the epoch.
    cmv, rmv : ndarray of float64
        True values over the window that ends here; NaN where there are none.
    frequency_hz : ndarray of float64
        Of the excitation; 0 where the eccentric stands.
    """

    last_sample: NDArray[np.int64]
    stamp_ns: NDArray[np.int64]
    log_ns: NDArray[np.int64]
    cmv: NDArray[np.float64]
    rmv: NDArray[np.float64]
    frequency_hz: NDArray[np.float64]

    def __len__(self) -> int:
        """Return the number of revolutions."""
        return len(self.last_sample)

    @property
    def period_s(self) -> float:
        """Usual time from one revolution to the next, s."""
        return float(np.median(np.diff(self.stamp_ns))) / NANOSECONDS

    def steady(self, window: int) -> NDArray[np.bool_]:
        """Return where the frequency was the same over the last revolutions.

        Parameters
        ----------
        window : int
            How many.
        """
        frequency = self.frequency_hz
        changed = np.abs(np.diff(frequency)) > STEADY * np.maximum(frequency[1:], frequency[:-1])
        changes = np.concatenate([[0], np.cumsum(changed)])
        before = np.maximum(np.arange(len(self)) - window + 1, 0)
        same: NDArray[np.bool_] = changes == changes[before]
        return same


@dataclass(frozen=True)
class FaultWindow:
    """A fault while it was active.

    Attributes
    ----------
    handle : int
        As in the message.
    id : str
        Of the catalogue.
    expected : Expectation
        What a correct meter does.
    begin, end : int
        First revolution, and the one after the last; places in the arrays of `Truth`.
    """

    handle: int
    id: str
    expected: Expectation
    begin: int
    end: int


def sound(faults: Sequence[FaultWindow], revolutions: int, settle: int) -> NDArray[np.bool_]:
    """Return where no fault is active, nor was less than `settle` revolutions ago; shape (revolutions,)."""
    clear = np.ones(revolutions, dtype=np.bool_)
    for fault in faults:
        clear[fault.begin : fault.end + settle] = False
    return clear


class TruthReader:
    """Collects the truth from messages."""

    def __init__(self) -> None:
        self._rows: tuple[array[int], array[int], array[int]] = (array("q"), array("q"), array("q"))
        self._values: tuple[array[float], array[float], array[float]] = (
            array("d"),
            array("d"),
            array("d"),
        )
        self._active: dict[int, tuple[str, Expectation, int]] = {}
        self._windows: list[tuple[int, str, Expectation, int, int]] = []

    def on_truth(self, message: Any, time_ns: int) -> None:
        """Take a ``truth`` message; those that do not end a revolution say nothing here.

        Raises
        ------
        BagError
            If a second run begins.
        """
        count = len(message.soil_force)
        end = int(message.sequence) + count
        if end % SAMPLES_PER_REVOLUTION:
            return
        samples, stamps, logs = self._rows
        if samples and end - 1 <= samples[-1]:
            raise BagError(
                f"the truth begins anew at sample {end - count} after sample {samples[-1]}: the "
                "trace holds more than one run; record each into a file of its own"
            )
        samples.append(end - 1)
        stamps.append(
            stamp_ns(message) + round((count - 1) * float(message.sample_period) * NANOSECONDS)
        )
        logs.append(time_ns)
        for column, value in zip(
            self._values, (message.cmv, message.rmv, message.excitation_frequency), strict=True
        ):
            column.append(float(value))

    def on_faults(self, message: Any) -> None:
        """Take a ``faults`` message: all that are active from a sample on."""
        sample = int(message.sample)
        now = {int(item.handle): item for item in message.faults}
        for handle in [handle for handle in self._active if handle not in now]:
            name, expected, begin = self._active.pop(handle)
            self._windows.append((handle, name, expected, begin, sample))
        for handle, item in now.items():
            expected = Expectation(
                Behaviour(int(item.expected)),
                float(item.tolerance_percent),
                int(item.within_revolutions),
            )
            self._active.setdefault(handle, (str(item.id), expected, int(item.since_sample)))

    def truth(self) -> Truth:
        """Return the truth."""
        samples, stamps, logs = (np.array(column, dtype=np.int64) for column in self._rows)
        cmv, rmv, frequency = (np.array(column, dtype=np.float64) for column in self._values)
        return Truth(samples, stamps, logs, cmv, rmv, frequency)

    def windows(self) -> tuple[FaultWindow, ...]:
        """Return the faults that were active, in the order of their beginning."""
        samples = np.array(self._rows[0], dtype=np.int64)
        last = int(samples[-1]) + 1 if len(samples) else 0
        found = [
            *self._windows,
            *(
                (handle, name, expected, begin, last)
                for handle, (name, expected, begin) in self._active.items()
            ),
        ]
        # A revolution's row is the first that ends at or after a sample.
        return tuple(
            FaultWindow(
                handle,
                name,
                expected,
                int(np.searchsorted(samples, begin)),
                int(np.searchsorted(samples, end)),
            )
            for handle, name, expected, begin, end in sorted(found, key=lambda item: item[3])
            if end > begin
        )
