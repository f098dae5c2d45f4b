"""Exciter commands as they come in: obeyed, refused, or missed by the watchdog."""

from __future__ import annotations

import time

from roller_sim_ros.parameters import Exciter
from roller_sim_ros.session import ExciterCommand, Refusal

COMMANDED = ("exciter.vibrate", "exciter.frequency_hz", "exciter.amplitude_m")
"""Parameters that a command sets."""

QUIET_S = 1.0
"""The same refusal is logged once in so long; every one is counted."""


class CommandInput:
    """What came of the commands.

    Attributes
    ----------
    refused : int
        Commands refused.
    reason : str
        Why the last one was, or what the watchdog did; empty: nothing of the kind yet.
    refusing : bool
        Whether that happened after the last accepted command.
    """

    def __init__(self) -> None:
        self.refused = 0
        self.reason = ""
        self.refusing = False
        self._last_accepted = time.monotonic()
        self._logged = ("", 0.0)

    def accepted(self) -> None:
        """Note an accepted command, by topic or by parameter."""
        self._last_accepted = time.monotonic()
        self.refusing = False

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

    def overdue(self, exciter: Exciter) -> str:
        """Return what the watchdog says; empty while there is no need to act."""
        timeout_s = exciter.command_timeout_s
        silent_s = time.monotonic() - self._last_accepted
        if not exciter.vibrate or timeout_s <= 0.0 or silent_s <= timeout_s:
            return ""
        return (
            f"no command for {silent_s:.2f} s: at most {timeout_s:g} s (exciter.command_timeout_s); "
            "the exciter runs down"
        )


def stopped(exciter: Exciter) -> ExciterCommand:
    """Return the command that lets the exciter run down and keeps frequency and amplitude for later."""
    return ExciterCommand(False, exciter.frequency_hz, exciter.amplitude_m)
