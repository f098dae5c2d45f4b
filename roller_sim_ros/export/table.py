# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Columns of numbers that come in pieces, so that a long trace need not fit into memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import Bag, BagError

Columns = dict[str, NDArray[Any]]
"""Arrays of one length by their names; the unit is at the end of a name where it has one."""

ROWS = 1 << 16
"""Rows of a piece, about."""


@dataclass(frozen=True)
class Request:
    """What is asked for.

    Attributes
    ----------
    path : Path
        The trace.
    topic : str or None
        Topic of the table's messages; None: the only one.
    cell_m : float
        Side of the map's cells.
    progress : callable
        Told the share of the trace that is read.
    """

    path: Path
    topic: str | None = None
    cell_m: float = 1.0
    progress: Callable[[float], None] = lambda _share: None


@dataclass(frozen=True)
class Table:
    """A table of a trace.

    Attributes
    ----------
    name : str
        What it holds, as in ``samples``.
    parameters : mapping
        Parameters of the run that were recorded with it, by their dotted names.
    pieces : callable
        Yields its rows from the first to the last in pieces of the same columns; at least one piece.
    damage : callable
        Returns what of the trace could not be read, empty when all could; known once all pieces were yielded.
    """

    name: str
    parameters: Mapping[str, str]
    pieces: Callable[[], Iterator[Columns]]
    damage: Callable[[], str]

    def whole(self) -> Columns:
        """Return all rows at once."""
        return joined(list(self.pieces()))


def joined(pieces: list[Columns]) -> Columns:
    """Return pieces of the same columns as one."""
    return {name: np.concatenate([piece[name] for piece in pieces]) for name in pieces[0]}


def gathered(rows: Iterator[Columns]) -> Iterator[Columns]:
    """Yield small pieces joined to ones of about `ROWS` rows."""
    kept: list[Columns] = []
    count = 0
    for piece in rows:
        kept.append(piece)
        count += len(next(iter(piece.values())))
        if count >= ROWS:
            yield joined(kept)
            kept, count = [], 0
    if kept:
        yield joined(kept)


def topic_of(bag: Bag, request: Request, type_name: str, otherwise: str) -> str:
    """Return the topic of a type: the one asked for, or the only one.

    Raises
    ------
    BagError
        If there is none or a choice; then with `otherwise`, which says what to do.
    """
    path, given = request.path, request.topic
    found = [item.name for item in bag.topics.values() if item.type == type_name and item.count]
    if given is not None:
        if given not in found and f"/{given}" not in found:
            raise BagError(
                f"{path}: there is no {type_name} on {given}; it is on {found or 'none'}"
            )
        return given if given in found else f"/{given}"
    if not found:
        raise BagError(f"{path}: it holds no {type_name}; {otherwise}")
    if len(found) > 1:
        names = ", ".join(sorted(found))
        raise BagError(f"{path}: several topics hold {type_name}; choose one with --topic: {names}")
    return found[0]
