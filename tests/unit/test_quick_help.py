# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The help of a command needs none of the libraries that take long to import."""

import subprocess
import sys

import pytest

from roller_sim_ros.commands import COMMANDS

SLOW = ("numba", "scipy", "matplotlib", "xarray", "rclpy", "hypothesis")

PROGRAM = f"""
import sys
from roller_sim_ros.commands import main
try:
    main([sys.argv[1], "--help"])
except SystemExit:
    pass
print([name for name in {SLOW!r} if name in sys.modules], file=sys.stderr)
"""


@pytest.mark.parametrize("command", COMMANDS)
def test_help_imports_nothing_slow(command: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, command], capture_output=True, text=True, check=True
    )
    assert f"usage: roller-sim {command}" in done.stdout
    assert done.stderr.strip() == "[]"
