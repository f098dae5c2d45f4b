# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Choice of topics: one roller's, never a mix, and a line that says what there is."""

from __future__ import annotations

from pathlib import Path

import pytest

from roller_sim_ros.analysis.bag import BagError, Topic
from roller_sim_ros.analysis.topics import Selection, select

OWN = "roller_sim_ros/msg/"
TYPES = {
    "drum/acceleration": OWN + "DrumAcceleration",
    "drum/imu": "sensor_msgs/msg/Imu",
    "meter": OWN + "CompactionMeter",
    "cmv": "std_msgs/msg/Float64",
    "truth": OWN + "DrumSoilState",
}
BAG = Path("some.mcap")


def topics(*namespaces: str, without: tuple[str, ...] = (), **counts: int) -> dict[str, Topic]:
    return {
        f"{space}/{name}": Topic(f"{space}/{name}", kind, counts.get(name.replace("/", "_"), 10))
        for space in namespaces
        for name, kind in TYPES.items()
        if name not in without
    }


def test_one_roller() -> None:
    found = select(BAG, topics(""))
    assert found.source.name == "/drum/acceleration"
    assert (found.meter, found.cmv, found.truth) == ("/meter", "/cmv", "/truth")
    assert found.names == {"/drum/acceleration", "/meter", "/cmv", "/truth"}


def test_several_rollers_must_be_told_apart() -> None:
    both = topics("/a", "/b")
    with pytest.raises(BagError, match="--topic: /a/drum/acceleration, /b/drum/acceleration"):
        select(BAG, both)
    for name in ("/b/drum/acceleration", "b/drum/acceleration"):
        found = select(BAG, both, name)
        assert (found.meter, found.cmv, found.truth) == ("/b/meter", "/b/cmv", "/b/truth")


def test_other_rollers_meter_is_never_compared_with() -> None:
    both = topics("/a") | topics("/b", without=("meter", "cmv", "truth"))
    found = select(BAG, both, "/b/drum/acceleration")
    assert (found.meter, found.cmv, found.truth) == ("", "", "")


def test_renamed_topics_are_found_by_their_types() -> None:
    renamed = [
        Topic("/accel", OWN + "DrumAcceleration", 5),
        Topic("/m", OWN + "CompactionMeter", 5),
    ]
    found = select(BAG, {topic.name: topic for topic in renamed})
    assert found == Selection(renamed[0], meter="/m", cmv="", truth="")


def test_imu_serves_when_there_is_no_acceleration_or_when_it_is_asked_for() -> None:
    found = select(BAG, topics("", without=("drum/acceleration",)))
    assert found.source.name == "/drum/imu"
    assert found.meter == "/meter"
    assert select(BAG, topics(""), "/drum/imu").source.name == "/drum/imu"
    assert select(BAG, topics("", drum_acceleration=0)).source.name == "/drum/imu"


def test_meter_under_test_takes_the_place_of_the_recorded_one() -> None:
    all_topics = topics("") | {
        "/mine": Topic("/mine", OWN + "CompactionMeter", 5),
        "/number": Topic("/number", "std_msgs/msg/Float64", 5),
    }
    mine = select(BAG, all_topics, None, "/mine")
    assert (mine.meter, mine.cmv, mine.truth) == ("/mine", "", "/truth")
    number = select(BAG, all_topics, None, "number")
    assert (number.meter, number.cmv, number.truth) == ("", "/number", "/truth")
    with pytest.raises(BagError, match="/truth holds roller_sim_ros/msg/DrumSoilState"):
        select(BAG, all_topics, None, "/truth")


@pytest.mark.parametrize(
    ("found", "source", "words"),
    [
        ({}, None, "holds neither .* its topics: none"),
        ({"/a": Topic("/a", "pkg/msg/A", 3)}, None, r"its topics: /a \(pkg/msg/A\)"),
        (topics(""), "/nothing", "there is no topic /nothing; its topics: /drum/acceleration"),
        (topics(""), "/meter", "/meter holds roller_sim_ros/msg/CompactionMeter, neither"),
        (topics("", drum_acceleration=0), "/drum/acceleration", "no messages on /drum/acc"),
        (topics("", without=("drum/imu",), drum_acceleration=0), None, "no messages on /drum/acc"),
    ],
)
def test_nothing_to_choose(found: dict[str, Topic], source: str | None, words: str) -> None:
    with pytest.raises(BagError, match=words) as error:
        select(BAG, found, source)
    assert str(error.value).startswith("some.mcap: ")
