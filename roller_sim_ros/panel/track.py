# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The last samples of a stream of blocks, with what is new since the last look."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Track:
    """Columns of equal length; the oldest samples fall out.

    Parameters
    ----------
    names : tuple of str
        Names of the columns.
    length : int
        Samples that are kept at most.

    Attributes
    ----------
    following : int or None
        Index of the sample that comes next without a gap; None before the first block.
    """

    def __init__(self, names: tuple[str, ...], length: int) -> None:
        self._length = length
        self._held = {name: np.zeros(0) for name in names}
        self._blocks: dict[str, list[NDArray[Any]]] = {name: [] for name in names}
        self._waiting = 0
        self._new = 0
        self.following: int | None = None

    def append(self, first: int, columns: Mapping[str, NDArray[Any]]) -> None:
        """Add a block; where samples are missing before it, those that are held are forgotten.

        Parameters
        ----------
        first : int
            Index of its first sample.
        columns : mapping
            {name: array} of all columns, of one length.
        """
        if self.following is not None and first != self.following:
            self.clear()
        length = 0
        for name, blocks in self._blocks.items():
            blocks.append(columns[name])
            length = len(columns[name])
        self.following = first + length
        self._waiting += length
        self._new += length

    def clear(self) -> None:
        """Forget all samples."""
        for name in self._held:
            self._held[name] = np.zeros(0)
            self._blocks[name].clear()
        self._waiting = self._new = 0
        self.following = None

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return a column, shape (held,)."""
        self._join()
        return self._held[name]

    def __len__(self) -> int:
        """Return the number of samples held."""
        self._join()
        return len(next(iter(self._held.values())))

    def new(self) -> int:
        """Return how many of the samples held came since the last call."""
        new, self._new = min(self._new, len(self)), 0
        return new

    def _join(self) -> None:
        if not self._waiting:
            return
        for name, blocks in self._blocks.items():
            joined = np.concatenate([self._held[name], *blocks])
            self._held[name] = joined[-self._length :]
            blocks.clear()
        self._waiting = 0
