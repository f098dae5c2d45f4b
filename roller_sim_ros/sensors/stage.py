# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A stage of a sensor: signals of a block in, signals out."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Signals(NamedTuple):
    """Both axes of a piece of one revolution.

    Attributes
    ----------
    vertical, horizontal : ndarray, shape (n,)
        m/s².
    period_s : float
        Time from sample to sample, and from the last one to the next piece's first.
    """

    vertical: Array
    horizontal: Array
    period_s: float


class Stage(Protocol):
    """A stage, fed with the pieces in order; what comes out does not depend on how they are cut."""

    def apply(self, signals: Signals) -> Signals:
        """Return what the stage makes of a piece."""
        ...
