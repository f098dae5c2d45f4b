# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The roller as a functional mock-up unit (FMI 2.0, co-simulation)."""
