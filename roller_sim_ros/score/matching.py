# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which revolution of the truth each message of the meter is of."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.score.evidence import Values
from roller_sim_ros.score.meter_topic import Given
from roller_sim_ros.score.truth import Truth

Places = NDArray[np.int64]


def by_log(truth: Truth, logs_ns: NDArray[np.int64]) -> Places:
    """Return the last revolution whose truth was recorded before each message; −1: none was.

    Parameters
    ----------
    truth : Truth
        The truth.
    logs_ns : ndarray, shape (messages,)
        When the messages were recorded.
    """
    return np.searchsorted(truth.log_ns, logs_ns, side="right").astype(np.int64) - 1


def by_stamp(truth: Truth, stamps_ns: NDArray[np.int64]) -> Places:
    """Return the revolution that ends nearest to each stamp; −1: it is more than a revolution away.

    Parameters
    ----------
    truth : Truth
        The truth, of at least one revolution.
    stamps_ns : ndarray, shape (messages,)
        The messages' own stamps.
    """
    after = np.clip(np.searchsorted(truth.stamp_ns, stamps_ns), 0, len(truth) - 1)
    before = np.maximum(after - 1, 0)
    to_after = np.abs(truth.stamp_ns[after] - stamps_ns)
    to_before = np.abs(truth.stamp_ns[before] - stamps_ns)
    nearest = np.where(to_before <= to_after, before, after)
    near = np.minimum(to_before, to_after) <= truth.period_s * 1e9
    return np.where(near, nearest, -1).astype(np.int64)


def laid_out(messages: Sequence[Given], places: Places, revolutions: int) -> Values:
    """Return the messages on the revolutions that they are of; the last counts where there are several."""
    values = Values(
        given=np.zeros(revolutions, dtype=np.bool_),
        value=np.full(revolutions, np.nan),
        flagged=np.zeros(revolutions, dtype=np.bool_),
        alarm=np.full(revolutions, np.nan),
    )
    for place, message in zip(places.tolist(), messages, strict=True):
        if place >= 0:
            values.given[place] = True
            values.value[place] = message.value
            values.flagged[place] = message.flagged
            values.alarm[place] = message.alarm
    return values
