# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The README's controller closes the loop; its meter is run in test_play."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from roller_sim_ros.msg import ExciterState

CONTROLLER = Path(__file__).resolve().parents[2] / "examples" / "controller_client.py"


def test_the_jump_guard_lowers_the_amplitude_of_a_jumping_roller(
    start, client, own_domain: int, tmp_path: Path
) -> None:
    states = client.listen("exciter/state", ExciterState)
    quick = ("--ros-args", "-p", "exciter.frequency_rate_hz_per_s:=100.0")
    start("--shear-modulus-mpa", "80", "--plastic-mm", "0.5", *quick)
    client.spin_until(lambda: states and states[-1].frequency == 28.0)
    controller = subprocess.Popen(
        [sys.executable, str(CONTROLLER)],
        env={
            **os.environ,
            "ROS_DOMAIN_ID": str(own_domain),
            "ROS_LOG_DIR": str(tmp_path),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        },
        start_new_session=True,
    )
    try:
        client.spin_until(lambda: states[-1].commanded_amplitude < 1.4e-3)
        client.spin_until(lambda: states[-1].amplitude < 1.4e-3)
    finally:
        controller.terminate()
        controller.wait(10)
    assert states[-1].refusal_reason == ""
