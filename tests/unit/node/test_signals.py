# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A signal while the node starts is caught wherever it comes, and the process ends as it wants to."""

from __future__ import annotations

import subprocess
import sys

import pytest

PROGRAM = """
import os, signal
from roller_sim_ros.node.signals import handled

with handled():
    try:
        exec("os.kill(os.getpid(), signal.{name})")
    except KeyboardInterrupt:
        print("caught")
"""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_signal_within_the_exec_of_a_text(name: str) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(name=name)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ended.returncode, ended.stdout) == (0, "caught\n")
