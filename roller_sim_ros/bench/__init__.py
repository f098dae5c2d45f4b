# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Scenario, meter under test and verdict in one go: node and meter as processes in a ROS domain of their own."""
