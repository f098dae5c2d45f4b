# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Recorded and computed values find each other, in any order."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from roller_sim_ros.analysis.comparison import REMEMBERED, Comparison, Matcher
from roller_sim_ros.analysis.recent import RecentSamples


def values(cmv: float, mode: int = 2) -> dict[str, float]:
    return {"cmv": cmv, "mode": mode}


def test_largest_difference_and_disagreements() -> None:
    matcher = Matcher(Comparison())
    for sample, (recorded, computed) in enumerate([(40.0, 40.0), (41.0, 40.75), (50.0, 50.5)]):
        matcher.computed(sample, sample, values(computed), window_whole=True)
        matcher.recorded(sample, values(recorded, mode=3 if sample == 1 else 2))
    found = matcher.comparison
    assert found.pairs == 3
    assert found.differences["cmv"].largest == 0.5
    assert found.disagreements == {"mode": 1}


def test_unknown_on_one_side_is_counted_and_not_subtracted() -> None:
    matcher = Matcher(Comparison())
    for sample, (recorded, computed) in enumerate([(math.nan, math.nan), (40.0, math.nan)]):
        matcher.computed(sample, sample, values(computed), window_whole=True)
        matcher.recorded(sample, values(recorded))
    found = matcher.comparison.differences["cmv"]
    assert math.isnan(found.largest)
    assert (found.compared, found.one_unknown) == (0, 1)


def test_window_that_the_bag_lacks_is_no_disagreement() -> None:
    matcher = Matcher(Comparison())
    matcher.computed(127, 0, values(math.nan), window_whole=False)
    matcher.recorded(127, values(40.0))
    matcher.computed(255, 1, values(math.nan), window_whole=False)
    matcher.recorded(255, values(math.nan))
    assert matcher.comparison.window_incomplete == 1
    assert matcher.comparison.pairs == 1


def test_what_finds_no_counterpart_is_counted_and_memory_is_bounded() -> None:
    matcher = Matcher(Comparison())
    for sample in range(2 * REMEMBERED):
        matcher.recorded(sample, values(1.0))
    matcher.recorded(2 * REMEMBERED - 1, values(1.0))
    matcher.finish()
    assert matcher.comparison.unmatched == 2 * REMEMBERED + 1
    assert matcher.comparison.pairs == 0


@given(st.permutations([(side, sample) for side in "rc" for sample in range(6)]))
def test_order_of_arrival_does_not_matter(events: list[tuple[str, int]]) -> None:
    matcher = Matcher(Comparison())
    rows = {}
    for side, sample in events:
        if side == "r":
            found = matcher.recorded(sample, values(float(sample)))
        else:
            found = matcher.computed(sample, 100 + sample, values(sample + 0.25), window_whole=True)
        if found is not None:
            rows[found[0]] = found[1]["cmv"]
    matcher.finish()
    assert matcher.comparison.pairs == 6
    assert matcher.comparison.unmatched == 0
    assert matcher.comparison.differences["cmv"].largest == 0.25
    assert rows == {100 + sample: float(sample) for sample in range(6)}


def test_recent_samples_are_found_by_index_until_they_are_overwritten() -> None:
    ring = RecentSamples(2, 100)
    assert ring.read(0, 10) is None
    ring.write(1000, np.arange(20.0).reshape(2, 10))
    ring.write(1010, np.arange(20.0, 40.0).reshape(2, 10))
    found = ring.read(1005, 10)
    assert found is not None
    assert found.tolist() == [
        [5, 6, 7, 8, 9, 20, 21, 22, 23, 24],
        [15, 16, 17, 18, 19, 30, 31, 32, 33, 34],
    ]
    assert ring.read(1015, 10) is None
    assert ring.read(-5, 3) is None
    assert ring.read(1000, 101) is None
    ring.write(1100, np.zeros((2, 10)))
    assert ring.read(1000, 10) is None
    assert ring.read(1010, 10) is not None


def test_block_longer_than_the_ring_leaves_its_end() -> None:
    ring = RecentSamples(1, 8)
    ring.write(0, np.arange(20.0).reshape(1, 20))
    found = ring.read(12, 8)
    assert found is not None
    assert found[0].tolist() == list(range(12, 20))
