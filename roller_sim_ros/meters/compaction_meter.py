# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The compaction meter: CMV, RMV, period, mode and further values from published samples, once a revolution.

It works on nothing but what a subscriber receives (float32 samples, timing and eccentric phase), so
any client that feeds it the same samples gets the same numbers to the last bit, whatever the size
of the blocks. Quantities that are not known are NaN (period and mode: 0), never 0, and the status
says why.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import kernels
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.flight import lifts
from roller_sim_ros.meters.harmonics import HarmonicsWindow
from roller_sim_ros.meters.mode import Mode, metered_mode
from roller_sim_ros.meters.order_tracking import OrderTracker
from roller_sim_ros.meters.period import NO_PERIOD, TOLERANCE, PeriodWindow
from roller_sim_ros.meters.registry import FURTHER, ORDERS, evaluate, evaluate_drum
from roller_sim_ros.meters.revolutions import (
    SAME_PHASE_SAMPLES,
    SYNCHRONOUS,
    Loss,
    Revolution,
    RevolutionCollector,
    Timing,
)
from roller_sim_ros.meters.status import Status
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

TURN = 2.0 * math.pi
TRACKED_HZ = 10.0
"""Excitation frequency from which samples of a fixed rate are read in orders; rollers vibrate at 25 to 40 Hz."""

STEADY = 1e-9
"""Relative difference below which two frequencies, or two amplitudes, are the same."""


def _unknown_further() -> dict[str, float]:
    return dict.fromkeys((meter.name for meter in FURTHER), math.nan)


@dataclass(frozen=True)
class MeterValue:
    """What the meter says at the end of a revolution.

    Attributes
    ----------
    last_sample : int
        Index of the last sample of the window.
    window_revolutions : int
        Revolutions in the window.
    cmv, rmv : float
        Meter values; NaN when unknown.
    excitation_frequency : float
        At the last sample, Hz.
    fundamental_amplitude : float
        A_1 of the vertical acceleration, m/s²; NaN when unknown.
    fundamental_phase : float
        θ in (−π, π]: the fundamental is A_1 sin(φ + θ), φ the eccentric's phase, whose vertical
        force goes with sin φ. A free drum has 0; negative: the acceleration lags the eccentric. NaN
        when unknown or below the noise floor.
    period : int
        1, 2, 4 or 8 revolutions; 0: none, or unknown when the mode is UNKNOWN too.
    mode : Mode
        Operating mode as far as the acceleration tells it.
    status : Status
        Why something is unknown.
    further : mapping
        {name: value} of all values beside CMV and RMV (`registry.FURTHER`), in their units; NaN when unknown, and
        where the machine or the exciter's amplitude is not known or not the same all over the window.
    """

    last_sample: int
    window_revolutions: int
    cmv: float
    rmv: float
    excitation_frequency: float
    fundamental_amplitude: float
    fundamental_phase: float
    period: int
    mode: Mode
    status: Status
    further: Mapping[str, float] = field(default_factory=_unknown_further)

    def alone(self, value: float) -> float:
        """Return one of the values for those who do not see the status: NaN where samples were clipped."""
        return math.nan if Status.CLIPPED in self.status else value


