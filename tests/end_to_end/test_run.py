# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim run``: settled values, trace, plot, and what is said when something is wrong."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from roller_sim_ros import commands
from roller_sim_ros.parameters import PARAMETERS, Configuration
from roller_sim_ros.session import Session
from roller_sim_ros.traces.metadata import PARAMETERS as PARAMETERS_RECORD
from roller_sim_ros.traces.metadata import RUN
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.topics import FURTHER_METERS, TOPICS
from roller_sim_ros.wire.types import decode

ROOT = Path(__file__).resolve().parents[2]
CASES: list[dict[str, Any]] = json.loads(
    (ROOT / "tests" / "reference" / "cases.json").read_text(encoding="utf-8")
)["cases"]
DOUBLE_JUMP = ("--shear-modulus-mpa", "80", "--plastic-mm", "0.5")
PNG = b"\x89PNG\r\n\x1a\n"


def run(*arguments: object) -> int:
    return commands.main(["run", *map(str, arguments)])


def result(capsys: pytest.CaptureFixture[str], *arguments: object) -> dict[str, Any]:
    """Run with --json - and return the object, which is all that is printed."""
    capsys.readouterr()
    assert run(*arguments, "--json", "-") == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


@pytest.mark.parametrize("index", range(0, len(CASES), 4))
def test_flags_lead_to_the_reference_values(index: int, capsys: pytest.CaptureFixture[str]) -> None:
    case = CASES[index]
    found = result(
        capsys,
        *("--frequency-hz", case["frequency_hz"], "--amplitude-mm", case["amplitude_mm"]),
        *("--shear-modulus-mpa", case["shear_modulus_mpa"], "--plastic-mm", case["plastic_mm"]),
        *("--half-space", case["half_space"], "--area-factor", case["area_factor"]),
        *("--revolutions", case["revolutions"]),
    )
    tolerance = 0.01 if case["half_space"] == "exact" else 0.02
    assert found["period"] == case["period"]
    for name in ("force_ratio_max", "cmv", "acceleration_max_g", "acceleration_min_g"):
        assert found[name] == pytest.approx(case[name], rel=tolerance), name
    assert found["rmv"] == pytest.approx(case["rmv"], rel=tolerance, abs=0.5)
    assert found["air_fraction"] == pytest.approx(case["air_fraction"], abs=2.0 / 128.0)
    assert found["notes"] == []


def test_the_object_holds_every_parameter_in_si_units(capsys: pytest.CaptureFixture[str]) -> None:
    found = result(capsys, "--revolutions", 80, *DOUBLE_JUMP, "--amplitude-mm", "0.65")
    expected = Configuration().changed(
        {
            "soil.shear_modulus_pa": 80e6,
            "soil.plastic_parameter_m": 0.5e-3,
            "exciter.amplitude_m": 0.65e-3,
        }
    )
    assert found["parameters"] == expected.flat()
    assert found["revolutions"] == 80
    assert found["summary_revolutions"] == 64
    assert found["duration_s"] == pytest.approx(80 / 28.0)
    assert found["excitation_hz"] == 28.0


