# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A compaction meter in a few lines: CMV from drum/acceleration, over 16 revolutions, published as my_cmv.

Replace what `evaluate` does by your own meter; run it beside ``roller-sim sim`` or ``roller-sim play TRACE``.
"""

from contextlib import suppress

import numpy as np
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64

from roller_sim_ros.msg import DrumAcceleration

N = 128


class Meter(Node):
    """Takes blocks of samples and evaluates the last 16 revolutions at the end of each."""

    def __init__(self) -> None:
        super().__init__("my_meter")
        self.window, self.following = np.zeros(0), -1
        self.output = self.create_publisher(Float64, "my_cmv", 40)
        self.create_subscription(DrumAcceleration, "drum/acceleration", self.take, 1600)

    def take(self, block: DrumAcceleration) -> None:
        """Add a block; begin anew after a gap, a clipped sample, and where N samples are no revolution."""
        whole = block.phase_increment > 2 * np.pi / N - 1e-9
        if block.sequence != self.following or block.clipped or not whole:
            self.window = np.zeros(0)
        self.window = np.append(self.window, block.vertical)[-16 * N :]
        self.following = block.sequence + len(block.vertical)
        if self.following % N == 0 and len(self.window) == 16 * N:
            self.evaluate()

    def evaluate(self) -> None:
        """Publish CMV of the window: bin 16 of its DFT is the excitation, bin 32 twice that."""
        amplitudes = np.abs(np.fft.rfft(self.window))
        cmv = 300.0 * amplitudes[32] / amplitudes[16]
        print(self.following - 1, cmv, flush=True)
        self.output.publish(Float64(data=cmv))


if __name__ == "__main__":
    rclpy.init()
    with suppress(KeyboardInterrupt, ExternalShutdownException):
        rclpy.spin(Meter())
