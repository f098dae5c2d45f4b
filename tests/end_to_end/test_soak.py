# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The short form of ``make soak``: no sample is lost, time does not drift, memory stays."""

from __future__ import annotations

import math

import pytest

from soak.memory import Memory
from soak.run import HZ, SAMPLES, Result, lock_step, real_time


def silent(_: str) -> None:
    """Say nothing."""


def check(result: Result) -> None:
    assert result.lost == 0
    assert result.acceleration.samples > 0
    assert abs(result.drift_samples) < 1e-3
    assert "0 commands refused" in result.last_words


def test_real_time() -> None:
    result = real_time(4.0, tell=silent)
    check(result)
    assert ", 0 dropped" in result.last_words
    assert result.memory.mb[-1] > 10.0


def test_lock_step() -> None:
    hours = 40.0 / 3600.0
    result = lock_step(hours, tell=silent)
    check(result)
    assert result.truth.samples == result.truth.next_sample == 40 * HZ * SAMPLES
    assert result.acceleration.next_sample == result.truth.next_sample
    # Were a block of samples to stay behind with all its messages, it would be some 8 MB.
    assert result.memory.growth_mb < 6.0


def test_memory_that_grows_is_found() -> None:
    memory = Memory()
    for index in range(101):
        hours = index / 100.0
        memory.add(hours, 100.0 + 3.0 * hours + (20.0 * hours if hours < 0.2 else 4.0))
    assert memory.slope_mb_per_h == pytest.approx(3.0)
    assert memory.growth_mb == pytest.approx(3.0 * 0.75)
    assert memory.quarters() == pytest.approx([100.0, 104.75, 105.5, 106.25, 107.0])
    assert math.isnan(Memory([0.0], [1.0]).slope_mb_per_h)
