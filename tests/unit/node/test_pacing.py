# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The pacing thread without ROS: deadlines, a late block, an error."""

from __future__ import annotations

import time

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.node.beginning import Beginning
from roller_sim_ros.node.pacing import Pacer
from roller_sim_ros.node.run import Run
from roller_sim_ros.node.warm_up import warm_up
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire.types import decode

ACCELERATION = "drum/acceleration"


def pacer(send, *, imu: bool = False, speed: float = 1.0) -> Pacer:
    configuration = Configuration()
    warm_up(Beginning(configuration))
    emulator = Emulator(configuration, start_ns=0, run_up=False)
    return Pacer(Run(emulator, 16, send, lambda: imu), speed)


def test_blocks_come_in_order_and_none_before_its_last_sample_is_due():
    heard = []

    def send(messages):
        (block,) = [item for item in messages if item.topic == ACCELERATION]
        heard.append((time.monotonic(), decode(block.data, block.type_name)))

    pacing = pacer(send)
    begin = time.monotonic()
    pacing.start()
    time.sleep(0.5)
    pacing.stop()
    assert pacing.failure is None
    assert [block.sequence for _, block in heard] == [16 * k for k in range(len(heard))]
    period = heard[0][1].sample_period
    assert len(heard) > 0.4 / (16 * period)
    for when, block in heard:
        assert when - begin >= (block.sequence + 15) * period
    total = pacing.lateness.total()
    assert total.blocks == len(heard)
    simulated_s, real_s = pacing.run.progress
    assert -period <= real_s - simulated_s < 0.5


def test_late_block_is_counted_and_caught_up():
    sequence = []

    def send(messages):
        (block,) = [item for item in messages if item.topic == ACCELERATION]
        sequence.append(decode(block.data, block.type_name).sequence)
        if len(sequence) == 20:
            time.sleep(0.2)

    pacing = pacer(send)
    pacing.start()
    time.sleep(1.0)
    pacing.stop()
    total = pacing.lateness.total()
    assert sequence == [16 * k for k in range(len(sequence))]
    assert total.max_s > 0.15
    # 0.2 s are 44 blocks; all of them are there, and the time is made good.
    assert total.late >= 30
    assert len(sequence) > 0.8 / 4.5e-3


def test_imu_goes_out_with_its_block():
    sent = []
    pacing = pacer(sent.append, imu=True)
    pacing.start()
    time.sleep(0.1)
    pacing.stop()
    assert all(sum(item.topic == "drum/imu" for item in messages) == 16 for messages in sent)


def test_failure_ends_the_thread_and_is_kept():
    def send(_):
        raise ValueError("no way out")

    pacing = pacer(send)
    pacing.start()
    pacing.stop()
    assert str(pacing.failure) == "no way out"


def wait_until(done) -> None:
    end = time.monotonic() + 30.0
    while not done():
        assert time.monotonic() < end
        time.sleep(0.005)


def test_speed_is_that_of_simulated_time():
    sent = []
    pacing = pacer(sent.append, speed=4.0)
    pacing.start()
    wait_until(lambda: pacing.run.time_s > 0.5)
    pacing.stop()
    simulated_s, real_s = pacing.run.progress
    # Never ahead of the deadline, which is that of the last sample.
    assert real_s >= simulated_s / 4.0 - 1e-3


def test_without_a_speed_nothing_waits():
    sent = []
    pacing = pacer(sent.append, speed=0.0)
    pacing.start()
    wait_until(lambda: pacing.run.time_s > 2.0)
    pacing.stop()
    assert pacing.lateness.total().blocks == 0


def test_paused_it_leaves_the_run_alone_and_goes_on_where_it_was():
    sequence = []

    def send(messages):
        (block,) = [item for item in messages if item.topic == ACCELERATION]
        sequence.append(decode(block.data, block.type_name).sequence)

    pacing = pacer(send, speed=0.0)
    pacing.start(paused=True)
    pacing.pause()
    assert sequence == []
    assert pacing.run.step(100, lambda: True)
    assert pacing.run.next_sample == 100
    pacing.play()
    wait_until(lambda: len(sequence) > 50)
    pacing.pause()
    count = len(sequence)
    assert not pacing.playing
    time.sleep(0.05)
    assert len(sequence) == count
    pacing.stop()
    # Blocks end on their grid again after a step that did not.
    assert sequence[:9] == [0, 16, 32, 48, 64, 80, 96, 100, 112]
    assert sequence[9:] == [128 + 16 * k for k in range(len(sequence) - 9)]
