# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What an estimate is worth, and why there may be none."""

from __future__ import annotations

from enum import Enum

from roller_sim_ros.errors import RollerSimError


class EstimateError(RollerSimError):
    """What is to be estimated from cannot be used at all."""


class Status(Enum):
    """Whether an estimate stands; each with the sentence that says so."""

    OK = "ok", "both parameters stand, within their spread"
    PLASTIC_UNCERTAIN = (
        "plastic uncertain",
        "p hardly shows in this motion: its spread is above 20 %; G stands",
    )
    UNCERTAIN = (
        "uncertain",
        "the motion hardly shows the ground: G or p at a bound, or the spread of G above 20 %",
    )
    MISFIT = (
        "misfit",
        "no ground of the model moves this machine so: another machine, setting or half space, or a bad sensor",
    )
    CHAOTIC = "chaotic", "the motion does not repeat within 8 revolutions"
    UNSETTLED = "unsettled", "the motion drifts through the window: it has not settled yet"
    CHANGING = "changing", "frequency or amplitude of the exciter change within the window"
    CLIPPED = "clipped", "samples stand still at the end of the sensor's range"
    STANDING = "standing", "the exciter stands, or nothing vibrates"
    TOO_FEW = "too few", "too few revolutions in a row"
    MISSING = "missing", "samples are missing or are no numbers"

    def __init__(self, label: str, meaning: str) -> None:
        self.label = label
        self.meaning = meaning

    @property
    def stands(self) -> bool:
        """Whether the values are meant to be used."""
        return self in (Status.OK, Status.PLASTIC_UNCERTAIN)
