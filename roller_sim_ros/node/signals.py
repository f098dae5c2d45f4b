# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""SIGINT and SIGTERM; without rclpy, so that they are handled before what takes long to import."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_NUMBERS = (signal.SIGINT, signal.SIGTERM)


class Stopped(KeyboardInterrupt):
    """A signal came before the node ran.

    Not KeyboardInterrupt itself: where that one passes through the `exec` of a text, as in the making of a
    dataclass, Python ends the process as killed by SIGINT although it was caught.
    """


class Signals:
    """What the signals mean: an interruption while the node starts, a request once it runs.

    Attributes
    ----------
    stop : bool
        Whether one came.
    running : bool
        Whether the node looks at `stop`; until then a signal raises `Stopped`.
    """

    def __init__(self) -> None:
        self.stop = False
        self.running = False

    def take(self, _number: int, _frame: FrameType | None) -> None:
        """Be told of a signal, as `signal.signal` does it."""
        self.stop = True
        if not self.running:
            raise Stopped


@contextmanager
def handled() -> Iterator[Signals]:
    """Handle both signals alike until the block ends."""
    signals = Signals()
    before = {number: signal.signal(number, signals.take) for number in _NUMBERS}
    try:
        yield signals
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
