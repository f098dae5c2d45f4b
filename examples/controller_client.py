# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A jump guard in fifteen lines: less amplitude while the roller double-jumps, slowly more again when it does not."""

import rclpy
from rclpy.node import Node

from roller_sim_ros.msg import CompactionMeter, ExciterCommand


class JumpGuard(Node):
    """Follows the meter's RMV."""

    def __init__(self) -> None:
        super().__init__("jump_guard")
        self.amplitude = 1.6e-3
        self.commands = self.create_publisher(ExciterCommand, "exciter/command", 10)
        self.create_subscription(CompactionMeter, "meter", self.on_meter, 10)

    def on_meter(self, meter: CompactionMeter) -> None:
        """Command an amplitude once a revolution."""
        if meter.rmv > 10.0:  # NaN, as in the first revolutions, is not
            self.amplitude = max(0.4e-3, 0.98 * self.amplitude)
        else:
            self.amplitude = min(1.6e-3, 1.001 * self.amplitude)
        self.commands.publish(
            ExciterCommand(vibrate=True, frequency=28.0, amplitude=self.amplitude)
        )


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(JumpGuard())
