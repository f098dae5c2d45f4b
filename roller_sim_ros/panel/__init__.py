# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A live page on a roller that runs: an ordinary ROS 2 client with a web server; ROS in ``client`` alone."""
