# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Long runs: whether a sample is lost, memory grows, or time drifts."""
