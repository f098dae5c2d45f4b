# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The verdict on whole runs: the built-in meter passes, the one that is wrong on purpose fails where it should."""

from __future__ import annotations

import importlib.util
import json
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.faults import FAULTS
from roller_sim_ros.parameters import Pacing
from roller_sim_ros.scenario import Scenario, parse_scenario, read_scenario, start_of
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.sensors import Choice
from roller_sim_ros.traces.registration import register, register_all
from roller_sim_ros.traces.writer import TraceWriter
from roller_sim_ros.wire.types import decode, encode, message_class

NUMBER = "std_msgs/msg/Float64"
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "wrong_meter.py"
START_NS = 1_700_000_000_000_000_000
MOST_SAMPLES = 1200 * 128
"""Enough for each scenario to show what it shows; the longest are three times as long."""


def wrong_cmv() -> Callable[..., float]:
    spec = importlib.util.spec_from_file_location("wrong_meter", EXAMPLE)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.wrong_cmv


def shipped(name: str) -> Scenario:
    return read_scenario(shipped_scenarios()[name])


def conduct(scenario: Scenario, path: Path, *sensors: Choice) -> Path:
    """Record a scenario, with the wrong meter's values on /wrong_cmv, each a revolution after its samples."""
    start = start_of(scenario)
    if sensors:
        start = start._replace(sensors=sensors)
    emulator = Emulator(start_ns=START_NS, **start._asdict())
    wrong, window, count = wrong_cmv(), np.zeros(0), 0
    with TraceWriter(path, {}) as trace:
        names = register_all(trace, Pacing())
        register(trace, "/wrong_cmv", NUMBER, None)
        session = emulator.session
        while session.next_sample < MOST_SAMPLES and not session.site.position.finished:
            messages = emulator.advance(128)
            block = emulator.block
            assert block is not None
            end_ns = START_NS + round((block.time_s + 128 * block.sample_period_s) * 1e9)
            for message in messages:
                trace.put(names[message.topic], message.data, end_ns, end_ns)
                if message.topic == "drum/acceleration" and not sensors:
                    samples = decode(message.data, message.type_name)
                    count = round(0.1 / samples.sample_period)
                    window = np.append(window, samples.vertical)[-count:]
            if len(window) and len(window) == count:
                value = wrong(window, block.sample_period_s, block.excitation_hz)
                data = encode(message_class(NUMBER)(float(value)), NUMBER)
                trace.put("/wrong_cmv", data, end_ns + 10_000_000, end_ns)
    return path


