# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What can be wrong with a trace."""

from __future__ import annotations

import errno
from enum import Enum
from pathlib import Path

from roller_sim_ros.errors import RollerSimError


class Problem(Enum):
    """Kinds of trouble with a trace."""

    MISSING = "there is no such file"
    UNREADABLE = "it cannot be read"
    EMPTY = "it is empty"
    FOREIGN = "it is no MCAP file"
    DAMAGED = "it is damaged"
    EXISTS = "it is there already"
    UNWRITABLE = "it cannot be written"
    FULL = "there is no space left"


class TraceError(RollerSimError):
    """A trace cannot be written or read: which, why, and the way out, in one line.

    Attributes
    ----------
    path : pathlib.Path
        The trace.
    problem : Problem
        The kind of trouble.
    reason, way_out : str
        The two halves of the message.
    """

    def __init__(self, path: Path, problem: Problem, reason: str, way_out: str) -> None:
        super().__init__(f"{path}: {reason}; {way_out}")
        self.path = path
        self.problem = problem
        self.reason = reason
        self.way_out = way_out


def writing_error(path: Path, error: OSError) -> TraceError:
    """Return the error for a trace that the system refuses to write."""
    number = error.errno
    if number == errno.EEXIST:
        return TraceError(
            path,
            Problem.EXISTS,
            "there already is such a file and it is not overwritten",
            "give another name or remove it",
        )
    if number in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        why = (error.strerror or "no space left").lower()
        return TraceError(
            path,
            Problem.FULL,
            f"no more can be written: {why}",
            "free space, or write to another place",
        )
    if number == errno.ENOENT:
        return TraceError(
            path, Problem.UNWRITABLE, f"there is no folder {path.parent}", "create it first"
        )
    why = (error.strerror or str(error)).lower()
    return TraceError(
        path, Problem.UNWRITABLE, f"it cannot be written: {why}", "give a path that can be written"
    )


def reading_error(path: Path, error: OSError) -> TraceError:
    """Return the error for a trace that the system refuses to read."""
    if error.errno == errno.ENOENT:
        return TraceError(path, Problem.MISSING, "there is no such file", "check the path")
    why = (error.strerror or str(error)).lower()
    return TraceError(
        path, Problem.UNREADABLE, f"it cannot be read: {why}", "check the path and its permissions"
    )
