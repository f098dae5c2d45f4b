# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""roller-sim bench: scenario, meter and verdict in one go, over DDS."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from roller_sim_ros import commands

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
PATIENCE_S = 120.0

SHORT = """\
title: a short lane that is stiff at its end
lane: {length_m: 7}
travel: {speed_m_s: 1.0}
ground:
  shear_modulus_mpa: 30
  features:
    - {kind: section, from_m: 3, shear_modulus_mpa: 75}
exciter: {frequency_hz: 28, amplitude_mm: 1.6}
sensors:
  - name: mems_50g
faults:
  - {id: dropout, from_m: 5, to_m: 6}
parameters: {meter.period_tolerance: 0.05}
seed: 3
"""


@pytest.fixture
def lane(tmp_path: Path) -> Path:
    path = tmp_path / "lane.yaml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def bench(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "roller_sim_ros.commands", "bench", *arguments],
        cwd=folder,
        env={name: value for name, value in os.environ.items() if name != "ROS_DOMAIN_ID"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )


def rows(folder: Path) -> dict[str, str]:
    report = json.loads((folder / "score.json").read_text(encoding="utf-8"))
    return {row["name"]: row["verdict"] for row in report["rows"]}


def example(name: str) -> str:
    return f"{sys.executable} {EXAMPLES / name}.py"


def test_a_meter_is_run_and_passes_and_another_fails(lane: Path, tmp_path: Path) -> None:
    right, wrong = tmp_path / "right", tmp_path / "wrong"
    done = bench(tmp_path, str(lane), "--meter", example("meter_client"), "--out", str(right))
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("/my_cmv (std_msgs/msg/Float64, data): ")
    assert done.stdout.splitlines()[-1].startswith("passed: ")
    assert rows(right)["fault/1/dropout"] == "pass"
    assert (right / "score.xml").is_file()
    # What an earlier bench left is replaced.
    wrong.mkdir()
    (wrong / "trace.mcap").write_text("of yesterday", encoding="utf-8")
    meter = example("wrong_meter")
    done = bench(
        tmp_path, "lane.yaml", "--meter", meter, "--topic", "wrong_cmv", "--out", str(wrong)
    )
    assert (done.returncode, done.stderr) == (1, "")
    found = rows(wrong)
    assert found["bias"] == found["rms"] == found["fault/1/dropout"] == "fail"
    assert found["availability"] == "pass"


def test_without_a_meter_the_roller_s_own_is_judged_in_simulated_time(
    lane: Path, tmp_path: Path
) -> None:
    done = bench(tmp_path, str(lane), "--clock", "sim", "--speed", "20")
    assert (done.returncode, done.stderr) == (0, "")
    assert set(rows(tmp_path / "bench" / "lane").values()) == {"pass", "not judged"}


def test_a_meter_that_ends_fails_whatever_it_said(lane: Path, tmp_path: Path) -> None:
    script = tmp_path / "fragile.py"
    # As the example, until the tenth value.
    source = (EXAMPLES / "meter_client.py").read_text(encoding="utf-8")
    count = "self.count = getattr(self, 'count', 0) + 1"
    fail = "assert self.count < 10, 'out of order'"
    call = "self.output.publish(Float64(data=cmv))"
    assert call in source
    script.write_text(source.replace(call, f"{call}; {count}; {fail}"), encoding="utf-8")
    out = tmp_path / "out"
    done = bench(tmp_path, str(lane), "--meter", f"{sys.executable} {script}", "--out", str(out))
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith("roller-sim bench: the meter ended with 1; ")
    assert "AssertionError: out of order" in line
    assert rows(out)["values"] == "fail"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("nowhere.yaml",), "nowhere.yaml: cannot be read"),
        (("soft_to_stif",), "did you mean soft_to_stiff?"),
        (("lane.yaml", "--limits", "none.yaml"), "none.yaml: cannot be read"),
        (("lane.yaml", "--meter", "/no/such/meter"), "the meter cannot be started: /no/such/meter"),
        (("lane.yaml", "--meter", "false"), "the meter ended with 1; "),
        (("lane.yaml", "--domain", "300"), "'300' is not a ROS domain"),
    ],
)
def test_what_cannot_be_run_is_one_line_and_code_2(
    arguments: tuple[str, ...],
    said: str,
    lane: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(lane.parent)
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    assert commands.main(["bench", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("roller-sim bench: error: ")
    assert said in line
