# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A test of a compaction meter: the roller stands until the test steps it, and gives the same samples every time."""

import sys
from pathlib import Path

import pytest
from std_msgs.msg import Float64

pytest_plugins = ["roller_sim_ros.testing"]

METER = (sys.executable, str(Path(__file__).with_name("meter_client.py")))


def step(roller):
    """Go on by a revolution; time stands still until the meter has answered."""
    answers = len(roller.received("my_cmv"))
    roller.step(revolutions=1)
    roller.wait_for(lambda: len(roller.received("my_cmv")) > answers, "the meter")


def test_my_meter_says_what_is_true(roller):
    """The drum double-jumps at 1.6 mm, which halves CMV, and not at 0.8 mm."""
    roller.listen("my_cmv", Float64)
    roller.start("my_meter", *METER)
    roller.wait_for(lambda: roller.node.count_publishers("my_cmv"), "the meter")
    while not roller.received("my_cmv"):  # the exciter runs up, then a window fills
        roller.step(revolutions=1)
    for amplitude_m in (1.6e-3, 0.8e-3):
        roller.command(frequency_hz=28.0, amplitude_m=amplitude_m)
        for _ in range(40):
            step(roller)
        assert roller.last("my_cmv").data == pytest.approx(roller.last("truth").cmv, rel=0.01)
