# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Force limiter: holds the greatest force on the ground, over the static load, at a limit, by the amplitude.

The force is not measured, it follows from the drum's equation of motion: F_s = m_d (z'' + A ω² (−sin φ)) + F_stat, with
the measured acceleration z'', the eccentric's phase φ, the exciter's amplitude A and the masses, which are known.

    python -m examples.controllers.force_limiter --ros-args -p limit:=2.5 -p machine:=paper-10t
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from examples.controllers.measurement import Command, Measurement, N
from roller_sim_ros.soil_mechanics import machine_preset

RECENT = 4
"""Revolutions over which the greatest force is taken: an even number, for a drum in double jump."""


@dataclass
class ForceLimiter:
    """Steers the amplitude by the ratio of limit and force, and never above what was commanded at the start.

    Parameters
    ----------
    limit : float
        Of F_max/F_stat.
    fall, rise : float
        Exponents of the ratio, for one revolution, when the force is too high and when it is not: down fast, up slowly.
    least_m : float
        Amplitude below which it is not lowered, m.
    machine : str
        Name of the roller's preset, for its masses.
    """

    limit: float = 3.0
    fall: float = 0.1
    rise: float = 0.02
    least_m: float = 0.2e-3
    machine: str = "paper-10t"
    _amplitude_m: float = field(default=0.0, init=False)
    _most_m: float = field(default=0.0, init=False)
    _frequency_hz: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        machine = machine_preset(self.machine).machine
        self._drum_kg, self._static_n = machine.drum_mass_kg, machine.static_load_n

    def update(self, measurement: Measurement) -> Command:
        """Answer a measurement; while there are too few samples all stays as it is."""
        if not self._most_m:
            self._amplitude_m = self._most_m = measurement.commanded_amplitude_m
            self._frequency_hz = measurement.commanded_frequency_hz
        if len(measurement.vertical) >= RECENT:
            ratio = self.limit / self.force_ratio(measurement)
            wanted_m = self._amplitude_m * ratio ** (self.fall if ratio < 1.0 else self.rise)
            least_m = min(self.least_m, self._most_m)
            self._amplitude_m = min(self._most_m, max(least_m, wanted_m))
        return Command(self._frequency_hz, self._amplitude_m)

    def force_ratio(self, measurement: Measurement) -> float:
        """Return F_max/F_stat of the last revolutions.

        The mean of the acceleration is a bias, or gravity where the sensor reads specific force: the drum goes nowhere.
        """
        vertical = measurement.vertical[-RECENT:]
        phase = measurement.phase_rad + 2.0 * np.pi * np.arange(N) / N
        eccentric = (
            measurement.amplitude_m * (2.0 * np.pi * measurement.frequency_hz) ** 2 * np.sin(phase)
        )
        force = self._drum_kg * (vertical - vertical.mean() - eccentric) + self._static_n
        return float(force.max()) / self._static_n


if __name__ == "__main__":
    from examples.controllers.node import spin

    spin("force_limiter", ForceLimiter)
