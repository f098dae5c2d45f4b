# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""An exciter that does not do what it is told."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from roller_sim_ros.exciter import DriveFault
from roller_sim_ros.faults.fault import Behaviour, ExciterFault, Expectation, Start
from roller_sim_ros.parameters.quantity import parameter

_FOLLOWS = Expectation(Behaviour.UNAFFECTED, tolerance_percent=5.0)
"""The true motion changes and the meter with it; while it changes they differ by what one window blurs."""


@dataclass(frozen=True)
class StuckAmplitude(ExciterFault):
    """The amplitude stays where it is when the fault begins."""

    group: ClassVar[str] = "stuck_amplitude"

    def begin(self, start: Start) -> _Stuck:
        """Return the fault as it acts from now on."""
        del start
        return _Stuck()

    def expectation(self) -> Expectation:
        """The meter goes with the motion."""
        return _FOLLOWS


class _Stuck:
    def __init__(self) -> None:
        self._amplitude_m: float | None = None

    def disturb(self, fault: DriveFault, amplitude_m: float, power_w: float) -> DriveFault:
        del power_w
        if self._amplitude_m is None:
            self._amplitude_m = amplitude_m
        return replace(fault, amplitude_m=self._amplitude_m)


@dataclass(frozen=True)
class SlowRunUp(ExciterFault):
    """Frequency and amplitude follow more slowly than they should."""

    group: ClassVar[str] = "slow_run_up"

    factor: float = parameter(
        0.2, "", "rates of change over those of a sound drive", minimum=1e-3, maximum=1.0
    )

    def begin(self, start: Start) -> SlowRunUp:
        """Return the fault as it acts from now on."""
        del start
        return self

    def disturb(self, fault: DriveFault, amplitude_m: float, power_w: float) -> DriveFault:
        """Slow the drive down."""
        del amplitude_m, power_w
        return replace(fault, rate_factor=self.factor)

    def expectation(self) -> Expectation:
        """The meter goes with the motion."""
        return _FOLLOWS


@dataclass(frozen=True)
class FrequencyDroop(ExciterFault):
    """The hydraulic drive gives way: the frequency falls with the power that the previous revolution took."""

    group: ClassVar[str] = "frequency_droop"

    droop_hz_per_kw: float = parameter(
        0.1,
        "Hz/kW",
        "loss of frequency for the mean power given to the soil in the previous revolution",
        minimum=0.0,
        maximum=100.0,
    )

    def begin(self, start: Start) -> FrequencyDroop:
        """Return the fault as it acts from now on."""
        del start
        return self

    def disturb(self, fault: DriveFault, amplitude_m: float, power_w: float) -> DriveFault:
        """Take the frequency down."""
        del amplitude_m
        loss_hz = self.droop_hz_per_kw * max(0.0, power_w) / 1e3
        return replace(fault, frequency_loss_hz=fault.frequency_loss_hz + loss_hz)

    def expectation(self) -> Expectation:
        """The meter goes with the motion, and says that the frequency changes while it does."""
        return _FOLLOWS
