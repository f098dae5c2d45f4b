# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

from __future__ import annotations

import json

import numpy as np
import pytest

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import ORDERS, evaluate
from roller_sim_ros.panel.frames import packed, text, unpacked
from roller_sim_ros.panel.picture import TOPICS, Picture
from roller_sim_ros.panel.track import Track
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode

NODE = "/roller_sim"
BY_NAME = {topic.name: topic for topic in TOPICS}


def driven(revolutions: int, emulator: Emulator | None = None) -> list[Message]:
    emulator = emulator or Emulator(Configuration(), start_ns=0, run_up=False)
    return [message for _ in range(8 * revolutions) for message in emulator.advance(16)]


def pictured(sent: list[Message], picture: Picture | None = None) -> Picture:
    picture = picture or Picture(NODE)
    for message in sent:
        if message.topic in BY_NAME:
            picture.take(BY_NAME[message.topic], message.data)
    return picture


def sent_on(sent: list[Message], topic: str) -> list:
    return [decode(item.data, item.type_name) for item in sent if item.topic == topic]


def test_a_frame_has_the_samples_and_values_of_the_topics() -> None:
    sent = driven(40)
    values, arrays = unpacked(pictured(sent).frame())
    blocks = sent_on(sent, "drum/acceleration")
    for name in ("vertical", "horizontal"):
        whole = np.concatenate([getattr(block, name) for block in blocks])
        np.testing.assert_array_equal(arrays[name], whole[-len(arrays[name]) :])
    assert values["first"] + len(arrays["vertical"]) == 40 * 128
    meter = sent_on(sent, "meter")[-1]
    assert values["meter"]["last_sample"] == meter.last_sample
    assert (values["meter"]["cmv"], values["meter"]["rmv"]) == (meter.cmv, meter.rmv)
    assert arrays["rows"].reshape(-1, 5)[-1, 2] == np.float32(meter.cmv)
    truth = sent_on(sent, "truth")[-1]
    assert values["truth"]["force_ratio_max"] == truth.force_ratio_max
    assert arrays["force"].max() == pytest.approx(
        max(block.soil_force.max() for block in sent_on(sent, "truth")[-32:]) * 1e-3
    )


def test_the_spectrum_holds_the_lines_of_the_meter() -> None:
    sent = driven(40)
    _, arrays = unpacked(pictured(sent).frame())
    whole = np.concatenate([block.vertical for block in sent_on(sent, "drum/acceleration")])
    harmonics = order_amplitudes(whole[-16 * 128 :], ORDERS)
    for order in ORDERS:
        assert arrays["spectrum"][int(16 * order)] == pytest.approx(
            harmonics.amplitude(order), rel=1e-5
        )
    cmv = 300.0 * arrays["spectrum"][32] / arrays["spectrum"][16]
    assert cmv == pytest.approx(evaluate(harmonics)["cmv"], rel=1e-5)


def test_the_orbit_is_that_of_the_accelerations() -> None:
    sent = driven(400)
    _, arrays = unpacked(pictured(sent).frame())
    period_s = sent_on(sent, "truth")[-1].sample_period
    whole = np.concatenate([block.horizontal for block in sent_on(sent, "truth")])[-512:]
    # Second differences at so small a distance tell the second derivative to a part in 1000.
    found = np.diff(arrays["forward"].astype(float), 2) * 1e-3 / period_s**2
    np.testing.assert_allclose(found, whole[1:-1], atol=0.02 * np.abs(whole).max())


def test_each_sample_and_row_is_sent_once() -> None:
    emulator = Emulator(Configuration(), start_ns=0, run_up=False)
    picture = pictured(driven(20, emulator))
    picture.frame()
    sent = driven(3, emulator)
    values, arrays = unpacked(pictured(sent, picture).frame())
    assert not values["anew"]
    assert (values["first"], len(arrays["vertical"]), len(arrays["rows"])) == (
        20 * 128,
        3 * 128,
        15,
    )
    _, nothing = unpacked(picture.frame())
    assert (len(nothing["vertical"]), len(nothing["rows"])) == (0, 0)
    values, whole = unpacked(picture.whole())
    assert values["anew"]
    assert len(whole["rows"]) == 5 * 23


