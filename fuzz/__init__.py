# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Hostile input: what a roller must survive, and what it must say then."""
