# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The percentiles that lateness is given by."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

SHARES = {"p50": 50.0, "p99": 99.0, "p99.9": 99.9, "max": 100.0}


def percentiles(values: Sequence[float]) -> dict[str, float]:
    """Return {name: value}."""
    found = np.percentile(np.asarray(values), list(SHARES.values()))
    return dict(zip(SHARES, map(float, found), strict=True))