def test_a_new_run_begins_anew() -> None:
    picture = pictured(driven(30))
    picture.frame()
    values, arrays = unpacked(pictured(driven(2), picture).frame())
    assert values["anew"]
    assert (values["first"], len(arrays["vertical"])) == (0, 256)
    assert arrays["rows"].reshape(-1, 5)[:, 0] == pytest.approx([1 / 28, 2 / 28], rel=0.05)


def test_blocks_that_come_twice_or_late_change_nothing() -> None:
    sent = driven(20)
    expected = pictured(sent).frame()
    blocks = [item for item in sent if item.topic == "drum/acceleration"]
    assert pictured([*sent, *blocks[-3:-1]]).frame() == expected


def test_damaged_messages_are_let_go() -> None:
    sent = driven(20)
    random = np.random.default_rng(1)
    picture = Picture(NODE)
    for message in sent[:2000]:
        if message.topic not in BY_NAME:
            continue
        data = bytearray(message.data)
        # The first half of the bytes: heads, times and lengths.
        for at in random.integers(0, len(data) // 2, 3):
            data[at] = random.integers(256)
        picture.take(BY_NAME[message.topic], bytes(data))
        picture.frame()
        picture.configuration()
    assert not picture.take(BY_NAME["truth"], b"")
    values, _ = unpacked(pictured(driven(20), picture).whole())
    assert values["meter"]["last_sample"] == 20 * 128 - 1


def test_the_configuration_is_that_of_machine_and_ground() -> None:
    configuration = Configuration().changed(
        {
            "machine.drum_mass_kg": 4000.0,
            "soil.shear_modulus_pa": 70e6,
            "half_space.model": "two-pole",
        }
    )
    picture = Picture(NODE)
    assert picture.configuration() is None
    sent = driven(2, Emulator(configuration, start_ns=0, run_up=False))
    found = pictured(sent, picture).configuration()
    assert found is not None
    assert found.machine.drum_mass_kg == 4000.0
    assert found.soil.shear_modulus_pa == 70e6
    assert found.half_space.model == "two-pole"


def test_diagnostics_of_others_are_not_the_rollers() -> None:
    picture = Picture(NODE)
    topic = BY_NAME["/diagnostics"]
    for node, own in (("/other", False), (NODE, True)):
        entry = messages.Diagnostic(f"{node}: pacing", hardware_id=node)
        assert picture.take(topic, messages.diagnostic_array([entry], 0).data) is own
    assert [entry["name"] for entry in picture.diagnostics] == ["pacing"]


def test_a_track_forgets_what_a_gap_cuts_off() -> None:
    track = Track(("a",), 10)
    track.append(0, {"a": np.arange(6.0)})
    track.append(6, {"a": np.arange(6.0, 12.0)})
    assert (len(track), track.new(), track["a"][0]) == (10, 10, 2.0)
    track.append(20, {"a": np.array([20.0])})
    assert (len(track), track.new(), track.following) == (1, 1, 21)


def test_frames_are_read_as_they_were_written() -> None:
    for name in ("a", "ab", "abc", "abcd"):
        values, arrays = unpacked(packed({name: 1.5}, {"x": np.arange(3), "empty": np.zeros(0)}))
        assert values == {name: 1.5}
        np.testing.assert_array_equal(arrays["x"], [0.0, 1.0, 2.0])
        assert len(arrays["empty"]) == 0


def test_what_is_no_number_is_null() -> None:
    found = json.loads(text({"a": float("nan"), "b": [float("inf"), 1.0], "c": {"d": -np.inf}}))
    assert found == {"a": None, "b": [None, 1.0], "c": {"d": None}}
