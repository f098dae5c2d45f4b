# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A run without ROS: steps by samples and by time, the clock before its block, the end."""

from __future__ import annotations

import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.streams import StreamHashes
from roller_sim_ros.node.run import Run
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.wire.types import decode


def run_of(sent: list, configuration: Configuration | None = None, **options) -> Run:
    emulator = Emulator(configuration or Configuration(), start_ns=0, run_up=False)
    return Run(emulator, 16, sent.extend, lambda: False, **options)


def always() -> bool:
    return True


def test_clock_goes_before_its_block_and_says_where_it_ends():
    sent: list = []
    run = run_of(sent, clock=True)
    assert run.time_ns == 0
    assert run.step(24, always)
    topics = [message.topic for message in sent]
    assert [topic for topic in topics if topic in ("/clock", "truth")] == ["/clock", "truth"] * 2
    first, second = (decode(it.data, it.type_name).clock for it in sent if it.topic == "/clock")
    period_ns = 1e9 / (28.0 * 128)
    assert first.nanosec == pytest.approx(16 * period_ns, abs=1.0)
    assert second.nanosec == pytest.approx(24 * period_ns, abs=1.0)
    assert run.time_ns == second.nanosec


@pytest.mark.parametrize("floor_hz", [10.0, 28.0, 40.0])
def test_time_is_rounded_up_to_samples_and_never_beyond(floor_hz):
    run = run_of([], Configuration().changed({"sampling.floor_hz": floor_hz}))
    period_s = 1.0 / (max(28.0, floor_hz) * 128)
    for duration_s in (1e-6, 0.5 * period_s, period_s, 0.01, 1.0, 1e-9 + 3 * period_s):
        begin_s = run.time_s
        assert run.step_for(duration_s, always)
        assert begin_s + duration_s - 2e-9 <= run.time_s < begin_s + duration_s + period_s


def test_steps_give_the_same_samples_whatever_they_are():
    hashes = []
    for steps in ([128] * 12, [1, 7, 100, 300, 1128], [1536]):
        sent: list = []
        run = run_of(sent)
        for samples in steps:
            assert run.step(samples, always)
        found = StreamHashes(start_ns=0)
        found.feed(sent)
        hashes.append(found.digests())
    assert hashes[0] == hashes[1] == hashes[2]


def test_step_is_cut_short_between_blocks():
    sent: list = []
    run = run_of(sent)
    left = iter([True] * 3 + [False])
    assert not run.step(1000, lambda: next(left))
    assert run.next_sample == 48


def test_end_is_where_all_is_driven_and_told_once(tmp_path):
    scenario = parse_scenario("lane: {length_m: 1}", tmp_path / "short.yaml")
    emulator = Emulator(start_ns=0, **start_of(scenario)._asdict())
    told = []
    run = Run(emulator, 128, lambda _: None, lambda: False)
    run.on_end = lambda: told.append(run.next_sample)
    assert not run.step(10**6, lambda: not run.ended)
    assert run.ended
    # 1 s at 28 Hz; that all is driven is known where the next revolution begins.
    assert run.next_sample in (28 * 128, 29 * 128, 30 * 128)
    assert run.step(1280, always)
    assert told == [run.next_sample - 1280]


def test_watch_is_kept_before_every_revolution():
    times = []
    run = run_of([])
    run.before_revolution = times.append
    assert run.step(3 * 128 + 5, always)
    assert times == pytest.approx([0.0, 1 / 28, 2 / 28, 3 / 28])
