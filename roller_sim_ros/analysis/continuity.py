# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a numbered stream is missing, doubled or out of order."""

from __future__ import annotations

from dataclasses import dataclass, field

REMEMBERED_GAPS = 256
"""Gaps that are kept open for blocks that come late."""


@dataclass
class Continuity:
    """Counts as the blocks go by.

    Attributes
    ----------
    reach_samples : int
        A block that begins further back than this is a new start of the sender, as it is for the meter.
    blocks, samples : int
        All that came, and the samples of them that had not been there before.
    gaps, missing : int
        Gaps that stayed open, and the samples they lack.
    duplicates : int
        Blocks of which nothing was new.
    out_of_order : int
        Blocks that came after a later one and filled a gap, wholly or in part.
    restarts : int
        Times the numbers began anew.
    """

    reach_samples: int
    blocks: int = 0
    samples: int = 0
    duplicates: int = 0
    out_of_order: int = 0
    restarts: int = 0
    _closed_gaps: int = 0
    _closed_missing: int = 0
    _open: list[tuple[int, int]] = field(default_factory=list)
    _expected: int | None = None

    @property
    def gaps(self) -> int:
        """Gaps that stayed open."""
        return self._closed_gaps + len(self._open)

    @property
    def missing(self) -> int:
        """Samples that the gaps lack."""
        return self._closed_missing + sum(end - start for start, end in self._open)

    def feed(self, first_sample: int, count: int) -> None:
        """Take note of a block by the index of its first sample and its length."""
        end = first_sample + count
        self.blocks += 1
        if self._expected is None:
            self._expected = first_sample
        elif first_sample < self._expected - self.reach_samples:
            self.restarts += 1
            self._close(len(self._open))
            self._expected = first_sample
        if first_sample > self._expected:
            self._open.append((self._expected, first_sample))
            self._close(len(self._open) - REMEMBERED_GAPS)
        late = self._fill(first_sample, min(end, self._expected))
        new = late + max(0, end - max(first_sample, self._expected))
        self.samples += new
        self.out_of_order += late > 0
        self.duplicates += new == 0
        self._expected = max(self._expected, end)

    def _close(self, count: int) -> None:
        """Give up waiting for the oldest `count` gaps."""
        for start, end in self._open[: max(0, count)]:
            self._closed_gaps += 1
            self._closed_missing += end - start
        del self._open[: max(0, count)]

    def _fill(self, first: int, end: int) -> int:
        """Fill open gaps with the samples from `first` to `end`; return how many that were."""
        filled = 0
        left: list[tuple[int, int]] = []
        for start, stop in self._open:
            low, high = max(start, first), min(stop, end)
            if low >= high:
                left.append((start, stop))
                continue
            filled += high - low
            left += [part for part in ((start, low), (high, stop)) if part[0] < part[1]]
        self._open = left
        return filled
