# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A compaction meter that is wrong on purpose: what a verdict has to find (docs/score.md names the rows).

- Its window is a tenth of a second, no whole number of revolutions, and there is no window function: the excitation
  falls between two bins of its DFT, of which it takes the lower, and leaks into all others, double jump's half order
  most of all. Rows: bias, rms, rms_in_double_jump.
- It shows nothing above 150. Row: ceiling.
- It looks neither at gaps nor at what was clipped. Rows: the faults that have to be flagged.
"""

from contextlib import suppress

import numpy as np
import rclpy
from numpy.typing import NDArray
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64

from roller_sim_ros.msg import DrumAcceleration

N = 128
WINDOW_S = 0.1
HIGHEST = 150.0


def wrong_cmv(samples: NDArray[np.float64], sample_period: float, frequency: float) -> float:
    """Return CMV as nobody should compute it."""
    amplitudes = np.abs(np.fft.rfft(samples))
    bins = frequency * len(samples) * sample_period
    cmv = 300.0 * amplitudes[int(2.0 * bins)] / max(amplitudes[int(bins)], 1e-9)
    return min(HIGHEST, float(cmv))


class WrongMeter(Node):
    """Publishes wrong_cmv once a revolution."""

    def __init__(self) -> None:
        super().__init__("wrong_meter")
        self.window = np.zeros(0)
        self.output = self.create_publisher(Float64, "wrong_cmv", 40)
        self.create_subscription(DrumAcceleration, "drum/acceleration", self.take, 1600)

    def take(self, block: DrumAcceleration) -> None:
        """Add a block, whatever it is."""
        count = round(WINDOW_S / block.sample_period)
        self.window = np.append(self.window, block.vertical)[-count:]
        if (block.sequence + len(block.vertical)) % N == 0 and len(self.window) == count:
            cmv = wrong_cmv(self.window, block.sample_period, block.excitation_frequency)
            self.output.publish(Float64(data=cmv))


if __name__ == "__main__":
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(WrongMeter())
