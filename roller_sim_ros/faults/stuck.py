# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The reading stays where it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.faults.axes import axis_parameter, on
from roller_sim_ros.faults.fault import Behaviour, Expectation, SignalFault, Start

Array = NDArray[np.float64]
_HIDES = "a reading that is stuck shows nothing of it"


@dataclass(frozen=True)
class Stuck(SignalFault):
    """The sensor repeats its last reading."""

    group: ClassVar[str] = "stuck"
    rank: ClassVar[int] = 6
    excludes: ClassVar[dict[str, str]] = dict.fromkeys(
        ("spike", "bias_step", "gain_change", "saturation", "noise_burst"), _HIDES
    )

    axis: str = axis_parameter()

    def begin(self, start: Start) -> _Held:
        """Return the fault as it acts from now on."""
        del start
        return _Held(self.axis)

    def expectation(self) -> Expectation:
        """Nothing moves: no value, once the window has seen nothing else."""
        if self.axis == "horizontal":
            return Expectation(Behaviour.UNAFFECTED, tolerance_percent=0.1)
        return Expectation(Behaviour.NAN, within_revolutions=17)


class _Held:
    def __init__(self, axis: str) -> None:
        self._axis = axis
        self._held: tuple[float, float] | None = None

    def apply(self, vertical: Array, horizontal: Array, before: tuple[float, float]) -> None:
        if self._held is None:
            self._held = before
        if on(self._axis, "vertical"):
            vertical[:] = self._held[0]
        if on(self._axis, "horizontal"):
            horizontal[:] = self._held[1]
