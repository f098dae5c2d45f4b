# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the exciter does in a scenario."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.parameters import Exciter, ParameterError
from roller_sim_ros.scenario.window import Window
from roller_sim_ros.session import ExciterCommand, Moment
from roller_sim_ros.site.declaration import Record, declare, like


@dataclass(frozen=True)
class ProgrammeStep(Window):
    """What the exciter does differently while the step holds; of several that hold the last counts, key by key."""

    vibrate: bool | None = declare("whether the exciter runs", default=None)
    frequency_hz: float | None = like("exciter.frequency_hz", "excitation frequency")
    amplitude_mm: float | None = like("exciter.amplitude_m", "nominal amplitude")

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.vibrate is None and self.frequency_hz is None and self.amplitude_mm is None:
            raise ParameterError(
                "vibrate", None, "a step needs vibrate, frequency_hz or amplitude_mm"
            )


@dataclass(frozen=True)
class ExciterPart(Record):
    """The exciter: its kind, and what it does when."""

    kind: str | None = like("exciter.kind")
    tilt_deg: float | None = like("exciter.tilt_rad")
    vibrate: bool = declare("whether the exciter runs", default=True)
    frequency_hz: float | None = like(
        "exciter.frequency_hz", "excitation frequency; left out: the machine's"
    )
    amplitude_mm: float | None = like(
        "exciter.amplitude_m", "nominal amplitude; left out: the machine's"
    )
    run_up: bool = declare(
        "start from standstill; else at once at full frequency and amplitude", default=False
    )
    programme: tuple[ProgrammeStep, ...] = declare(
        "what differs when; what no step says is as above", default=()
    )


class ExciterProgramme:
    """The programme of a scenario: a function of the moment alone. The exciter stops when all is driven.

    Parameters
    ----------
    start : Exciter
        What holds where no step says anything else.
    steps : tuple of ProgrammeStep
        The steps.
    """

    def __init__(self, start: Exciter, steps: tuple[ProgrammeStep, ...]) -> None:
        self._start = ExciterCommand(start.vibrate, start.frequency_hz, start.amplitude_m)
        self._steps = steps
        self._last = self._start

    def command(self, moment: Moment) -> ExciterCommand:
        """Return what the exciter is to do."""
        start = self._start
        vibrate, frequency_hz, amplitude_m = start.vibrate, start.frequency_hz, start.amplitude_m
        for step in self._steps:
            if step.holds(moment):
                if step.vibrate is not None:
                    vibrate = step.vibrate
                if step.frequency_hz is not None:
                    frequency_hz = step.frequency_hz
                if step.amplitude_mm is not None:
                    amplitude_m = step.amplitude_mm / 1e3
        vibrate = vibrate and not moment.position.finished
        last = self._last
        # Almost always the same as before, and then checked already.
        if (vibrate, frequency_hz, amplitude_m) != (
            last.vibrate,
            last.frequency_hz,
            last.amplitude_m,
        ):
            last = self._last = ExciterCommand(vibrate, frequency_hz, amplitude_m)
        return last
