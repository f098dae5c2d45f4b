# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a bag says: gaps, meter values computed anew and compared, plot and CSV; without ROS."""
