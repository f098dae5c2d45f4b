# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Jump guard: less amplitude when RMV rises, slowly more again when it has stayed low.

RMV rises before the drum jumps. A perturbation of every second revolution, which dies out fast on soft ground,
lives longer and longer towards the double jump: RMV, some hundredths before, doubles every ten revolutions. So the
amplitude is cut at an RMV that is far from a jump, by a whole step, and the meter is not believed until its window
holds nothing of the old motion. Smaller steps at every revolution would not do: a ramp shows in RMV too.

    python -m examples.controllers.jump_guard --ros-args -p threshold:=2.0
"""

from __future__ import annotations

from dataclasses import dataclass, field

from examples.controllers.measurement import Command, Measurement


@dataclass
class JumpGuard:
    """Keeps the amplitude just below the double jump, and never above what was commanded at the start.

    Parameters
    ----------
    threshold : float
        RMV above which the amplitude is cut. The motion is called a double jump from about 2 on.
    cut : float
        Share by which it is cut.
    wait_revolutions : int
        For how long a cut is not followed by another: the meter's window and the exciter's ramp.
    quiet_revolutions : int
        How long after a cut the amplitude begins to rise again.
    rise : float
        Share by which it rises in a revolution while RMV is low.
    least_m : float
        Amplitude below which it is not cut, m.
    """

    threshold: float = 1.0
    cut: float = 0.15
    wait_revolutions: int = 20
    quiet_revolutions: int = 64
    rise: float = 5e-4
    least_m: float = 0.4e-3
    _amplitude_m: float = field(default=0.0, init=False)
    _most_m: float = field(default=0.0, init=False)
    _frequency_hz: float = field(default=0.0, init=False)
    _since_cut: int = field(default=0, init=False)

    def update(self, measurement: Measurement) -> Command:
        """Answer a measurement; RMV that is not known (NaN) is neither high nor low."""
        if not self._most_m:
            self._amplitude_m = self._most_m = measurement.commanded_amplitude_m
            self._frequency_hz = measurement.commanded_frequency_hz
            self._since_cut = self.quiet_revolutions
        self._since_cut += 1
        if measurement.rmv > self.threshold:
            if self._since_cut > self.wait_revolutions:
                least_m = min(self.least_m, self._amplitude_m)
                self._amplitude_m = max(least_m, (1.0 - self.cut) * self._amplitude_m)
                self._since_cut = 0
        elif measurement.rmv <= self.threshold and self._since_cut > self.quiet_revolutions:
            self._amplitude_m = min(self._most_m, (1.0 + self.rise) * self._amplitude_m)
        return Command(self._frequency_hz, self._amplitude_m)


if __name__ == "__main__":
    from examples.controllers.node import spin

    spin("jump_guard", JumpGuard)
