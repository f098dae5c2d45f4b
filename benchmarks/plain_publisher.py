# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m benchmarks.plain_publisher TOPIC`: publishes one empty block as soon as it can, until it is interrupted.

How soon any Python node is heard on this machine; the roller's start is compared with it.
"""

from __future__ import annotations

import sys
import time

import rclpy
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions

from benchmarks.interrupts import Interrupted
from roller_sim_ros.msg import DrumAcceleration


def main() -> None:
    interrupted = Interrupted()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("benchmark_publisher")
    publisher = node.create_publisher(DrumAcceleration, sys.argv[1], QoSProfile(depth=10))
    message = DrumAcceleration()
    while not interrupted:
        publisher.publish(message)
        time.sleep(5e-3)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
