# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Messages find the revolution that they are of, by their stamp or by when they came."""

from __future__ import annotations

import math

import numpy as np

from roller_sim_ros.score.matching import by_log, by_stamp, laid_out
from roller_sim_ros.score.meter_topic import Given
from tests.unit.score.evidence import PERIOD_NS, right

TRUTH = right().truth


def test_a_message_is_of_the_last_revolution_recorded_before_it() -> None:
    times = np.array([0, PERIOD_NS - 1, PERIOD_NS, 10 * PERIOD_NS + 5, 10**15])
    assert by_log(TRUTH, times).tolist() == [-1, -1, 0, 9, len(TRUTH) - 1]


def test_a_stamp_is_of_the_nearest_revolution_within_one() -> None:
    times = np.array([PERIOD_NS, 5 * PERIOD_NS + 3, int(7.4 * PERIOD_NS), int(7.6 * PERIOD_NS)])
    assert by_stamp(TRUTH, times).tolist() == [0, 4, 6, 7]
    far = np.array([-2 * PERIOD_NS, 10**15])
    assert by_stamp(TRUTH, far).tolist() == [-1, -1]


def test_of_several_in_a_revolution_the_last_counts() -> None:
    messages = [
        Given(1.0, flagged=False, alarm=math.nan, stamp_ns=None),
        Given(2.0, flagged=True, alarm=5.0, stamp_ns=None),
        Given(3.0, flagged=False, alarm=math.nan, stamp_ns=None),
    ]
    values = laid_out(messages, np.array([4, 4, -1]), 6)
    assert values.given.tolist() == [False] * 4 + [True, False]
    assert (values.value[4], values.flagged[4], values.alarm[4]) == (2.0, True, 5.0)
    moved = values.shifted(2)
    assert moved.given.tolist() == [False, False, True, False, False, False]
    assert moved.shifted(-2).value[4] == 2.0
