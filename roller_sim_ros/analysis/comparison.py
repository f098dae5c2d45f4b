# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Recorded values beside those computed anew, matched by the index of their last sample."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

REMEMBERED = 4096
"""Values on either side that wait for their counterpart."""


@dataclass
class Difference:
    """Largest difference of one quantity.

    Attributes
    ----------
    largest : float
        Largest |recorded − computed| where both are known; NaN without any.
    compared : int
        Pairs in which both are known.
    one_unknown : int
        Pairs in which only one of the two is NaN.
    """

    largest: float = math.nan
    compared: int = 0
    one_unknown: int = 0

    def add(self, recorded: float, computed: float) -> None:
        """Take note of a pair."""
        if math.isnan(recorded) or math.isnan(computed):
            self.one_unknown += math.isnan(recorded) != math.isnan(computed)
            return
        self.compared += 1
        difference = abs(recorded - computed)
        self.largest = difference if math.isnan(self.largest) else max(self.largest, difference)


@dataclass
class Comparison:
    """How two series of meter values agree.

    Attributes
    ----------
    pairs : int
        Values that were compared.
    unmatched : int
        Recorded values without counterpart.
    window_incomplete : int
        Recorded values whose window the bag does not hold whole: it begins later or has a gap.
    differences : dict
        By quantity.
    disagreements : dict
        Pairs that differ in a whole number (period, mode, status), by quantity.
    """

    pairs: int = 0
    unmatched: int = 0
    window_incomplete: int = 0
    differences: dict[str, Difference] = field(default_factory=dict)
    disagreements: dict[str, int] = field(default_factory=dict)

    def add(self, recorded: Mapping[str, float], computed: Mapping[str, float]) -> None:
        """Take note of a pair: numbers are subtracted, whole numbers compared."""
        self.pairs += 1
        for name, value in recorded.items():
            other = computed[name]
            if isinstance(value, int):
                self.disagreements.setdefault(name, 0)
                self.disagreements[name] += value != other
            else:
                self.differences.setdefault(name, Difference()).add(value, other)


Values = Mapping[str, float]


class Matcher:
    """Brings both series together, whichever of a pair comes first.

    Parameters
    ----------
    comparison : Comparison
        Where pairs are counted.
    """

    def __init__(self, comparison: Comparison) -> None:
        self.comparison = comparison
        self._computed: dict[int, tuple[int, bool, Values]] = {}
        self._recorded: dict[int, Values] = {}

    def computed(
        self, last_sample: int, row: int, values: Values, *, window_whole: bool
    ) -> tuple[int, Values] | None:
        """Take a value computed anew.

        Parameters
        ----------
        last_sample : int
            Index of its last sample.
        row : int
            Where it stands in the history.
        values : mapping
            Its quantities.
        window_whole : bool
            Whether all its samples were there.

        Returns
        -------
        (row, recorded values) or None
            When its counterpart had come before.
        """
        self._computed.pop(last_sample, None)
        recorded = self._recorded.pop(last_sample, None)
        if recorded is not None:
            return self._pair(recorded, (row, window_whole, values))
        self._computed[last_sample] = (row, window_whole, values)
        if len(self._computed) > REMEMBERED:
            del self._computed[next(iter(self._computed))]
        return None

    def recorded(self, last_sample: int, values: Values) -> tuple[int, Values] | None:
        """Take a recorded value; return (row, recorded values) when its counterpart had come before."""
        computed = self._computed.pop(last_sample, None)
        if computed is not None:
            return self._pair(values, computed)
        if self._recorded.pop(last_sample, None) is not None:
            self.comparison.unmatched += 1
        self._recorded[last_sample] = values
        if len(self._recorded) > REMEMBERED:
            del self._recorded[next(iter(self._recorded))]
            self.comparison.unmatched += 1
        return None

    def finish(self) -> None:
        """Count what is left without counterpart."""
        self.comparison.unmatched += len(self._recorded)
        self._recorded.clear()

    def _pair(self, recorded: Values, computed: tuple[int, bool, Values]) -> tuple[int, Values]:
        row, window_whole, values = computed
        if window_whole or math.isnan(recorded["cmv"]):
            self.comparison.add(recorded, values)
        else:
            self.comparison.window_incomplete += 1
        return row, recorded
