# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Controllers in the loop: each a law that needs no ROS, and the same law as a ROS 2 node of its own."""
