# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The tacho: one pulse per revolution of the eccentric."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from roller_sim_ros.parameters import ParameterGroup
from roller_sim_ros.parameters.quantity import parameter
from roller_sim_ros.sensors.clock import SAMPLES, TWO_PI, Clock
from roller_sim_ros.session.block import Block
from roller_sim_ros.site.streams import stream

_ROUNDING = 1e-9
"""Of a turn: a phase that is so little short of the pulse's has reached it."""


@dataclass(frozen=True)
class TachoSheet(ParameterGroup):
    """A pick-up at the eccentric's shaft."""

    group: ClassVar[str] = "tacho"

    phase_rad: float = parameter(
        0.0,
        "rad",
        "phase of the eccentric at the pulse; its vertical force goes as the sine",
        minimum=0.0,
        maximum=6.2831853,
    )
    jitter_s: float = parameter(
        0.0, "s", "standard deviation of the pulse's time", minimum=0.0, maximum=1e-2
    )
    missing_probability: float = parameter(
        0.0, "", "of each pulse not to come: a missing tooth", minimum=0.0, maximum=1.0
    )


class Pulse(NamedTuple):
    """A pulse.

    Attributes
    ----------
    sequence : int
        Pulses so far, with this one.
    time_s : float
        As the tacho gives it, s since the start of the session.
    eccentric_phase_rad : float
        Phase that it marks.
    interval_s : float
        Since the previous one; NaN for the first.
    """

    sequence: int
    time_s: float
    eccentric_phase_rad: float
    interval_s: float


class Tacho:
    """Gives the pulses of block after block.

    Parameters
    ----------
    sheet : TachoSheet
        The data sheet.
    seed : int
        Of the run.
    """

    def __init__(self, sheet: TachoSheet, seed: int = 0) -> None:
        self._sheet = sheet
        self._random = stream(seed, "sensors/tacho")
        self._clock = Clock()
        self._place = math.inf
        self._turned = 1.0
        self._count = 0
        self._last_s = math.nan

    def read(self, block: Block, *, lost: bool = False) -> list[Pulse]:
        """Return the pulse in a block, if there is one.

        Parameters
        ----------
        block : Block
            The next block.
        lost : bool
            Whether a pulse in it is lost.
        """
        if self._clock.begin(block):
            self._plan(block.phase_increment_rad / TWO_PI)
        offset = block.first_sample % SAMPLES
        if not offset <= self._place < offset + len(block):
            return []
        time_s = self._clock.start_s + self._place * block.sample_period_s
        # Both numbers are drawn for every pulse: which of them are used changes no later one.
        jitter, chance = self._random.standard_normal(), self._random.random()
        if lost or chance < self._sheet.missing_probability:
            return []
        time_s += self._sheet.jitter_s * jitter
        self._count += 1
        pulse = Pulse(self._count, time_s, self._sheet.phase_rad, time_s - self._last_s)
        self._last_s = time_s
        return [pulse]

    def _plan(self, turns: float) -> None:
        """Find the pulse of the 128 samples that begin: at most one, for they are at most a turn.

        Parameters
        ----------
        turns : float
            From sample to sample.
        """
        self._place = math.inf
        ahead = (self._sheet.phase_rad - self._clock.phase_rad) / TWO_PI % 1.0
        if ahead > 1.0 - _ROUNDING:
            ahead = 0.0
        whole = SAMPLES * turns
        # Half a turn since the last pulse: one that falls on the seam of two stretches comes once.
        if turns > 0.0 and ahead < whole - _ROUNDING and self._turned + ahead > 0.5:
            self._place = ahead / turns
            self._turned = whole - ahead
        else:
            self._turned += whole