class CompactionMeter:
    """Streaming meter; `feed` it blocks, it returns a value for each completed revolution.

    A value comes every N samples also while the exciter stands or runs below the sampling floor, where
    N samples are no revolution: with NaN and the status STANDING or WINDOW_FILLING. A revolution of which
    samples are missing gives no value; the window begins anew after it, with GAP until it is full. A sample
    that is no finite number counts as missing, except that its revolution gives a value, NaN with GAP.

    Samples of a fixed rate are laid on the eccentric's angle first (`order_tracking`), above `TRACKED_HZ`: their values
    come a little after the revolution.

    Parameters
    ----------
    window_revolutions : int
        Even number of revolutions per value.
    noise_floor_m_s2 : float
        A_1 below which there is no value.
    samples_per_revolution : int
        N.
    drum : Drum, optional
        The machine, for the values that need it.
    period_tolerance : float
        Share of the peak within which the motion has to repeat.

    Raises
    ------
    ValueError
        If `window_revolutions` is not a positive even number.
    """

    def __init__(
        self,
        window_revolutions: int = 16,
        noise_floor_m_s2: float = 0.05,
        samples_per_revolution: int = SAMPLES_PER_REVOLUTION,
        drum: Drum | None = None,
        period_tolerance: float = TOLERANCE,
    ) -> None:
        if window_revolutions < 2 or window_revolutions % 2:
            raise ValueError(
                f"window_revolutions = {window_revolutions}: must be a positive even number"
            )
        self.window_revolutions = window_revolutions
        self.noise_floor_m_s2 = noise_floor_m_s2
        self._collector = self._new_collector(samples_per_revolution)
        self._tracker: OrderTracker | None = None
        self._harmonics = HarmonicsWindow(window_revolutions, ORDERS, samples_per_revolution)
        self._period = PeriodWindow(window_revolutions, samples_per_revolution, period_tolerance)
        self._frequencies = np.zeros(window_revolutions)
        self._amplitudes = np.zeros(window_revolutions)
        self._drum = drum
        self._amplitude_m = math.nan
        self._samples_per_revolution = samples_per_revolution
        self._phase_rad = 0.0
        self._gap = False
        self._clipped_before = 0
        kernels.warm_up()

    def feed(
        self,
        first_sample: int,
        vertical: NDArray[np.float32],
        sample_period_s: float,
        excitation_hz: float,
        eccentric_phase_rad: float,
        phase_increment_rad: float,
        amplitude_m: float = math.nan,
        clipped: int = 0,
    ) -> list[MeterValue]:
        """Take one block as published and return the values of the revolutions that it completes.

        Parameters
        ----------
        first_sample : int
            Index of the first sample (``sequence`` of the message).
        vertical : ndarray of float32, shape (n,)
            Vertical acceleration, m/s², up positive; coordinate acceleration or specific force.
        sample_period_s, excitation_hz : float
            Sample period and excitation frequency.
        eccentric_phase_rad : float
            Phase of the eccentric at the first sample.
        phase_increment_rad : float
            Phase from sample to sample.
        amplitude_m : float
            Nominal amplitude of the exciter, m; NaN when unknown.
        clipped : int
            How many readings of the block, both axes together, the sensor clipped; all of its revolution counts
            as clipped then.
        """
        self._amplitude_m = amplitude_m
        count = self._samples_per_revolution
        synchronous = abs(phase_increment_rad * count / TURN - 1.0) < SYNCHRONOUS
        tracked = not synchronous and excitation_hz >= TRACKED_HZ and phase_increment_rad > 0.0
        if tracked != (self._tracker is not None):
            self._collector = self._new_collector(count)
            self._clear()
            self._clipped_before = 0
            self._tracker = OrderTracker(count) if tracked else None
        if self._tracker is None:
            timing = Timing(sample_period_s, excitation_hz, phase_increment_rad)
            return self._fed(first_sample, vertical, timing, eccentric_phase_rad, clipped)
        values = []
        for item in self._tracker.feed(
            first_sample,
            vertical,
            excitation_hz,
            eccentric_phase_rad,
            phase_increment_rad,
            clipped,
        ):
            timing = Timing(1.0 / (item.excitation_hz * count), item.excitation_hz, TURN / count)
            found = self._fed(item.number * count, item.samples, timing, 0.0, int(item.clipped))
            values += [replace(value, last_sample=item.last_sample) for value in found]
        return values

    def _new_collector(self, samples_per_revolution: int) -> RevolutionCollector:
        return RevolutionCollector(
            1, self.window_revolutions * samples_per_revolution, samples_per_revolution
        )

    def _fed(
        self,
        first_sample: int,
        vertical: NDArray[np.floating],
        timing: Timing,
        eccentric_phase_rad: float,
        clipped: int,
    ) -> list[MeterValue]:
        """Return the values of the revolutions that samples complete which go with the eccentric."""
        values = []
        for item in self._collector.feed(first_sample, [vertical], timing, eccentric_phase_rad):
            if isinstance(item, Loss):
                self._clear()
                self._gap = True
                self._clipped_before = 0
            else:
                values.append(self._value(item, clipped=clipped > 0))
        if clipped:
            # Also where the block completes no revolution: to the end of the one that it is of.
            end = first_sample + len(vertical)
            self._clipped_before = end + -end % self._samples_per_revolution
        return values

    def _value(self, revolution: Revolution, *, clipped: bool) -> MeterValue:
        if not np.isfinite(revolution.samples).all():
            self._clear()
            self._gap = True
        elif revolution.synchronous:
            self._push(revolution)
        else:
            self._clear()
        last_sample = revolution.first_sample + self._samples_per_revolution - 1
        if clipped:
            self._clipped_before = last_sample + 1
        if not self._harmonics.full:
            standing = revolution.excitation_hz <= 0.0
            status = Status.STANDING if standing else Status.WINDOW_FILLING
            if self._gap:
                status |= Status.GAP
            return self._unknown(last_sample, revolution.excitation_hz, status)
        self._gap = False
        return self._known(last_sample, revolution.excitation_hz)

    def _known(self, last_sample: int, excitation_hz: float) -> MeterValue:
        """Return the value of a full window."""
        status = Status.NONE
        if not _steady(self._frequencies):
            status |= Status.FREQUENCY_CHANGING
        first_sample = last_sample + 1 - self.window_revolutions * self._samples_per_revolution
        if self._clipped_before > first_sample:
            status |= Status.CLIPPED
        harmonics = self._harmonics.harmonics()
        amplitude = harmonics.amplitude(1.0)
        if amplitude == 0.0 or amplitude < self.noise_floor_m_s2:
            status |= Status.BELOW_NOISE
            return self._unknown(last_sample, excitation_hz, status, amplitude)
        values = evaluate(harmonics)
        period = None if Status.FREQUENCY_CHANGING in status else self._period.period()
        lifting = None
        if period is not None:
            lifting = lifts(self._period.repetitions(period), self._samples_per_revolution)
        return MeterValue(
            last_sample=last_sample,
            window_revolutions=self.window_revolutions,
            cmv=values["cmv"],
            rmv=values["rmv"],
            excitation_frequency=excitation_hz,
            fundamental_amplitude=amplitude,
            fundamental_phase=harmonics.phase(1.0),
            period=period or 0,
            mode=metered_mode(lifting, period),
            status=status,
            further=self._further(values, status, excitation_hz),
        )

    def _further(
        self, values: Mapping[str, float], status: Status, excitation_hz: float
    ) -> dict[str, float]:
        """Return all values beside CMV and RMV."""
        known = dict(values)
        steady = Status.FREQUENCY_CHANGING not in status and _steady(self._amplitudes)
        if self._drum is not None and steady:
            motion = DrumMotion(
                self._period.repetitions(NO_PERIOD).ravel(),
                self._drum,
                amplitude_m=float(self._amplitudes[0]),
                frequency_hz=excitation_hz,
                phase_rad=self._phase_rad,
                samples_per_revolution=self._samples_per_revolution,
            )
            known.update((name, float(value)) for name, value in evaluate_drum(motion).items())
        return {name: known.get(name, math.nan) for name in _unknown_further()}

    def _unknown(
        self, last_sample: int, excitation_hz: float, status: Status, amplitude: float = math.nan
    ) -> MeterValue:
        return MeterValue(
            last_sample=last_sample,
            window_revolutions=self.window_revolutions,
            cmv=math.nan,
            rmv=math.nan,
            excitation_frequency=excitation_hz,
            fundamental_amplitude=amplitude,
            fundamental_phase=math.nan,
            period=0,
            mode=Mode.UNKNOWN,
            status=status,
        )

    def _push(self, revolution: Revolution) -> None:
        """Add a revolution; one whose phase does not follow from the last begins a new window."""
        turn = 2.0 * math.pi
        apart = (revolution.phase_rad - self._phase_rad) % turn
        if min(apart, turn - apart) > SAME_PHASE_SAMPLES * turn / self._samples_per_revolution:
            self._clear()
        self._phase_rad = revolution.phase_rad
        index = revolution.first_sample // self._samples_per_revolution
        samples = revolution.samples[0]
        self._harmonics.push(samples, index, revolution.phase_rad)
        self._period.push(samples)
        self._frequencies[index % self.window_revolutions] = revolution.excitation_hz
        self._amplitudes[index % self.window_revolutions] = self._amplitude_m

    def _clear(self) -> None:
        self._harmonics.clear()
        self._period.clear()


def _steady(values: NDArray[np.float64]) -> bool:
    """Whether the values of a window are all known and the same."""
    highest = values.max()
    return bool(highest - values.min() <= STEADY * highest)
