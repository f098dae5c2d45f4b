# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A roller for tests with pytest: in lock step, in a ROS domain of its own, its trace kept when the test fails.

Name it in ``conftest.py``, or in the test's own file:

>>> pytest_plugins = ["roller_sim_ros.testing"]

and let tests take the fixture ``roller``, or ``start_roller`` for one with arguments: docs/testing.md. Without pytest
the class does the same: ``with Roller(folder) as roller``.
"""

from roller_sim_ros.testing.plugin import (
    pytest_addoption,
    pytest_runtest_makereport,
    pytest_terminal_summary,
    roller,
    start_roller,
)
from roller_sim_ros.testing.roller import Roller, RollerEnded

__all__ = [
    "Roller",
    "RollerEnded",
    "pytest_addoption",
    "pytest_runtest_makereport",
    "pytest_terminal_summary",
    "roller",
    "start_roller",
]
