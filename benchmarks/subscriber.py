# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m benchmarks.subscriber TOPIC`: a client of the roller as one would write it, until it is interrupted."""

from __future__ import annotations

import json
import sys
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions

from benchmarks.interrupts import Interrupted
from roller_sim_ros.msg import DrumAcceleration

DEPTH = 1000


def main() -> None:
    interrupted = Interrupted()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("benchmark_subscriber")
    blocks: list[tuple[int, int]] = []
    first_ns: list[int] = []

    def note(message: DrumAcceleration) -> None:
        if not blocks:
            first_ns.append(time.time_ns())
            print("first", flush=True)
        blocks.append((message.sequence, len(message.vertical)))

    node.create_subscription(DrumAcceleration, sys.argv[1], note, QoSProfile(depth=DEPTH))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print("ready", flush=True)
    while not interrupted:
        executor.spin_once(timeout_sec=0.1)
    samples = sum(length for _, length in blocks)
    span = blocks[-1][0] + blocks[-1][1] - blocks[0][0] if blocks else 0
    print(
        json.dumps(
            {
                "samples": samples,
                "lost": span - samples,
                "first_ns": first_ns[0] if first_ns else None,
            }
        )
    )
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
