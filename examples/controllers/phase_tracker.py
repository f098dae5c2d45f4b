# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Phase tracker: keeps the lag of the drum behind the eccentric at a setpoint, by the frequency.

The lag is near 180° for a drum on soft ground, far above its resonance, and 90° at the resonance. Stiffer ground
moves the resonance up and the lag down; a higher frequency brings it up again.

    python -m examples.controllers.phase_tracker --ros-args -p setpoint_deg:=145.0
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from examples.controllers.measurement import Command, Measurement


@dataclass
class PhaseTracker:
    """Integrates the error of the lag into the frequency; the amplitude stays as it was commanded at the start.

    Parameters
    ----------
    setpoint_deg : float
        Lag of the drum's displacement behind the eccentric's force, degrees; above 90.
    gain_hz_per_rad : float
        Change of the frequency in a revolution, per error. The lag follows the frequency by about 0.15 rad/Hz, and the
        meter's window is half a window late: ten times as much would swing.
    tolerance_deg : float
        Error at which the frequency is left alone, so that the meter has steady windows.
    least_hz, most_hz : float
        Range of the frequency, Hz.
    """

    setpoint_deg: float = 140.0
    gain_hz_per_rad: float = 0.2
    tolerance_deg: float = 0.5
    least_hz: float = 18.0
    most_hz: float = 35.0
    _frequency_hz: float = field(default=0.0, init=False)
    _amplitude_m: float = field(default=0.0, init=False)

    def update(self, measurement: Measurement) -> Command:
        """Answer a measurement; while the lag is not known (NaN) all stays as it is."""
        if not self._frequency_hz:
            self._frequency_hz = measurement.commanded_frequency_hz
            self._amplitude_m = measurement.commanded_amplitude_m
        error = math.radians(self.setpoint_deg) - measurement.lag_rad
        if abs(error) > math.radians(self.tolerance_deg):
            wanted_hz = self._frequency_hz + self.gain_hz_per_rad * error
            self._frequency_hz = min(self.most_hz, max(self.least_hz, wanted_hz))
        return Command(self._frequency_hz, self._amplitude_m)


if __name__ == "__main__":
    from examples.controllers.node import spin

    spin("phase_tracker", PhaseTracker)
