# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The roller on the ROS 2 network; the only part that imports rclpy."""