def test_the_table_says_what_the_object_says(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.json"
    assert run("--shear-modulus-mpa", 35, "--plastic-mm", 0.8, "--json", path) == 0
    output = capsys.readouterr()
    found = json.loads(path.read_text(encoding="utf-8"))
    rows = dict(re.split(r"  +", line, maxsplit=1) for line in output.out.splitlines())
    assert rows["mode"] == f"partial uplift, period {found['period']}"
    assert rows["CMV"] == f"{found['cmv']:.3f}"
    assert rows["F_max/F_stat"] == f"{found['force_ratio_max']:.4f}"
    assert rows["ground"].startswith("G 35 MPa, p 0.8 mm")
    assert rows["in the air"] == f"{100 * found['air_fraction']:.2f} %"
    assert output.err == ""


def test_the_last_revolutions_are_an_even_number_up_to_64(
    capsys: pytest.CaptureFixture[str],
) -> None:
    kept = {count: result(capsys, "--revolutions", count) for count in (2, 3, 65)}
    assert [found["summary_revolutions"] for found in kept.values()] == [2, 2, 64]
    assert kept[3]["rmv"] is not None
    assert kept[2]["period"] is None
    assert kept[2]["notes"] == ["too few revolutions to tell the period"]


def test_a_run_up_comes_to_the_same_motion(capsys: pytest.CaptureFixture[str]) -> None:
    soil = ("--shear-modulus-mpa", 35, "--plastic-mm", 0.8)
    at_once, run_up = (result(capsys, *soil, *option) for option in ((), ("--run-up",)))
    assert run_up["duration_s"] > at_once["duration_s"] + 1.0
    assert run_up["cmv"] == pytest.approx(at_once["cmv"], rel=1e-3)
    assert run_up["period"] == at_once["period"] == 1


UNKNOWN = ("period", "cmv", "rmv", "mode", "blows_per_period")


@pytest.mark.parametrize(
    ("arguments", "note"),
    [
        (("--frequency-hz", 0), "the eccentric stands: "),
        (
            ("--frequency-hz", 8),
            "below the sampling floor of 10 Hz, 128 samples are 1/10 s and no ",
        ),
        (("--run-up",), "the frequency changed within the last 64 revolutions, "),
    ],
)
def test_where_there_are_no_revolutions_it_says_so(
    arguments: tuple[object, ...], note: str, capsys: pytest.CaptureFixture[str]
) -> None:
    found = result(capsys, *arguments, "--revolutions", 80)
    assert [found[name] for name in UNKNOWN] == [None] * len(UNKNOWN)
    assert found["force_ratio_max"] >= 1.0
    (said,) = found["notes"]
    assert said.startswith(note)
    assert "period, CMV and RMV are unknown" in said
    assert run(*arguments, "--revolutions", 80) == 0
    table = capsys.readouterr().out
    assert said in table
    assert re.search(r"^CMV +unknown$", table, flags=re.MULTILINE)


def test_other_numbers_of_samples_give_the_same_motion(capsys: pytest.CaptureFixture[str]) -> None:
    coarse, fine = (result(capsys, "--samples-per-rev", n, *DOUBLE_JUMP) for n in (128, 512))
    assert fine["parameters"]["sampling.samples_per_revolution"] == 512
    assert fine["period"] == coarse["period"] == 2
    assert fine["cmv"] == pytest.approx(coarse["cmv"], rel=0.025)
    assert fine["cmv"] != coarse["cmv"]


def test_a_file_of_parameters_holds_unless_a_flag_is_given(
    capsys: pytest.CaptureFixture[str],
) -> None:
    dense = ROOT / "config" / "dense.yaml"
    found = result(capsys, "--revolutions", 10, "--params", dense, "--plastic-mm", 0.45)
    assert found["parameters"]["soil.shear_modulus_pa"] == 80e6
    assert found["parameters"]["soil.plastic_parameter_m"] == 0.45e-3


def test_the_trace_holds_the_node_s_topics_and_the_run_s_samples(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "trace.mcap"
    found = result(capsys, *DOUBLE_JUMP, "--revolutions", 70, "--run-up", "--record", path)
    reader = TraceReader(path)
    assert set(reader.topics) <= {topic.resolved() for topic in TOPICS}
    assert {name: info.messages for name, info in reader.topics.items()} == {
        "/drum/acceleration": 70 * 8,
        "/truth": 70 * 8,
        "/meter": 70,
        "/cmv": 70,
        **{topic.resolved(): 70 for topic in FURTHER_METERS},
        "/site/state": 70,
        "/exciter/state": reader.topics["/exciter/state"].messages,
        "/inputs": 1,
        "/faults": 1,
        "/machine": 1,
        "/soil": 1,
        "/parameter_events": 1,
    }
    session = Session(
        Configuration().changed(
            {"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3}
        ),
        run_up=True,
    )
    blocks = [session.advance(128) for _ in range(70)]
    expected = np.concatenate([block.acceleration_vertical for block in blocks])
    recorded = np.concatenate(
        [
            decode(item.data, item.type_name).vertical
            for item in reader.messages(["/drum/acceleration"])
        ]
    )
    assert recorded.tobytes() == expected.astype(np.float32).tobytes()
    # A message is there at the end of its block.
    start_ns = int(reader.metadata[RUN]["start_time_ns"])
    times = [item.log_time_ns for item in reader.messages(["/truth"])]
    assert times == sorted(times)
    assert (times[-1] - start_ns) * 1e-9 == pytest.approx(found["duration_s"], abs=1e-8)
    assert reader.metadata[PARAMETERS_RECORD]["soil.shear_modulus_pa"] == "80000000.0"
    assert commands.main(["analyze", str(path), "--json", "-"]) == 0
    analysis = json.loads(capsys.readouterr().out)
    assert (analysis["gaps"], analysis["samples"]) == (0, 70 * 128)
    assert analysis["recorded_meter"]["max_difference"]["cmv"] == 0.0


def test_recording_does_not_change_the_result(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plain = result(capsys, *DOUBLE_JUMP, "--revolutions", 100)
    recorded = result(capsys, *DOUBLE_JUMP, "--revolutions", 100, "--record", tmp_path / "t.mcap")
    path = recorded["parameters"].pop("recording.path")
    assert path == str(tmp_path / "t.mcap")
    del plain["parameters"]["recording.path"]
    assert recorded == plain


@pytest.mark.parametrize(
    "arguments", [DOUBLE_JUMP, ("--frequency-hz", 8), ("--amplitude-mm", 0), ("--revolutions", 2)]
)
def test_the_plot_is_drawn(
    arguments: tuple[object, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run.png"
    assert run("--revolutions", 70, *arguments, "--plot", path) == 0
    assert path.read_bytes().startswith(PNG)
    assert "F_max/F_stat" in capsys.readouterr().out


def test_the_plot_of_other_formats(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "run.svg"
    assert run("--revolutions", 70, *DOUBLE_JUMP, "--plot", path) == 0
    assert "in the air" in capsys.readouterr().out
    assert "<svg" in path.read_text(encoding="utf-8")


def test_progress_is_shown_once_per_percent(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--revolutions", 300, "--progress") == 0
    shown = capsys.readouterr().err.splitlines()
    assert shown == [f"running {percent} %" for percent in range(1, 101)]


BAD = {
    "too far": (("--amplitude-mm", 50), "--amplitude-mm = 50.0: must be 0 … 5 mm"),
    "not finite": (("--frequency-hz", "nan"), "--frequency-hz = nan: must be 0 … 80 Hz"),
    "no choice": (("--half-space", "clay"), "--half-space = 'clay': must be one of exact"),
    "wrong key": (
        ("--params", "key.yaml"),
        "key.yaml: soil.shear_modulus_mpa = 35: there is no such",
    ),
    "wrong unit": (
        ("--params", "unit.yaml"),
        "unit.yaml: soil.shear_modulus_pa = 35: must be at least",
    ),
    "no file": (("--params", "none.yaml"), "none.yaml: cannot be read: No such file or directory"),
    "trace is there": (("--record", "there.mcap"), "there.mcap: there already is such a file"),
    "no folder": (("--record", "no/t.mcap"), "no/t.mcap: there is no folder no"),
    "samples": (
        ("--record", "t.mcap", "--samples-per-rev", 256),
        "sampling.samples_per_revolution = 256: messages and traces need 128 samples",
    ),
    "full disk": (("--record", "/dev/full"), "/dev/full: "),
    "plot format": (("--plot", "run.xyz"), "run.xyz: cannot be drawn: "),
    "plot folder": (("--plot", "no/run.png"), "no/run.png: cannot be written: No such file"),
    "json folder": (("--json", "no/run.json"), "no/run.json: cannot be written: No such file"),
}


@pytest.mark.parametrize(("arguments", "reason"), BAD.values(), ids=BAD)
def test_bad_input_is_refused_in_one_line(
    arguments: tuple[object, ...],
    reason: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "key.yaml").write_text("soil: {shear_modulus_mpa: 35}\n", encoding="utf-8")
    (tmp_path / "unit.yaml").write_text("soil: {shear_modulus_pa: 35}\n", encoding="utf-8")
    (tmp_path / "there.mcap").write_bytes(b"precious")
    assert run("--revolutions", 4, *arguments) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"roller-sim run: error: {reason}")
    assert (tmp_path / "there.mcap").read_bytes() == b"precious"
    assert not (tmp_path / "t.mcap").exists()


@pytest.mark.parametrize("count", ["1", "0", "-3", "many"])
def test_a_wrong_number_of_revolutions_is_refused(
    count: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as caught:
        run("--revolutions", count)
    assert caught.value.code == 2
    assert "--revolutions" in capsys.readouterr().err


def test_help_shows_every_flag_with_unit_default_and_bounds(
    capsys: pytest.CaptureFixture[str],
) -> None:
    with pytest.raises(SystemExit) as caught:
        run("--help")
    assert caught.value.code == 0
    text = " ".join(capsys.readouterr().out.split())
    for name, (quantity, default) in PARAMETERS.items():
        if quantity.flag:
            assert re.search(rf"{quantity.flag} \S+ {re.escape(quantity.doc.split()[0])}", text), (
                name
            )
            if isinstance(default, float):
                shown = f"(default: {default / quantity.scale:g} {quantity.flag_unit}".rstrip()
                assert shown in text, name
    assert "0.02 … 20 mm (default: 0.65 mm)" in text


def test_an_interrupted_recording_is_a_whole_trace(tmp_path: Path) -> None:
    path = tmp_path / "trace.mcap"
    program = textwrap.dedent(
        """
        import sys
        from roller_sim_ros import commands
        from roller_sim_ros.session import Session

        advance = Session.advance

        def interrupted(self, samples):
            if self.next_sample == 128 * 20:
                raise KeyboardInterrupt
            return advance(self, samples)

        Session.advance = interrupted
        sys.exit(commands.main(sys.argv[1:]))
        """
    )
    done = subprocess.run(
        [sys.executable, "-c", program, "run", "--record", str(path)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")
    reader = TraceReader(path)
    assert reader.whole
    assert reader.topics["/truth"].messages == 20 * 8


def test_it_works_where_ros_is_absent(tmp_path: Path) -> None:
    program = textwrap.dedent(
        """
        import sys

        class NoRos:
            def find_spec(self, name, path=None, target=None):
                top = name.split(".")[0]
                if top in ("rclpy", "std_msgs", "sensor_msgs", "rcl_interfaces") or name == MESSAGES:
                    raise ModuleNotFoundError(f"No module named {name!r} (blocked)", name=name)

        MESSAGES = "roller_sim_ros.msg"
        sys.meta_path.insert(0, NoRos())
        from roller_sim_ros import commands
        sys.exit(commands.main(sys.argv[1:]))
        """
    )
    files = ("--record", str(tmp_path / "t.mcap"), "--plot", str(tmp_path / "run.png"))
    done = subprocess.run(
        [sys.executable, "-c", program, "run", "--revolutions", "70", *files],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "AMENT_PREFIX_PATH": ""},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "F_max/F_stat" in done.stdout
    assert TraceReader(tmp_path / "t.mcap").whole
