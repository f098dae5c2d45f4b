# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plan of the next 128 samples: frequency, sample period, phase and force amplitude.

Frequency and sample period change only every 128 samples, at eccentric phase zero; the force amplitude is
interpolated across the revolution, so that neither component of the force steps. Below the sampling floor the
sample period stays and the phase advances more slowly; on the way up through the floor the eccentric slips a little,
within the rate limit, until a multiple of 128 samples falls on phase zero again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Exciter

TWO_PI = 2.0 * math.pi


@dataclass(frozen=True)
class Revolution:
    """128 samples (or as many as a revolution is told to have) with everything constant but the amplitude.

    Attributes
    ----------
    frequency_hz, sample_period_s, phase_rad, phase_increment_rad : float
        Excitation frequency, time and phase from sample to sample, phase at the first sample.
    amplitude_m : float
        Nominal amplitude A at the end of the revolution.
    start_acceleration, end_acceleration : float
        F_e/m_d = A ω² at the first sample and at the first one of the next revolution, m/s².
    changing : bool
        Whether frequency or amplitude differ from the previous revolution's.
    """

    frequency_hz: float
    sample_period_s: float
    phase_rad: float
    phase_increment_rad: float
    amplitude_m: float
    start_acceleration: float
    end_acceleration: float
    changing: bool

    @property
    def omega(self) -> float:
        """Angular frequency of the eccentric, rad/s."""
        return self.phase_increment_rad / self.sample_period_s


@dataclass(frozen=True)
class DriveFault:
    """What keeps a drive from obeying.

    Attributes
    ----------
    amplitude_m : float or None
        Where the amplitude stays whatever is commanded; None: it obeys.
    rate_factor : float
        Of both rate limits.
    frequency_loss_hz : float
        By how much the frequency stays below the commanded one.
    """

    amplitude_m: float | None = None
    rate_factor: float = 1.0
    frequency_loss_hz: float = 0.0


