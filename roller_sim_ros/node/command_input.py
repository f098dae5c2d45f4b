# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Commands as they come in: obeyed, refused, or missed by a watchdog."""

from __future__ import annotations

import time
from collections.abc import Callable

from roller_sim_ros.parameters import Exciter
from roller_sim_ros.session import ExciterCommand, Refusal

COMMANDED = ("exciter.vibrate", "exciter.frequency_hz", "exciter.amplitude_m")
"""Parameters that a command sets."""

QUIET_S = 1.0
"""The same refusal is logged once in so long; every one is counted."""


class CommandInput:
    """What came of the commands to the exciter or to the travel.

    Parameters
    ----------
    now_s : callable
        The time by which silence is measured: real or simulated, s.

    Attributes
    ----------
    refused : int
        Commands refused.
    reason : str
        Why the last one was, or what the watchdog did; empty: nothing of the kind yet.
    refusing : bool
        Whether that happened after the last accepted command.
    """

    def __init__(self, now_s: Callable[[], float]) -> None:
        self.refused = 0
        self.reason = ""
        self.refusing = False
        self._now_s = now_s
        self._last_accepted_s = now_s()
        self._logged = ("", 0.0)

    def accepted(self) -> None:
        """Note an accepted command, by topic or by parameter."""
        self._last_accepted_s = self._now_s()
        self.refusing = False

    def alive(self) -> None:
        """Note that what was commanded still holds, as if it were said again."""
        self._last_accepted_s = self._now_s()

    def refuse(self, code: Refusal, reason: str) -> bool:
        """Note a refusal, or that the watchdog acted; return whether it is to be logged."""
        self.refused += code is not Refusal.TIMEOUT
        self.reason, self.refusing = reason, True
        now = time.monotonic()
        last, when = self._logged
        if reason == last and now - when < QUIET_S:
            return False
        self._logged = (reason, now)
        return True

    def silent_s(self) -> float:
        """Return for how long no command came, s."""
        return self._now_s() - self._last_accepted_s

    def overdue(self, exciter: Exciter) -> str:
        """Return what the watchdog says; empty while there is no need to act."""
        timeout_s = exciter.command_timeout_s
        silent_s = self.silent_s()
        if not exciter.vibrate or timeout_s <= 0.0 or silent_s <= timeout_s:
            return ""
        return (
            f"no command for {silent_s:.2f} s: at most {timeout_s:g} s (exciter.command_timeout_s); "
            "the exciter runs down"
        )


def stopped(exciter: Exciter) -> ExciterCommand:
    """Return the command that lets the exciter run down and keeps frequency and amplitude for later."""
    return ExciterCommand(False, exciter.frequency_hz, exciter.amplitude_m)