@pytest.fixture(scope="module")
def campaign(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return conduct(
        shipped("sensor_failure_campaign"), tmp_path_factory.mktemp("score") / "campaign.mcap"
    )


@pytest.fixture(scope="module")
def stiffening(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return conduct(shipped("soft_to_stiff"), tmp_path_factory.mktemp("score") / "stiffening.mcap")


def test_it_passes_with_a_sensor_of_a_fixed_rate(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sheet = {"sample_rate_hz": 4000.0, "bandwidth_hz": 1500.0, "clock_skew_ppm": 100.0}
    trace = conduct(
        shipped("soft_to_stiff"), tmp_path / "trace.mcap", Choice("accelerometer", sheet)
    )
    for topic in ("meter", "cmv"):
        code, report = judged(capsys, trace, topic)
        assert (code, failed(report)) == (0, [])
        (rms,) = [row for row in report["rows"] if row["name"] == "rms"]
        assert rms["found"] < 1.0


def judged(
    capsys: pytest.CaptureFixture[str], trace: Path, topic: str, *flags: str
) -> tuple[int, dict[str, Any]]:
    capsys.readouterr()
    code = commands.main(["score", str(trace), "--topic", topic, "--json", "-", *flags])
    return code, json.loads(capsys.readouterr().out)


def failed(report: dict[str, Any]) -> list[str]:
    return [row["name"] for row in report["rows"] if row["verdict"] == "fail"]


@pytest.mark.parametrize(
    "name", sorted(set(shipped_scenarios()) - {"sensor_failure_campaign", "soft_to_stiff"})
)
def test_the_built_in_meter_passes_every_scenario(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace = conduct(shipped(name), tmp_path / "trace.mcap")
    for topic in ("meter", "cmv"):
        code, report = judged(capsys, trace, topic)
        assert (code, failed(report)) == (0, [])


def test_it_passes_under_faults_and_in_double_jump_too(
    campaign: Path, stiffening: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for trace in (campaign, stiffening):
        for topic in ("meter", "cmv"):
            code, report = judged(capsys, trace, topic)
            assert (code, failed(report)) == (0, [])
            assert report["matched_by"] == ("stamp" if topic == "meter" else "log")
    _, report = judged(capsys, campaign, "meter")
    faults = [row for row in report["rows"] if row["name"].startswith("fault/")]
    assert [row["name"].rpartition("/")[2] for row in faults] == [
        "stuck",
        "dropout",
        "spike",
        "bias_step",
        "gain_change",
        "saturation",
        "noise_burst",
        "delay",
    ]
    assert {row["verdict"] for row in faults} == {"pass"}
    _, report = judged(capsys, stiffening, "meter")
    rows = {row["name"]: row for row in report["rows"]}
    assert rows["missing_alarms"]["verdict"] == rows["wrong_alarms"]["verdict"] == "pass"
    assert rows["rms_in_double_jump"]["found"] < 1e-3
    assert abs(rows["latency"]["found"]) < 1e-3


def test_it_does_what_every_fault_of_the_catalogue_expects_while_the_ground_changes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    windows = "".join(
        f"  - {{id: {name}, from_s: {2 * number + 2}, to_s: {2 * number + 3}}}\n"
        for number, name in enumerate(FAULTS)
    )
    text = f"""
lane: {{length_m: 40}}
travel: {{speed_m_s: 1.0}}
ground:
  shear_modulus_mpa: 30
  features: [{{kind: gradient, to_m: 40, shear_modulus_mpa: 42}}]
exciter: {{frequency_hz: 28, amplitude_mm: 1.4}}
sensors: [{{name: mems_50g}}, {{name: tacho}}, {{name: odometry}}, {{name: gnss}}]
faults:
{windows}
"""
    trace = conduct(parse_scenario(text, Path("every_fault.yaml")), tmp_path / "trace.mcap")
    for topic in ("meter", "cmv"):
        code, report = judged(capsys, trace, topic)
        assert (code, failed(report)) == (0, [])
        faults = [row for row in report["rows"] if row["name"].startswith("fault/")]
        assert [row["name"].rpartition("/")[2] for row in faults] == list(FAULTS)
        assert {row["verdict"] for row in faults} == {"pass"}


def test_the_wrong_meter_fails_in_the_rows_named_for_it(
    campaign: Path, stiffening: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, report = judged(capsys, stiffening, "/wrong_cmv")
    assert (code, failed(report)) == (1, ["bias", "rms", "rms_in_double_jump", "ceiling"])
    (ceiling,) = [row for row in report["rows"] if row["name"] == "ceiling"]
    assert "values are 150" in ceiling["detail"]
    code, report = judged(capsys, campaign, "/wrong_cmv")
    assert code == 1
    for fault in ("fault/1/stuck", "fault/2/dropout", "fault/6/saturation"):
        assert fault in failed(report)


def test_limits_decide_and_the_outputs_agree(
    stiffening: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    generous = tmp_path / "limits.yaml"
    generous.write_text(
        "bias_percent: 1000\nrms_percent: 1000\nrms_in_double_jump_percent: 1000\n",
        encoding="utf-8",
    )
    junit, report = tmp_path / "score.xml", tmp_path / "score.json"
    arguments = ["score", str(stiffening), "--topic", "wrong_cmv", "--limits", str(generous)]
    assert commands.main([*arguments, "--junit", str(junit), "--json", str(report)]) == 1
    table = capsys.readouterr().out
    assert table.splitlines()[-1].startswith("failed: 1 of ")
    assert table.splitlines()[-1].endswith(" rows: ceiling")
    rows = json.loads(report.read_text(encoding="utf-8"))["rows"]
    suite = ElementTree.parse(junit).getroot().find("testsuite")
    assert suite is not None
    cases = suite.findall("testcase")
    assert [case.get("name") for case in cases] == [row["name"] for row in rows]
    for case, row in zip(cases, rows, strict=True):
        assert (case.find("failure") is not None) == (row["verdict"] == "fail")
        assert (case.find("skipped") is not None) == (row["verdict"] == "not judged")
        assert row["name"] in table
    assert suite.get("tests") == str(len(rows))
    assert suite.get("failures") == "1"
    assert suite.get("skipped") == str(len([row for row in rows if row["verdict"] == "not judged"]))


def test_a_damaged_trace_is_judged_as_far_as_it_goes_and_fails(
    stiffening: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(stiffening.read_bytes()[: stiffening.stat().st_size // 2])
    code, report = judged(capsys, cut, "meter")
    assert (code, failed(report)) == (1, ["trace"])
    assert report["revolutions"] > 100


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--topic", "my_cmv"], "there is no topic my_cmv; its topics: "),
        (["--topic", "truth"], "/truth is the truth itself"),
        (["--topic", "cmv", "--field", "value"], "has no number 'value'; it has data"),
        (["--topic", "cmv", "--match", "stamp"], "has no stamp; match it by log"),
        (["--topic", "cmv", "--truth", "/roller_1/truth"], "there is no topic /roller_1/truth"),
        (["--topic", "meter", "--truth", "cmv"], "/cmv holds std_msgs/msg/Float64, not "),
        (["--topic", "odom"], "no messages on /odom"),
        (["--topic", "cmv", "--limits", "none.yaml"], "none.yaml: cannot be read"),
        (
            ["--topic", "cmv", "--junit", "/nowhere/score.xml"],
            "/nowhere/score.xml: cannot be written",
        ),
    ],
)
def test_what_cannot_be_judged_is_one_line_and_code_2(
    flags: list[str], said: str, stiffening: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    assert commands.main(["score", str(stiffening), *flags]) == 2
    error = capsys.readouterr().err
    assert error.startswith("roller-sim score: error: ")
    assert said in error
    assert len(error.splitlines()) == 1


def test_a_trace_without_truth_and_one_that_is_none_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with TraceWriter(tmp_path / "bare.mcap", {}) as trace:
        register(trace, "/cmv", NUMBER, None)
        trace.put("/cmv", encode(message_class(NUMBER)(1.0), NUMBER), 1, 1)
    (tmp_path / "text.mcap").write_text("no trace", encoding="utf-8")
    for name, said in (("bare", "holds no truth"), ("text", "text.mcap"), ("none", "none.mcap")):
        assert commands.main(["score", str(tmp_path / f"{name}.mcap"), "--topic", "cmv"]) == 2
        assert said in capsys.readouterr().err
