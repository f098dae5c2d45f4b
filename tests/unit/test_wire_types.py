# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Schemas and quality of service as rosbag2 writes and reads them."""

import pytest
import yaml
from rosbags.interfaces import QosDurability, QosReliability
from rosbags.rosbag2.metadata import parse_qos
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from roller_sim_ros.parameters import Pacing
from roller_sim_ros.share import share_directory
from roller_sim_ros.wire.qos import Qos
from roller_sim_ros.wire.topics import TOPICS, Topic
from roller_sim_ros.wire.types import TypeUnknownError, message_class, schema, typestore


@pytest.mark.parametrize("topic", TOPICS, ids=lambda topic: topic.name)
def test_schema_of_every_topic_is_complete_and_the_same_type(topic: Topic) -> None:
    text = schema(topic.type_name).text
    store = get_typestore(Stores.EMPTY)
    store.register(get_types_from_msg(text, topic.type_name))
    for name, definition in store.fielddefs.items():
        assert definition[1] == typestore().fielddefs[name][1], name
    assert store.hash_rihs01(topic.type_name) == schema(topic.type_name).type_hash


def test_schema_text_has_rosbag2s_form() -> None:
    text = schema("roller_sim_ros/msg/ExciterCommand").text
    own = (share_directory() / "msg" / "ExciterCommand.msg").read_text("utf-8")
    assert text.startswith(own)
    separator = "=" * 80
    lines = text.split("\n")
    marks = [lines[i + 1] for i, line in enumerate(lines) if line == separator]
    assert marks == ["MSG: std_msgs/Header", "MSG: builtin_interfaces/Time"]


def test_type_hash_is_the_one_that_ros_computes() -> None:
    # From share/std_msgs/msg/Float64.json and Header's of an installed ROS 2 Kilted.
    assert (
        schema("std_msgs/msg/Float64").type_hash
        == "RIHS01_705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a"
    )
    assert (
        schema("sensor_msgs/msg/Imu").type_hash
        == "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"
    )


def test_installed_definition_of_a_foreign_type_is_used(tmp_path, monkeypatch) -> None:
    folder = tmp_path / "share" / "meter_under_test" / "msg"
    folder.mkdir(parents=True)
    (folder / "Stiffness.msg").write_text("std_msgs/Header header\nPart[] parts\n")
    (folder / "Part.msg").write_text("# a part\nfloat64 value  # MN/m\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    text = schema("meter_under_test/msg/Stiffness").text
    assert "MSG: meter_under_test/Part\n# a part\nfloat64 value  # MN/m\n" in text
    assert "MSG: builtin_interfaces/Time\n" in text


def test_unknown_and_broken_types_are_named(tmp_path, monkeypatch) -> None:
    with pytest.raises(TypeUnknownError, match=r"no_such_pkg/msg/Thing.*no definition"):
        schema("no_such_pkg/msg/Thing")
    folder = tmp_path / "share" / "broken" / "msg"
    folder.mkdir(parents=True)
    (folder / "Thing.msg").write_text("float64 = = [\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    with pytest.raises(TypeUnknownError, match="broken/msg/Thing"):
        schema("broken/msg/Thing")


@pytest.mark.parametrize("topic", TOPICS, ids=lambda topic: topic.name)
def test_offered_profiles_mean_what_the_table_says(topic: Topic) -> None:
    qos = topic.qos(Pacing())
    (parsed,) = parse_qos(qos.offered_profiles())
    assert parsed.reliability is QosReliability.RELIABLE
    transient = topic.name in ("faults", "machine", "soil")
    assert parsed.durability is (
        QosDurability.TRANSIENT_LOCAL if transient else QosDurability.VOLATILE
    )
    assert parsed.depth == qos.depth
    assert Qos.from_offered_profiles(qos.offered_profiles()) == qos


def test_depth_is_five_seconds_of_blocks() -> None:
    by_name = {topic.name: topic for topic in TOPICS}
    assert by_name["drum/acceleration"].qos(Pacing(samples_per_message=16)).depth == 1600
    assert by_name["truth"].qos(Pacing(samples_per_message=128)).depth == 200
    assert by_name["drum/imu"].qos(Pacing(imu_decimation=4)).depth == 6400
    assert by_name["meter"].qos(Pacing()).depth == 200
    assert by_name["exciter/state"].qos(Pacing()).depth == 50
    assert by_name["exciter/state"].qos(Pacing(lock_step=True)).depth == 1000
    assert by_name["soil"].qos(Pacing()).depth == 1


def test_profiles_of_newer_rosbag2_are_read_by_name() -> None:
    text = Qos("best_effort", "transient_local", 7).offered_profiles()
    named = yaml.safe_load(text)
    named[0].update(history="keep_last", reliability="best_effort", durability="transient_local")
    assert Qos.from_offered_profiles(yaml.safe_dump(named)) == Qos(
        "best_effort", "transient_local", 7
    )


def test_several_publishers_and_nonsense() -> None:
    both = (
        Qos("best_effort", "transient_local", 7).offered_profiles()
        + Qos("reliable", "volatile", 3).offered_profiles()
    )
    assert Qos.from_offered_profiles(both) == Qos("reliable", "volatile", 7)
    for text in ("", "[]", "{", "- 3", "- {reliability: 1}", "null"):
        assert Qos.from_offered_profiles(text) is None


def test_every_topic_has_a_known_type_and_says_what_it_is() -> None:
    assert len({topic.name for topic in TOPICS}) == len(TOPICS)
    for topic in TOPICS:
        assert message_class(topic.type_name).__msgtype__ == topic.type_name
        assert topic.doc
        assert topic.rate
