# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the meter does under each fault, against what the fault says that a correct meter does."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.faults.fault import Behaviour
from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.row import Row, Verdict, at_most, not_judged
from roller_sim_ros.score.truth import FaultWindow


def rows(evidence: Evidence) -> Iterator[Row]:
    """Yield one row for each fault."""
    judges = {
        Behaviour.UNAFFECTED: _unaffected,
        Behaviour.FLAGGED: _flagged,
        Behaviour.NAN: _nan,
    }
    for fault in evidence.faults:
        yield judges[fault.expected.behaviour](evidence, fault, f"fault/{fault.handle}/{fault.id}")


def _span(evidence: Evidence, begin: int, end: int) -> NDArray[np.bool_]:
    places = np.arange(len(evidence.truth))
    return (places >= begin) & (places < end)


def _unaffected(evidence: Evidence, fault: FaultWindow, name: str) -> Row:
    """Judge that the value stays right; faults that are there at the same time may add their part."""
    allowed = fault.expected.tolerance_percent + evidence.limits.fault_margin_percent
    where = _span(evidence, fault.begin, evidence.settled(fault))
    for other in evidence.faults:
        if other is fault or other.begin >= evidence.settled(fault):
            continue
        if other.expected.behaviour is Behaviour.UNAFFECTED:
            overlaps = evidence.settled(other) > fault.begin
            allowed += other.expected.tolerance_percent if overlaps else 0.0
        else:
            where &= ~_span(evidence, other.begin, evidence.settled(other))
    where &= evidence.usable & np.isfinite(evidence.truth.cmv)
    text = fault.expected.text()
    if not where.any():
        return not_judged(name, f"{text}: no value was given as good meanwhile")
    off = evidence.deviation_percent(where)
    return at_most(name, float(off.max()), allowed, "%", text)


def _flagged(evidence: Evidence, fault: FaultWindow, name: str) -> Row:
    """Judge that the meter says in time that something is wrong, and gives no wrong value for good after that."""
    within, text = fault.expected.within_revolutions, fault.expected.text()
    latest = fault.begin + within
    flagged = ~evidence.usable & (evidence.values.given | evidence.silent)
    found = np.flatnonzero(flagged & _span(evidence, fault.begin, evidence.settled(fault)))
    took = float(found[0] - fault.begin) if len(found) else np.inf
    if took > within:
        if fault.end <= latest:
            return not_judged(name, f"{text}: it lasted {fault.end - fault.begin} revolutions")
        return Row(name, Verdict.FAIL, took, within, "revolutions", f"{text}: not in time")
    after = (
        _span(evidence, latest + 1, fault.end) & evidence.usable & np.isfinite(evidence.truth.cmv)
    )
    off = evidence.deviation_percent(after)
    wrong = off > evidence.limits.flagged_value_percent
    if wrong.any():
        detail = f"{text}: {np.count_nonzero(wrong)} values not flagged afterwards, up to {off.max():.0f} % off"
        return Row(name, Verdict.FAIL, took, within, "revolutions", detail)
    return Row(name, Verdict.PASS, took, within, "revolutions", text)


def _nan(evidence: Evidence, fault: FaultWindow, name: str) -> Row:
    """Judge that the meter says in time that it has no value, and goes on saying so."""
    within, text = fault.expected.within_revolutions, fault.expected.text()
    if fault.end - fault.begin <= within:
        return not_judged(name, f"{text}: it lasted {fault.end - fault.begin} revolutions")
    given = evidence.values.given
    is_nan = given & np.isnan(evidence.values.value)
    found = np.flatnonzero(is_nan & _span(evidence, fault.begin, fault.end))
    took = float(found[0] - fault.begin) if len(found) else np.inf
    after = _span(evidence, fault.begin + within + 1, fault.end)
    numbers = int(np.count_nonzero(given & ~is_nan & after))
    if took > within:
        silent = " (it was silent)" if not np.any(given & after) else ""
        return Row(
            name, Verdict.FAIL, took, within, "revolutions", f"{text}: no NaN in time{silent}"
        )
    if numbers:
        detail = f"{text}: {numbers} numbers afterwards"
        return Row(name, Verdict.FAIL, took, within, "revolutions", detail)
    return Row(name, Verdict.PASS, took, within, "revolutions", text)
