# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The exciter: what is commanded, how the drive follows, what force results."""

from roller_sim_ros.exciter.direction import DIRECTIONS, Direction
from roller_sim_ros.exciter.force import exciter_motion
from roller_sim_ros.exciter.revolution import DriveFault, ExciterDrive, Revolution

__all__ = ["DIRECTIONS", "Direction", "DriveFault", "ExciterDrive", "Revolution", "exciter_motion"]
