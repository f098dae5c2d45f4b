# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Why a benchmark gave no figures."""

from __future__ import annotations


class BenchmarkError(Exception):
    """What is missing or differs, in one line."""
