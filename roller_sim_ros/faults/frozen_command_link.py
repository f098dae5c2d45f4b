# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Commands that arrive nowhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.faults.fault import Behaviour, Expectation, Fault, Stage


@dataclass(frozen=True)
class FrozenCommandLink(Fault):
    """Commands to exciter and travel are lost; the machine goes on with the last one."""

    group: ClassVar[str] = "frozen_command_link"
    stage: ClassVar[Stage] = Stage.COMMAND

    def expectation(self) -> Expectation:
        """What the machine does is measured as ever."""
        return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)
