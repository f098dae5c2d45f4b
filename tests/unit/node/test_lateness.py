# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

from __future__ import annotations

import math
import random

import pytest

from roller_sim_ros.node.lateness import Lateness

BLOCK_S = 4e-3


def test_without_blocks_nothing_is_known():
    lateness = Lateness()
    for summary in (lateness.recent(), lateness.total()):
        assert summary.blocks == summary.late == 0
        assert math.isnan(summary.p50_s)
        assert math.isnan(summary.max_s)


def test_recent_is_exact_and_forgets_total_is_binned_and_does_not():
    random_numbers = random.Random(7)
    times = [random_numbers.lognormvariate(math.log(1e-4), 1.5) for _ in range(20_000)]
    lateness = Lateness()
    for time_s in times:
        lateness.note(time_s, BLOCK_S)
    recent, total = lateness.recent(), lateness.total()
    late = sum(time_s > BLOCK_S for time_s in times)
    assert recent.blocks == total.blocks == len(times)
    assert recent.late == total.late == late > 0
    assert recent.max_s == total.max_s == max(times)
    ordered = sorted(times)
    for share, name in ((0.5, "p50_s"), (0.99, "p99_s"), (0.999, "p999_s")):
        exact = ordered[int(share * len(times))]
        assert getattr(recent, name) == exact
        assert exact <= getattr(total, name) <= 1.05 * exact

    lateness.note(2e-3, BLOCK_S)
    assert lateness.recent().blocks == 1
    assert lateness.total().blocks == len(times) + 1


@pytest.mark.parametrize("time_s", [-1e-5, 0.0, 1e-9, 1e4])
def test_no_value_is_out_of_the_bins(time_s):
    lateness = Lateness()
    lateness.note(time_s, BLOCK_S)
    assert lateness.total().blocks == 1
    assert lateness.total().p50_s <= max(time_s, 0.0)
