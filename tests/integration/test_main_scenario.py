# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The issue's scenario: a client in its own process commands the roller and computes CMV itself."""

from __future__ import annotations

import csv
import json
from bisect import bisect_left
from itertools import islice, pairwise

import numpy as np
import pytest
from std_msgs.msg import Float64

from roller_sim_ros.msg import CompactionMeter, DrumAcceleration
from tests.integration.harness import Client, roller_sim

N = 128
WINDOW = 16 * N


class Listener:
    """Takes every sample and computes CMV from nothing but the messages' own fields."""

    def __init__(self, client: Client) -> None:
        self.blocks = client.listen("drum/acceleration", DrumAcceleration)
        self.meter = client.listen("meter", CompactionMeter)
        self.cmv = client.listen("cmv", Float64)

    def assert_whole(self, first: int) -> None:
        """Show that from a message on no sample is missing, doubled or out of place."""
        blocks = self.blocks[first:]
        for before, after in pairwise(blocks):
            assert after.sequence == before.sequence + len(before.vertical)

    def amplitude(self, last_sample: int, order: float) -> float:
        """Return the amplitude at an order over the window that ends with a sample."""
        first = last_sample - WINDOW + 1
        samples, phases = [], []
        # Only what is near: meanwhile nothing is received, and the queue is short.
        start = bisect_left(self.blocks, first - N, key=lambda block: block.sequence)
        for block in islice(self.blocks, start, None):
            if block.sequence > last_sample:
                break
            index = np.arange(block.sequence, block.sequence + len(block.vertical))
            inside = (index >= first) & (index <= last_sample)
            if inside.any():
                steps = np.arange(len(block.vertical))[inside]
                samples.append(np.asarray(block.vertical)[inside])
                phases.append(block.eccentric_phase + steps * block.phase_increment)
        vertical = np.concatenate(samples).astype(float)
        assert len(vertical) == WINDOW
        # The phase counts on from revolution to revolution, as half an order needs.
        phase = np.unwrap(np.concatenate(phases))
        return float(2.0 / WINDOW * abs(np.sum(vertical * np.exp(-1j * order * phase))))


def settled(listener: Listener, mode: int, frequency: float = 28.0):
    """Return a function that gives the newest meter value once it is the wanted one, and steady."""

    def newest():
        last = listener.meter[-10:]
        steady = len(last) == 10 and all(
            item.mode == mode and item.status == 0 and item.excitation_frequency == frequency
            for item in last
        )
        return last[-1] if steady else None

    return newest


@pytest.mark.timeout(180)
def test_client_commands_listens_and_agrees(start, client, tmp_path):
    bag = tmp_path / "session.mcap"
    sim = start(
        *("--shear-modulus-mpa", "35", "--plastic-mm", "0.8", "--record", str(bag)),
        *("--ros-args", "-p", "exciter.vibrate:=false"),
        *("-p", "exciter.frequency_rate_hz_per_s:=50.0"),
    )
    listener = Listener(client)
    client.spin_until(lambda: listener.blocks)
    client.command(vibrate=True, frequency=28.0, amplitude=1.6e-3)
    client.spin_until(settled(listener, CompactionMeter.PARTIAL_UPLIFT))

    # 10 s, every sample.
    first = len(listener.blocks)
    begins = listener.blocks[first - 1].sequence
    client.spin_until(lambda: listener.blocks[-1].sequence - begins > 10.0 * 28 * N)
    listener.assert_whole(first)
    last = listener.meter[-1].last_sample
    client.spin_until(lambda: listener.blocks[-1].sequence > last and listener.cmv)
    for meter in [item for item in listener.meter[-200:] if item.status == 0][::20]:
        own = 300.0 * listener.amplitude(meter.last_sample, 2.0)
        own /= listener.amplitude(meter.last_sample, 1.0)
        assert own == pytest.approx(meter.cmv, rel=1e-6)
    before = {item.cmv for item in listener.meter if item.status == 0}
    assert before & {item.data for item in listener.cmv}
    assert listener.amplitude(last, 0.5) < 0.01 * listener.amplitude(last, 1.0)

    # Stiff ground: double jump, seen in the client's own spectrum as well. Half a percent of period 4,
    # which the meter tells from period 2, takes 18 s to die away.
    for result in client.set_parameters(
        {"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3}
    ):
        assert result.successful, result.reason
    meter = client.spin_until(settled(listener, CompactionMeter.DOUBLE_JUMP))
    client.spin_until(lambda: listener.blocks[-1].sequence > meter.last_sample)
    assert meter.period == 2
    half, whole = (listener.amplitude(meter.last_sample, order) for order in (0.5, 1.0))
    assert half > 0.1 * whole
    assert meter.rmv == pytest.approx(300.0 * half / whole, rel=1e-6)

    # Half the amplitude: it goes away.
    client.command(vibrate=True, frequency=28.0, amplitude=0.8e-3)
    meter = client.spin_until(settled(listener, CompactionMeter.PARTIAL_UPLIFT))
    client.spin_until(lambda: listener.blocks[-1].sequence > meter.last_sample)
    assert meter.period == 1
    assert listener.amplitude(meter.last_sample, 0.5) < 0.01 * meter.fundamental_amplitude

    listener.assert_whole(first)
    assert sim.end() == 0

    # The bag of the session says the same, value for value.
    table = tmp_path / "session.csv"
    report = json.loads(roller_sim("analyze", bag, "--json", "-", "--csv", table))
    assert report["gaps"] == report["missing_samples"] == report["duplicate_blocks"] == 0
    assert report["recorded_meter"]["max_difference"]["cmv"] == 0.0
    assert report["recorded_meter"]["disagreements"] == {"period": 0, "mode": 0}
    assert report["recorded_cmv"]["max_difference"]["cmv"] == 0.0

    def heard() -> int:
        return listener.blocks[-1].sequence + len(listener.blocks[-1].vertical)

    client.spin_until(lambda: heard() >= report["samples"])  # what was still under way
    assert heard() == report["samples"]
    with table.open(newline="") as file:
        in_bag = {int(row["last_sample"]): row for row in csv.DictReader(file)}
    known = [item for item in listener.meter if item.status == 0]
    assert len(known) > 300
    for meter in known:
        row = in_bag[meter.last_sample]
        assert float(row["cmv"]) == pytest.approx(meter.cmv, rel=1e-6)
        assert float(row["rmv"]) == pytest.approx(meter.rmv, rel=1e-6, abs=1e-9)
        assert int(row["period"]) == meter.period