class ExciterDrive:
    """Follows the commands with a rate limit and plans revolution after revolution.

    Parameters
    ----------
    exciter : Exciter
        Start command and rate limits.
    floor_hz : float
        Sampling floor.
    run_up : bool
        Start from standstill; otherwise at once at full frequency and amplitude.
    samples : int
        Samples per revolution.

    Attributes
    ----------
    target_frequency_hz, target_amplitude_m : float
        What is commanded.
    frequency_rate_hz_per_s, amplitude_rate_m_per_s : float
        Rate limits.
    frequency_hz, amplitude_m : float
        At the end of the last planned revolution.
    fault : DriveFault or None
        What keeps it from obeying.
    """

    def __init__(
        self,
        exciter: Exciter,
        floor_hz: float,
        *,
        run_up: bool,
        samples: int = SAMPLES_PER_REVOLUTION,
    ) -> None:
        self._floor_hz = floor_hz
        self._samples = samples
        self.target_frequency_hz = exciter.frequency_hz if exciter.vibrate else 0.0
        self.target_amplitude_m = exciter.amplitude_m
        self.frequency_rate_hz_per_s = exciter.frequency_rate_hz_per_s
        self.amplitude_rate_m_per_s = exciter.amplitude_rate_m_per_s
        self.frequency_hz = 0.0 if run_up else self.target_frequency_hz
        self.amplitude_m = 0.0 if run_up else self.target_amplitude_m
        self.fault: DriveFault | None = None
        self._phase_turns = 0.0
        self._last: Revolution | None = None
        self._acceleration = self._full_acceleration()

    def next_revolution(self) -> Revolution:
        """Plan the next revolution and move on to its end; the same object as before where nothing changes."""
        target_hz, target_m, rate_factor = self._obeyed()
        before = (self.frequency_hz, self.amplitude_m)
        last = self._last
        if (
            last is not None
            and not last.changing
            and last.start_acceleration == last.end_acceleration
            and before == (target_hz, target_m)
            and target_hz >= self._floor_hz
        ):
            return last
        duration_s = 1.0 / max(self.frequency_hz, self._floor_hz)
        self.frequency_hz = self._next_frequency(
            target_hz, self.frequency_rate_hz_per_s * rate_factor * duration_s
        )
        self.amplitude_m = _towards(
            self.amplitude_m, target_m, self.amplitude_rate_m_per_s * rate_factor * duration_s
        )
        sample_period_s = 1.0 / (self._samples * max(self.frequency_hz, self._floor_hz))
        start_turns = self._phase_turns
        if self.frequency_hz >= self._floor_hz:
            increment_rad = TWO_PI / self._samples
        else:
            turns = self.frequency_hz / self._floor_hz
            increment_rad = TWO_PI * turns / self._samples
            end = (start_turns + turns) % 1.0
            # What is a rounding error away from phase zero is phase zero.
            self._phase_turns = 0.0 if min(end, 1.0 - end) < 1e-9 else end
        start_acceleration = self._acceleration
        self._acceleration = self._full_acceleration()
        self._last = Revolution(
            frequency_hz=self.frequency_hz,
            sample_period_s=sample_period_s,
            phase_rad=TWO_PI * start_turns,
            phase_increment_rad=increment_rad,
            amplitude_m=self.amplitude_m,
            start_acceleration=start_acceleration,
            end_acceleration=self._acceleration,
            changing=before != (self.frequency_hz, self.amplitude_m),
        )
        return self._last

    def _obeyed(self) -> tuple[float, float, float]:
        """Return frequency and amplitude that the drive goes for, and the factor of its rates."""
        fault = self.fault
        if fault is None:
            return self.target_frequency_hz, self.target_amplitude_m, 1.0
        return (
            max(0.0, self.target_frequency_hz - fault.frequency_loss_hz),
            self.target_amplitude_m if fault.amplitude_m is None else fault.amplitude_m,
            fault.rate_factor,
        )

    def _next_frequency(self, target_hz: float, most_hz: float) -> float:
        floor = self._floor_hz
        free = _towards(self.frequency_hz, target_hz, most_hz)
        if target_hz < floor or (free >= floor and self._phase_turns == 0.0):
            return free
        aligned = self._aligned_run_up(most_hz)
        if aligned is not None:
            return aligned
        if free < floor:
            return free
        # Out of step with the multiples of 128 samples and too near the floor to plan: run just below it, within
        # one step of the rate limit, until the slip has added up to a whole turn.
        revolutions = max(1, math.ceil(self._phase_turns * floor / most_hz - 1e-9))
        return floor * (1.0 - self._phase_turns / revolutions)

    def _aligned_run_up(self, most_hz: float) -> float | None:
        """Return the highest next frequency from which a steady run-up meets the floor at phase zero."""
        floor = self._floor_hz
        lowest = max(0.0, self.frequency_hz - most_hz)
        highest = min(floor, self.frequency_hz + most_hz)
        fewest = max(1, math.ceil((floor - highest) / most_hz))
        for revolutions in range(fewest, fewest + 4):
            # Frequencies s, s + most, …: `revolutions` of them below the floor, the next one not.
            low = max(lowest, floor - revolutions * most_hz)
            high = min(highest, floor - (revolutions - 1) * most_hz)
            ramp = most_hz * revolutions * (revolutions - 1) / 2.0
            # The small number keeps a plan that is being followed from being missed by a rounding error.
            turns = math.floor((revolutions * high + ramp) / floor + self._phase_turns + 1e-9)
            start = min(high, ((turns - self._phase_turns) * floor - ramp) / revolutions)
            if low <= start < floor:
                return start
        return None

    def _full_acceleration(self) -> float:
        return self.amplitude_m * (TWO_PI * self.frequency_hz) ** 2


def _towards(value: float, target: float, most: float) -> float:
    return target if abs(target - value) <= most else value + math.copysign(most, target - value)
