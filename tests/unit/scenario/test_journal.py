# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The map of a run: a row per revolution, whenever it is asked for."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

from roller_sim_ros.meters import TruthMeter
from roller_sim_ros.scenario import Journal, SiteMap, read_scenario, start_of
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.session import Session

REVOLUTIONS = 150


def session() -> Session:
    return start_of(read_scenario(shipped_scenarios()["soft_spot"])).session()


def different(one: SiteMap, other: SiteMap) -> list[str]:
    return [
        item.name
        for item in fields(SiteMap)
        if not np.array_equal(getattr(one, item.name), getattr(other, item.name), equal_nan=True)
    ]


def test_rows_are_of_the_moment_at_which_their_revolution_was_stepped() -> None:
    roller = session()
    configuration = roller.configuration
    meter = TruthMeter(
        configuration.meter.window_revolutions,
        configuration.machine.static_load_n,
        roller.samples_per_revolution,
        configuration.meter.period_tolerance,
    )
    journal, rows = Journal(roller), []
    for _ in range(REVOLUTIONS):
        block = roller.advance(roller.samples_per_revolution)
        journal.feed(block)
        truth = meter.feed(block)
        rows.append((block.time_s, roller.site.position.chainage_m, truth.cmv, truth.mode))
    found = journal.map()
    columns = (found.time_s, found.chainage_m, found.cmv, found.mode)
    for column, expected in zip(columns, zip(*rows, strict=True), strict=True):
        np.testing.assert_array_equal(column, expected)
    assert np.isfinite(found.cmv).any()


def test_the_map_is_the_same_whenever_it_was_asked_for_and_whatever_the_blocks() -> None:
    maps = []
    for size, asked in ((128, ()), (128, (1, 63, 64, 100)), (32, (70,))):
        roller = session()
        journal = Journal(roller)
        for done in range(REVOLUTIONS):
            if done in asked:
                assert len(journal.map()) == done
            for _ in range(roller.samples_per_revolution // size):
                journal.feed(roller.advance(size))
        maps.append(journal.map())
    assert len(maps[0]) == REVOLUTIONS
    assert different(maps[0], maps[1]) == []
    # The time at which a revolution began is reckoned back from its last block.
    assert different(maps[0], maps[2]) in ([], ["time_s"])
    np.testing.assert_allclose(maps[2].time_s, maps[0].time_s, rtol=0, atol=1e-12)
