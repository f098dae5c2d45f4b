# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Traces in MCAP, as rosbag2 has them: writing, recording in a process of its own, reading, recovering.

The modules are imported one by one, so that the recording process loads only what it needs.
"""
