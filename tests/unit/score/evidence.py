# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Evidence of a meter that is right, to be spoilt by the tests."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roller_sim_ros.faults.fault import Expectation
from roller_sim_ros.score.evidence import Evidence, Values
from roller_sim_ros.score.latency import Latency
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.score.row import Row
from roller_sim_ros.score.rows import judge
from roller_sim_ros.score.truth import FaultWindow, Truth

PERIOD_NS = 1_000_000_000 // 28
REVOLUTIONS = 600


def right(limits: Limits | None = None, *faults: FaultWindow, hz: float = 28.0) -> Evidence:
    """Return evidence of true values from 20 to 60, of which the last third are in double jump."""
    places = np.arange(REVOLUTIONS)
    cmv = 40.0 + 20.0 * np.sin(places / 60.0)
    cmv[:15] = np.nan
    rmv = np.where(places < 400, 0.5, 150.0)
    rmv[:15] = np.nan
    truth = Truth(
        last_sample=128 * places + 127,
        stamp_ns=PERIOD_NS * (places + 1),
        log_ns=PERIOD_NS * (places + 1),
        cmv=cmv,
        rmv=rmv,
        frequency_hz=np.full(REVOLUTIONS, hz),
    )
    values = Values(
        given=np.ones(REVOLUTIONS, dtype=np.bool_),
        value=cmv.copy(),
        flagged=np.isnan(cmv),
        alarm=rmv.copy(),
    )
    return Evidence(
        truth=truth,
        faults=faults,
        values=values,
        stamped=True,
        alarm_is_rmv=True,
        latency=Latency(0, 0.0),
        window=16,
        limits=limits or Limits(),
    )


def fault(expected: Expectation, begin: int = 200, end: int = 260, handle: int = 1) -> FaultWindow:
    return FaultWindow(handle, "some", expected, begin, end)


def rows_of(evidence: Evidence) -> dict[str, Row]:
    return {row.name: row for row in judge(evidence)}


def silenced(evidence: Evidence, where: slice) -> Evidence:
    """Return the evidence of a meter that says nothing for a while."""
    values = evidence.values
    spoilt = replace(
        values, given=values.given.copy(), value=values.value.copy(), alarm=values.alarm.copy()
    )
    spoilt.given[where] = False
    spoilt.value[where] = np.nan
    spoilt.alarm[where] = np.nan
    return replace(evidence, values=spoilt)
