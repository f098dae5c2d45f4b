# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The roller without ROS, as fast as it goes: run, record, sum up, draw."""
