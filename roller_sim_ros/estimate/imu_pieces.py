# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Samples of an Imu stream put together, whose phase the tacho tells."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from roller_sim_ros.analysis.samples import NANOSECONDS, Piece, stamp_ns

TOGETHER = 64
"""Imu samples that are looked at together."""

APART = 1.5
"""Distances of the two samples before beyond which some are missing."""


def imu_pieces(messages: Iterator[Any]) -> Iterator[Piece]:
    """Yield the samples of an Imu stream, some together where none is missing."""
    stamps: list[int] = []
    values: list[float] = []
    first = 0
    usual = math.inf
    for message in messages:
        stamp = stamp_ns(message)
        if stamps:
            apart = stamp - stamps[-1]
            if apart <= 0:
                continue
            missing = apart > APART * usual
            # The rate follows the eccentric's, so that only the last distance tells what is usual.
            usual = apart
            if missing or len(stamps) >= TOGETHER:
                yield _piece(first, stamps, values)
                first += len(stamps) + (1 if missing else 0)
                stamps, values = [], []
        stamps.append(stamp)
        values.append(float(message.linear_acceleration.z))
    if stamps:
        yield _piece(first, stamps, values)


def _piece(first: int, stamps: list[int], values: list[float]) -> Piece:
    apart = np.array([later - earlier for earlier, later in pairwise(stamps)])
    period_s = float(apart.mean()) / NANOSECONDS if len(apart) else 0.0
    vertical = np.array(values, dtype=np.float32)
    return Piece(
        first_sample=first,
        stamp_ns=stamps[0],
        sample_period_s=period_s,
        excitation_hz=math.nan,
        phase_rad=math.nan,
        phase_increment_rad=math.nan,
        vertical=vertical,
        horizontal=np.zeros_like(vertical),
        specific_force=True,
    )
