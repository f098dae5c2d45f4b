# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One row of a verdict."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum


class Verdict(Enum):
    """What a row says."""

    PASS = "pass"
    FAIL = "fail"
    NOT_JUDGED = "not judged"
    """There is nothing to judge by in this trace; the reason is beside it."""


@dataclass(frozen=True)
class Row:
    """One thing that was looked at.

    Attributes
    ----------
    name : str
        Stable name, as in ``bias`` or ``fault/1/stuck``.
    verdict : Verdict
        What it says.
    found : float
        What was measured; NaN where nothing could be.
    limit : float
        What it was held against; NaN without a number.
    unit : str
        Unit of both.
    detail : str
        The rest in a few words.
    """

    name: str
    verdict: Verdict
    found: float = math.nan
    limit: float = math.nan
    unit: str = ""
    detail: str = ""


def at_most(name: str, found: float, limit: float, unit: str, detail: str = "") -> Row:
    """Return a row that passes when the size of what was found is at most the limit."""
    verdict = Verdict.PASS if abs(found) <= limit else Verdict.FAIL
    return Row(name, verdict, found, limit, unit, detail)


def at_least(name: str, found: float, limit: float, unit: str, detail: str = "") -> Row:
    """Return a row that passes when what was found is at least the limit."""
    verdict = Verdict.PASS if found >= limit else Verdict.FAIL
    return Row(name, verdict, found, limit, unit, detail)


def not_judged(name: str, reason: str) -> Row:
    """Return a row that says why there is nothing to judge."""
    return Row(name, Verdict.NOT_JUDGED, detail=reason)
