# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How far the values are off: bias, RMS, latency, and a ceiling that they do not pass."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.row import Row, Verdict, at_least, at_most, not_judged

SPAN_PERCENT = 5.0
"""Change of the true value that a meter has to show."""

LEAST_AT_CEILING = 3


def rows(evidence: Evidence) -> Iterator[Row]:
    """Yield the rows."""
    limits = evidence.limits
    value, true = evidence.values.value, evidence.truth.cmv
    where = evidence.compared
    count = int(np.count_nonzero(where))
    yield at_least("values", count, limits.least_values, "", "compared with the truth")
    if count == 0:
        return
    bias = 100.0 * float(np.mean(value[where] - true[where]) / np.mean(true[where]))
    yield at_most("bias", bias, limits.bias_percent, "%")
    yield at_most("rms", _rms_percent(value, true, where), limits.rms_percent, "%")
    jumping = where & (evidence.truth.rmv > limits.alarm_rmv)
    name = "rms_in_double_jump"
    if np.count_nonzero(jumping) < limits.least_values:
        yield not_judged(name, "the drum hardly jumps")
    else:
        found = _rms_percent(value, true, jumping)
        yield at_most(name, found, limits.rms_in_double_jump_percent, "%")
    latency = evidence.latency
    if math.isnan(latency.seconds):
        yield not_judged("latency", latency.reason)
    elif latency.seconds > limits.latency_s:
        detail = latency.reason
        yield Row("latency", Verdict.FAIL, latency.seconds, limits.latency_s, "s", detail)
    else:
        yield at_most("latency", max(0.0, latency.seconds), limits.latency_s, "s")
    yield _ceiling(evidence, value[where], true[where])


def _rms_percent(
    value: NDArray[np.float64], true: NDArray[np.float64], where: NDArray[np.bool_]
) -> float:
    deviation, size = np.mean((value - true)[where] ** 2), np.mean(true[where] ** 2)
    return 100.0 * math.sqrt(float(deviation) / float(size))


def _ceiling(evidence: Evidence, value: NDArray[np.float64], true: NDArray[np.float64]) -> Row:
    """Return whether the values end at a greatest one that the true ones do not end at."""
    greatest = float(value.max())
    at_greatest = value == greatest
    count = int(np.count_nonzero(at_greatest))
    span = 100.0 * float(np.ptp(true[at_greatest]) / np.mean(true[at_greatest]))
    clipped = count >= LEAST_AT_CEILING and span > SPAN_PERCENT
    share = 100.0 * count / len(value) if clipped else 0.0
    detail = f"{count} values are {greatest:g}" if clipped else ""
    return at_most("ceiling", share, evidence.limits.ceiling_percent, "%", detail)
