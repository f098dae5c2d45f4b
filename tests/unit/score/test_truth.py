# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The truth of a trace, and the faults in it, revolution by revolution."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.faults.fault import Behaviour
from roller_sim_ros.score.truth import TruthReader, sound

PERIOD_S = 1.0 / (28.0 * 128)


def truth(sequence: int, count: int = 16, hz: float = 28.0) -> Any:
    stamp_ns = round(sequence * PERIOD_S * 1e9)
    return SimpleNamespace(
        header=SimpleNamespace(
            stamp=SimpleNamespace(sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
        ),
        sequence=sequence,
        sample_period=PERIOD_S,
        excitation_frequency=hz,
        soil_force=np.zeros(count),
        cmv=40.0 + sequence // 128,
        rmv=1.0,
    )


def faults(sample: int, *active: tuple[int, str, int]) -> Any:
    return SimpleNamespace(
        sample=sample,
        faults=[
            SimpleNamespace(
                handle=handle,
                id=name,
                since_sample=since,
                expected=1,
                tolerance_percent=0.0,
                within_revolutions=3,
            )
            for handle, name, since in active
        ],
    )


@pytest.mark.parametrize("size", [16, 128])
def test_a_revolution_is_told_by_the_block_that_ends_it(size: int) -> None:
    reader = TruthReader()
    for first in range(0, 10 * 128, size):
        reader.on_truth(truth(first, size), first)
    found = reader.truth()
    assert found.last_sample.tolist() == [128 * (number + 1) - 1 for number in range(10)]
    assert found.cmv.tolist() == [40.0 + number for number in range(10)]
    assert found.stamp_ns[3] == pytest.approx((4 * 128 - 1) * PERIOD_S * 1e9, abs=2)
    assert found.period_s == pytest.approx(1.0 / 28.0, rel=1e-6)


def test_a_frequency_is_steady_when_the_whole_window_has_it() -> None:
    reader = TruthReader()
    for number in range(20):
        reader.on_truth(truth(128 * number, 128, 28.0 if number < 8 else 30.0), number)
    steady = reader.truth().steady(4)
    assert np.flatnonzero(~steady).tolist() == [8, 9, 10]


def test_faults_begin_and_end_with_revolutions_of_the_trace() -> None:
    reader = TruthReader()
    reader.on_faults(faults(0))
    # The trace begins with the sixth revolution, in which a fault is active already.
    reader.on_faults(faults(5 * 128, (1, "stuck", 3 * 128)))
    for number in range(5, 30):
        reader.on_truth(truth(128 * number, 128), number)
    reader.on_faults(faults(10 * 128, (1, "stuck", 3 * 128), (2, "spike", 10 * 128)))
    reader.on_faults(faults(12 * 128, (2, "spike", 10 * 128)))
    windows = reader.windows()
    assert [(item.id, item.begin, item.end) for item in windows] == [
        ("stuck", 0, 7),
        ("spike", 5, 25),
    ]
    assert windows[0].expected.behaviour is Behaviour.FLAGGED
    assert windows[0].expected.within_revolutions == 3
    assert np.flatnonzero(sound(windows[:1], 25, 2)).tolist() == list(range(9, 25))


def test_a_second_run_in_the_same_trace_is_refused() -> None:
    reader = TruthReader()
    for number in range(4):
        reader.on_truth(truth(128 * number, 128), number)
    with pytest.raises(
        BagError, match="begins anew at sample 0 after sample 511: the trace holds more"
    ):
        reader.on_truth(truth(0, 128), 5)
