# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How much memory processes have, and whether it grows."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

SETTLED = 0.25
"""Share of a run after which caches and histories are full."""


def resident_mb(pid: int) -> float:
    """Return the memory that a process holds in RAM, in MB."""
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    (line,) = [line for line in status.splitlines() if line.startswith("VmRSS")]
    return float(line.split()[1]) / 1024.0


def children(pid: int) -> list[int]:
    """Return the processes that a process has started."""
    listed = Path(f"/proc/{pid}/task/{pid}/children").read_text(encoding="ascii")
    return [int(child) for child in listed.split()]


@dataclass
class Memory:
    """Memory over time; hours are of what is soaked, be it real or simulated time."""

    hours: list[float] = field(default_factory=list)
    mb: list[float] = field(default_factory=list)

    def add(self, hours: float, mb: float) -> None:
        """Note a value."""
        self.hours.append(hours)
        self.mb.append(mb)

    @property
    def settled(self) -> tuple[list[float], list[float]]:
        """What was noted after the start."""
        begin = int(SETTLED * len(self.hours))
        return self.hours[begin:], self.mb[begin:]

    @property
    def slope_mb_per_h(self) -> float:
        """Slope of the straight line through what was noted after the start."""
        hours, mb = self.settled
        return float(np.polyfit(hours, mb, 1)[0]) if len(hours) > 1 else float("nan")

    @property
    def growth_mb(self) -> float:
        """By how much that line rises from its begin to its end."""
        hours, _ = self.settled
        return self.slope_mb_per_h * (hours[-1] - hours[0])

    def quarters(self) -> list[float]:
        """Return the memory at the start, after each quarter, and at the end."""
        last = len(self.mb) - 1
        return [self.mb[round(share * last)] for share in (0.0, 0.25, 0.5, 0.75, 1.0)]
