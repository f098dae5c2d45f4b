# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Benchmarks: what the package costs, beside something that does the same on the same machine in the same run.

`python -m benchmarks` (or `make bench`) runs them; a new one is one file with a function that returns a `Table`, and
one line in `registry`. Nothing is asserted about times: machines are shared and noisy.
"""
