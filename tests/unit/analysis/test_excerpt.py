# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The excerpt: the last settled revolutions, an even number, safe from what comes after."""

from __future__ import annotations

import numpy as np
import pytest

from roller_sim_ros.analysis.excerpt import ExcerptKeeper

N = 128


def keeper(revolutions: int, *, truth: bool = True) -> ExcerptKeeper:
    kept = ExcerptKeeper(N)
    for first in range(0, revolutions * N, 16):
        samples = np.arange(first, first + 16, dtype=float)
        kept.acceleration.write(first, np.stack([samples, -samples]))
        if truth:
            kept.truth.write(first, np.stack([samples, samples / 2, samples % 3]))
    return kept


@pytest.mark.parametrize(
    ("settled", "revolutions"), [(2, 2), (17, 16), (64, 64), (65, 64), (1000, 64)]
)
def test_it_is_even_and_no_longer_than_what_is_settled(settled: int, revolutions: int) -> None:
    kept = keeper(90)
    kept.settled(90 * N - 1, settled, 28.0)
    excerpt = kept.excerpt()
    assert excerpt is not None
    assert excerpt.revolutions == revolutions
    assert excerpt.first_sample == (90 - revolutions) * N
    assert excerpt.vertical.tolist() == list(range(excerpt.first_sample, 90 * N))
    assert excerpt.soil_force is not None
    assert np.array_equal(excerpt.soil_force, excerpt.vertical)
    assert excerpt.contact_state is not None
    assert excerpt.contact_state.dtype == np.uint8


def test_what_follows_does_not_overwrite_it() -> None:
    kept = keeper(70)
    kept.settled(70 * N - 1, 64, 28.0)
    kept.interrupted()
    kept.acceleration.write(70 * N, np.zeros((2, 100 * N)))
    excerpt = kept.excerpt()
    assert excerpt is not None
    assert excerpt.vertical[-1] == 70 * N - 1


def test_samples_without_truth_and_no_samples_at_all() -> None:
    kept = keeper(20, truth=False)
    kept.settled(20 * N - 1, 16, 28.0)
    excerpt = kept.excerpt()
    assert excerpt is not None
    assert excerpt.soil_force is excerpt.drum_height is excerpt.contact_state is None
    assert ExcerptKeeper(N).excerpt() is None
