# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Results of a session as ROS messages in CDR, without ROS: the same bytes are published and recorded."""
