# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""True values beside the sensor's: from the motion itself, once a revolution."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from roller_sim_ros.meters import kernels
from roller_sim_ros.meters.harmonics import METER_ORDERS, HarmonicsWindow
from roller_sim_ros.meters.mode import Mode, true_mode
from roller_sim_ros.meters.period import TOLERANCE, PeriodWindow
from roller_sim_ros.meters.registry import TRUE_METERS, evaluate
from roller_sim_ros.meters.revolutions import Revolution, RevolutionCollector, Timing
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.session.block import AIR, Block


class TruthValue(NamedTuple):
    """True values at the end of a revolution.

    Attributes
    ----------
    last_sample : int
        Index of the last sample of the window; −1 before the first revolution.
    cmv, rmv : float
        From the true vertical acceleration; NaN when unknown.
    air_fraction : float
        Share of the window without contact; NaN while the window fills.
    force_ratio_max : float
        max F_s / F_stat over the window; NaN while it fills.
    period, blows_per_period : int
        Revolutions, and contacts that begin in one period; 0: none or unknown.
    mode : Mode
        Operating mode from the contact states.
    """

    last_sample: int = -1
    cmv: float = math.nan
    rmv: float = math.nan
    air_fraction: float = math.nan
    force_ratio_max: float = math.nan
    period: int = 0
    blows_per_period: int = 0
    mode: Mode = Mode.UNKNOWN


class TruthMeter:
    """Streaming truth; `feed` it the blocks of a session in order.

    Air fraction and force ratio are over the last `window_revolutions` × N samples, whatever the
    exciter does. CMV, RMV, period and mode need as many whole revolutions at one frequency.

    Parameters
    ----------
    window_revolutions : int
        Even number of revolutions per value.
    static_load_n : float
        F_stat, N.
    samples_per_revolution : int
        N.
    period_tolerance : float
        Share of the peak within which the motion has to repeat.
    """

    def __init__(
        self,
        window_revolutions: int,
        static_load_n: float,
        samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
        period_tolerance: float = TOLERANCE,
    ) -> None:
        self.window_revolutions = window_revolutions
        self.static_load_n = static_load_n
        self.value = TruthValue()
        self._samples_per_revolution = samples_per_revolution
        self._collector = RevolutionCollector(
            3, window_revolutions * samples_per_revolution, samples_per_revolution
        )
        self._harmonics = HarmonicsWindow(window_revolutions, METER_ORDERS, samples_per_revolution)
        self._period = PeriodWindow(window_revolutions, samples_per_revolution, period_tolerance)
        self._forces = np.zeros(window_revolutions)
        self._air = np.zeros((window_revolutions, samples_per_revolution), dtype=np.bool_)
        self._revolutions = 0
        self._excitation_hz = 0.0
        self._at_this_frequency = 0

    def feed(self, block: Block) -> TruthValue:
        """Take one block and return the values at the end of the last completed revolution."""
        channels = (block.acceleration_vertical, block.soil_force, block.contact_state)
        timing = Timing(block.sample_period_s, block.excitation_hz, block.phase_increment_rad)
        for item in self._collector.feed(
            block.first_sample, channels, timing, block.eccentric_phase_rad
        ):
            if isinstance(item, Revolution):
                self.value = self._value(item)
            else:
                self._harmonics.clear()
                self._period.clear()
                self._revolutions = 0
        return self.value

    def _value(self, revolution: Revolution) -> TruthValue:
        vertical, force, state = revolution.samples
        slot = self._revolutions % self.window_revolutions
        self._revolutions += 1
        if revolution.excitation_hz != self._excitation_hz:
            self._excitation_hz = revolution.excitation_hz
            self._at_this_frequency = 0
        self._at_this_frequency += 1
        without_contact, greatest_n = kernels.note_contact(
            force, state, AIR, slot, self._air, self._forces
        )
        last_sample = revolution.first_sample + self._samples_per_revolution - 1
        if revolution.synchronous:
            index = revolution.first_sample // self._samples_per_revolution
            self._harmonics.push(vertical, index, revolution.phase_rad)
            self._period.push(vertical)
        else:
            self._harmonics.clear()
            self._period.clear()
        if self._revolutions < self.window_revolutions:
            return TruthValue(last_sample)
        air_fraction = without_contact / self._air.size
        force_ratio_max = greatest_n / self.static_load_n
        if not self._harmonics.full:
            return TruthValue(
                last_sample, air_fraction=air_fraction, force_ratio_max=force_ratio_max
            )
        harmonics = self._harmonics.harmonics()
        values = evaluate(harmonics, TRUE_METERS) if harmonics.amplitude(1.0) > 0.0 else {}
        steady = self._at_this_frequency >= self.window_revolutions
        period = self._period.period() if steady else None
        return TruthValue(
            last_sample=last_sample,
            cmv=values.get("cmv", math.nan),
            rmv=values.get("rmv", math.nan),
            air_fraction=air_fraction,
            force_ratio_max=force_ratio_max,
            period=period or 0,
            blows_per_period=kernels.contacts_begun(self._air, slot, period) if period else 0,
            mode=true_mode(air_fraction, period),
        )
