# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Gaps, duplicates and order, against a model that keeps every sample."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.analysis.continuity import REMEMBERED_GAPS, Continuity

REACH = 2048


def counts(blocks: list[tuple[int, int]], reach: int = REACH) -> Continuity:
    found = Continuity(reach)
    for first, count in blocks:
        found.feed(first, count)
    return found


def test_whole_stream() -> None:
    found = counts([(first, 16) for first in range(160, 1600, 16)])
    assert (found.samples, found.blocks, found.gaps, found.missing) == (1440, 90, 0, 0)
    assert (found.duplicates, found.out_of_order, found.restarts) == (0, 0, 0)


def test_a_lost_block_is_a_gap_and_neighbours_that_are_lost_are_one() -> None:
    found = counts([(0, 16), (32, 16), (96, 16)])
    assert (found.gaps, found.missing) == (2, 16 + 48)


def test_a_late_block_fills_its_gap() -> None:
    found = counts([(0, 16), (32, 16), (16, 16), (48, 16)])
    assert (found.gaps, found.missing, found.out_of_order, found.duplicates) == (0, 0, 1, 0)
    assert found.samples == 64


def test_a_late_block_can_leave_two_gaps() -> None:
    found = counts([(0, 16), (96, 16), (48, 16)])
    assert (found.gaps, found.missing, found.out_of_order) == (2, 64, 1)


def test_a_repeated_block_is_a_duplicate() -> None:
    found = counts([(0, 16), (0, 16), (16, 16), (0, 16)])
    assert (found.duplicates, found.gaps, found.samples) == (2, 0, 32)


def test_a_restart_is_no_duplicate_and_keeps_the_gaps_that_were_there() -> None:
    blocks = [(first, 16) for first in range(0, 4096, 16) if first != 800]
    found = counts(blocks + [(first, 16) for first in range(0, 320, 16)])
    assert (found.restarts, found.duplicates, found.out_of_order) == (1, 0, 0)
    assert (found.gaps, found.missing) == (1, 16)
    assert found.samples == 4096 - 16 + 320


def test_memory_for_gaps_is_bounded_and_none_is_forgotten() -> None:
    many = 3 * REMEMBERED_GAPS
    found = counts([(32 * index, 16) for index in range(many + 1)])
    assert found.gaps == many
    assert found.missing == 16 * many


@settings(max_examples=200)
@given(st.lists(st.tuples(st.integers(0, 40), st.integers(1, 6)), min_size=1, max_size=30))
def test_counts_are_those_of_a_set_of_samples(blocks: list[tuple[int, int]]) -> None:
    found = counts(blocks)
    start = blocks[0][0]
    seen: set[int] = set()
    late = doubled = 0
    for first, count in blocks:
        samples = {sample for sample in range(first, first + count) if sample >= start}
        new = samples - seen
        late += bool(seen) and any(sample < max(seen) for sample in new)
        doubled += not new
        seen |= new
    assert found.samples == len(seen)
    assert found.missing == max(seen, default=start - 1) + 1 - start - len(seen)
    assert found.duplicates == doubled
    assert found.out_of_order == late


def test_gap_needs_a_first_block() -> None:
    assert Continuity(REACH).gaps == 0
    assert counts([(10**12, 16)]).gaps == 0


@pytest.mark.parametrize("behind", [1, REACH])
def test_reach_tells_late_from_restarted(behind: int) -> None:
    end = 10 * REACH
    assert counts([(0, end), (end - behind, 1)]).restarts == 0
    assert counts([(0, end), (end - REACH - 1, 1)]).restarts == 1
