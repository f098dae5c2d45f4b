# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Settings that hold for every test, also when pytest is started without make."""

from __future__ import annotations

import os
import signal
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# rclpy fails at start when its log folder is not writable, and the tests' own messages must stay on
# this machine.
_LOGS = ROOT / "build" / "ros_log"
_LOGS.mkdir(parents=True, exist_ok=True)
os.environ.setdefault("ROS_LOG_DIR", str(_LOGS))
os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")

# What is started in the background of a script ignores SIGINT, and so would the processes that tests interrupt.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
