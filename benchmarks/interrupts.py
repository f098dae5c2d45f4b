# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""For the processes of the benchmarks: to be ended by a signal and then say what they found."""

from __future__ import annotations

import signal
from types import FrameType


class Interrupted:
    """True once SIGINT or SIGTERM has come."""

    def __init__(self) -> None:
        self._came = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._note)

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        self._came = True

    def __bool__(self) -> bool:
        return self._came
