# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""When there is no value though there should be one, and a value though there should be none."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.samples import NANOSECONDS
from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.row import Row, at_least, at_most, not_judged


def rows(evidence: Evidence) -> Iterator[Row]:
    """Yield the rows."""
    limits, truth = evidence.limits, evidence.truth
    true = np.flatnonzero(np.isfinite(truth.cmv))
    first = np.flatnonzero(evidence.usable)
    if len(first) and len(true):
        late_s = (truth.stamp_ns[first[0]] - truth.stamp_ns[true[0]]) / NANOSECONDS
        yield at_most("first_value", max(0.0, late_s), limits.first_value_s, "s")
        yield from _gaps(evidence, int(first[0]))
    else:
        yield not_judged("first_value", "there is none")
    standing = (truth.frequency_hz == 0.0) & truth.steady(
        evidence.window + evidence.latency.revolutions
    )
    if standing.any():
        count = np.count_nonzero(evidence.usable & standing)
        share = 100.0 * count / np.count_nonzero(standing)
        yield at_most("standing", share, limits.standing_percent, "%")
    else:
        yield not_judged("standing", "the eccentric never stands")


def _gaps(evidence: Evidence, first: int) -> Iterator[Row]:
    """Yield what is missing between the meter's first value and the last that can have come."""
    limits, truth = evidence.limits, evidence.truth
    places = np.arange(len(truth))
    in_flight = max(1, round(limits.latency_s / truth.period_s))
    wanted = (
        evidence.steady & evidence.sound & (places >= first) & (places < len(truth) - in_flight)
    )
    if not wanted.any():
        yield not_judged("availability", "there is no time without faults")
        return
    # A meter that is slower than the revolutions has a value until the next one is due.
    there = evidence.usable | (_held(evidence) & ~evidence.silent & ~evidence.values.given)
    share = 100.0 * np.count_nonzero(there & wanted) / np.count_nonzero(wanted)
    yield at_least("availability", share, limits.availability_percent, "%")
    begin, end = _longest(wanted & ~there)
    gap_s = float(truth.stamp_ns[end] - truth.stamp_ns[begin]) / NANOSECONDS
    at_s = float(truth.stamp_ns[begin] - truth.stamp_ns[0]) / NANOSECONDS
    yield at_most("gap", gap_s, limits.gap_s, "s", f"at {at_s:.1f} s" if gap_s else "")


def _held(evidence: Evidence) -> NDArray[np.bool_]:
    """Return where the last message, if there was one, gave a usable value."""
    places = np.where(evidence.values.given, np.arange(len(evidence.truth)), -1)
    last = np.maximum.accumulate(places)
    return (last >= 0) & evidence.usable[np.maximum(last, 0)]


def _longest(where: NDArray[np.bool_]) -> tuple[int, int]:
    """Return the longest stretch: its first place and the one after its last; (0, 0) if there is none."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], where, [False]]).astype(np.int8)))
    if not len(edges):
        return 0, 0
    begins, ends = edges[::2], edges[1::2]
    best = int(np.argmax(ends - begins))
    return int(begins[best]), min(int(ends[best]), len(where) - 1)
