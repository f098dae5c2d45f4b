# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Saved states: what goes on from them is the same to the last bit, and nothing in them is run."""

from __future__ import annotations

import hashlib
import json
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.emulation import Emulator, graph
from roller_sim_ros.emulation.snapshot import MAGIC, SnapshotError, restore, save
from roller_sim_ros.faults import Span
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.sensors import Choice
from roller_sim_ros.session import CommandRefused, ExciterCommand, Moment
from roller_sim_ros.wire.messages import Message

SCENARIO = """
lane: {{length_m: 6, cell_m: 0.5}}
travel: {{speed_m_s: 2, passes: 2}}
ground:
  preset: paper-soft
  features: [{{kind: random_field, coefficient_of_variation: 0.3, correlation_length_m: 1.0}}]
  compaction: {{kind: exponential}}
exciter: {{run_up: true, programme: [{{from_s: 0.2, frequency_hz: 31}}]}}
sensors:
  - {{name: {sensor}}}
  - {{name: tacho, parameters: {{jitter_s: 1.0e-5, missing_probability: 0.1}}}}
  - {{name: odometry}}
  - {{name: gnss}}
faults:
  - {{id: spike, from_revolution: 10, parameters: {{probability: 0.05}}}}
  - {{id: dropout, from_revolution: 14, to_revolution: 60}}
  - {{id: reordered, from_revolution: 20}}
  - {{id: lost_pulse, from_revolution: 5}}
  - {{id: clock_skew, from_revolution: 8}}
  - {{id: stuck_amplitude, from_revolution: 30}}
parameters: {{half_space.model: {model}, sampling.floor_hz: 5.0}}
seed: 3
"""

FIXED_RATE = "mems_10g, parameters: {sample_rate_hz: 1700.0, jitter_s: 5.0e-5, clock_skew_ppm: 80.0, latency_s: 4.0e-3}"


def emulator(model: str = "exact", sensor: str = "mems_50g") -> Emulator:
    scenario = parse_scenario(SCENARIO.format(model=model, sensor=sensor), Path("test.yaml"))
    return Emulator(start_ns=1_700_000_000_123_456_789, **start_of(scenario)._asdict())


def run(roller: Emulator, blocks: int, size: int = 16) -> list[Message]:
    return [message for _ in range(blocks) for message in roller.advance(size)]


def disturb(roller: Emulator) -> None:
    """Let all kinds of things come in that are under way when the state is saved."""
    roller.command(vibrate=True, frequency_hz=30.0, amplitude_m=1.1e-3)
    roller.command_travel(-1.0)
    roller.change({"exciter.amplitude_rate_m_per_s": 1e-3})
    roller.inject("noise_burst", {"deviation_m_s2": 3.0}, span=Span(revolutions=9))
    with pytest.raises(CommandRefused):
        roller.command(vibrate=True, frequency_hz=float("nan"), amplitude_m=1e-3)


@pytest.mark.parametrize(
    ("model", "sensor"),
    [
        *(("exact", "ideal"), ("exact", "mems_50g"), ("rational", "mems_50g")),
        *(("two-pole", "ideal"), ("two-pole", "mems_50g"), ("two-pole", FIXED_RATE)),
    ],
)
def test_a_restored_run_goes_on_with_the_same_messages(model: str, sensor: str) -> None:
    roller = emulator(model, sensor)
    for blocks in (0, 1, 36 * 8 + 3):
        run(roller, blocks)
        if blocks > 1:
            disturb(roller)
        other = restore(save(roller))
        expected = run(roller, 45)
        assert run(other, 45) == expected
        assert other.imu_messages() == roller.imu_messages()
    topics = {message.topic for message in expected}
    assert {"tacho", "odom", "fix", "faults", "applied", "site/state", "inputs"} <= topics


def test_saving_changes_nothing_and_shares_nothing() -> None:
    roller, alone = emulator(), emulator()
    run(roller, 100)
    run(alone, 100)
    state = save(roller)
    other = restore(state)
    run(other, 50)
    assert save(roller) == state
    assert run(roller, 50) == run(alone, 50)


def test_what_is_shared_in_a_run_is_shared_in_the_restored_one() -> None:
    roller = emulator()
    run(roller, 400)
    other = restore(save(roller))
    assert other.session.supervision is other.instruments.faults
    spike = other.instruments.faults._entries[0]
    assert spike.active in other.instruments.faults.active
    assert spike.active is not None
    assert spike.random is spike.active.effect._random


def test_another_process_goes_on_with_the_same_messages(tmp_path: Path) -> None:
    roller = emulator()
    run(roller, 333)
    (tmp_path / "state").write_bytes(save(roller))
    program = (
        "import sys, hashlib; from pathlib import Path\n"
        "from roller_sim_ros.emulation.snapshot import restore\n"
        "roller = restore(Path(sys.argv[1]).read_bytes())\n"
        "messages = [it for _ in range(100) for it in roller.advance(16)]\n"
        "print(hashlib.sha256(repr(messages).encode()).hexdigest())\n"
    )
    answer = subprocess.run(
        [sys.executable, "-c", program, tmp_path / "state"],
        check=True,
        capture_output=True,
        text=True,
    )
    assert answer.stdout.strip() == hashlib.sha256(repr(run(roller, 100)).encode()).hexdigest()


def test_a_trace_is_told_of_a_restored_state_only_when_wanted() -> None:
    roller = emulator()
    run(roller, 9)
    roller.release()
    state = save(roller)
    quiet, told = run(restore(state), 1), run(restore(state, told=True), 1)
    assert quiet[0].topic == told[0].topic == "inputs"
    assert quiet == run(roller, 1)
    assert told[1:] == quiet[1:]
    assert state in told[0].data


class Foreign:
    """A programme that is not of the package."""

    def command(self, moment: Moment) -> ExciterCommand:
        del moment
        return ExciterCommand(True, 28.0, 1e-3)


def test_a_part_from_elsewhere_cannot_be_saved() -> None:
    roller = Emulator(Configuration(), start_ns=0, programme=Foreign())
    with pytest.raises(SnapshotError, match="cannot be saved: it holds .*Foreign"):
        save(roller)


def rewritten(state: bytes, change: Callable[[list[Any]], None]) -> bytes:
    """Return a state with other nodes and all checksums right, as a forger makes it."""
    head, _, body = state[len(MAGIC) :].partition(b"\n")
    header = json.loads(head)
    nodes = json.loads(body[: header["text_bytes"]])
    change(nodes)
    text = json.dumps(nodes).encode()
    body = text + body[header["text_bytes"] :]
    header |= {
        "text_bytes": len(text),
        "bytes": len(body),
        "sha256": hashlib.sha256(body).hexdigest(),
    }
    return MAGIC + json.dumps(header).encode() + b"\n" + body


def replaced(node: list[Any]) -> Callable[[list[Any]], None]:
    def change(nodes: list[Any]) -> None:
        nodes[next(i for i, item in enumerate(nodes) if item[0] == "object")] = node

    return change


@pytest.mark.parametrize(
    "change",
    [
        replaced(["object", "subprocess:Popen", {"args": "true"}]),
        replaced(["object", "builtins:object", {}]),
        replaced(["object", "roller_sim_ros.commands:main", {}]),
        replaced(["object", "roller_sim_ros.traces.writer:TraceWriter", {}]),
        replaced(["object", "roller_sim_ros.emulation.snapshot:subprocess", {}]),
        replaced(["object", "roller_sim_ros.session.command:Master", {}]),
        replaced(["object", "roller_sim_ros.parameters.machine:Machine", {"drum_mass_kg": 1.0}]),
        replaced(["enum", "roller_sim_ros.session.command:Master", 77]),
        replaced(["named", "roller_sim_ros.site.travel:Leg", [1.0]]),
        replaced(["array", "object", [1], 0, 8]),
        replaced(["array", "float64", [1 << 40], 0, 8]),
        replaced(["array", "float64", [-1], 0, 8]),
        replaced(["bytes", 0, 1 << 40]),
        replaced(["random", {"bit_generator": "PCG64"}]),
        replaced(["tuple", [[10**6]]]),
        replaced(["tuple", [[-1]]]),
        replaced(["root", []]),
        replaced(["value", [1]]),
        replaced([1, 2]),
        replaced([]),
        lambda nodes: nodes.clear(),
        lambda nodes: nodes.append(3),
        lambda nodes: nodes.__setitem__(-1, ["root", 5]),
        lambda nodes: nodes.__setitem__(-1, ["root", [1]]),
    ],
)
def test_a_forged_state_is_refused(change: Callable[[list[Any]], None]) -> None:
    state = rewritten(save(Emulator(Configuration(), start_ns=0)), change)
    with pytest.raises(SnapshotError, match="^the saved state is damaged: ") as refusal:
        restore(state)
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 400


def test_parameters_of_a_forged_state_are_checked() -> None:
    def change(nodes: list[Any]) -> None:
        for node in nodes:
            if node[0] == "object" and node[1].endswith(":Machine"):
                node[2]["drum_mass_kg"] = -1.0

    state = rewritten(save(Emulator(Configuration(), start_ns=0)), change)
    with pytest.raises(SnapshotError, match="drum_mass_kg"):
        restore(state)


def with_attribute(kind: str, name: str, value: Any) -> Callable[[list[Any]], None]:
    """Return what gives an attribute of an object of a class another value; a list is that of a new node."""

    def change(nodes: list[Any]) -> None:
        node = next(item for item in nodes if item[0] == "object" and item[1].endswith(f":{kind}"))
        assert name in node[2]
        if isinstance(value, list):
            nodes.insert(-1, value)
            node[2][name] = [len(nodes) - 2]
        else:
            node[2][name] = value

    return change


SHORT = ["array", "float64", [1], 0, 8]
THIN = ["array", "float64", [0, 1], 0, 0]


@pytest.mark.parametrize(
    ("model", "kind", "name", "value"),
    [
        ("exact", "Session", "_samples", 10**6),
        ("exact", "Session", "_next_sample", -5),
        ("exact", "ExactGround", "_samples", 10**6),
        ("exact", "ExactGround", "state", SHORT),
        ("exact", "ExactGround", "_sine", SHORT),
        ("exact", "ExactGround", "_free", SHORT),
        ("exact", "ExactGround", "_free_rate", SHORT),
        ("exact", "ExactGround", "_bends", THIN),
        ("rational", "RationalGround", "_modes", THIN),
        ("rational", "RationalGround", "_bends", THIN),
        ("two-pole", "TwoPoleGround", "_constants", SHORT),
        ("two-pole", "RevolutionCollector", "_samples", THIN),
        ("two-pole", "HarmonicsWindow", "_products", SHORT),
        ("two-pole", "PeriodWindow", "_revolutions", THIN),
        ("two-pole", "PeriodWindow", "window_revolutions", 10**9),
        ("two-pole", "PeriodWindow", "_pushed", 0.5),
        ("two-pole", "TruthMeter", "_air", THIN),
        ("two-pole", "TruthMeter", "_forces", SHORT),
        ("two-pole", "TruthMeter", "_revolutions", 0.5),
        ("two-pole", "GaussMarkov", "_state", ["array", "float64", [0], 0, 0]),
        ("two-pole", "LowPass", "_states", SHORT),
        ("two-pole", "OrderTracker", "_kept", THIN),
        ("two-pole", "OrderTracker", "_kept_from", -(10**9)),
        ("two-pole", "_Begun", "length", -1e9),
        ("two-pole", "FixedRate", "_kept", THIN),
        ("two-pole", "FixedRate", "_kept_from", 10**9),
        ("two-pole", "_Revolution", "places", SHORT),
    ],
)
def test_arrays_that_a_compiled_loop_would_leave_are_refused(
    model: str, kind: str, name: str, value: Any
) -> None:
    sheet = {"sample_rate_hz": 1700.0, "drift_m_s2": 0.1, "noise_density": 1e-3}
    roller = Emulator(
        Configuration().changed({"half_space.model": model}),
        start_ns=0,
        sensors=(Choice("mems_50g", sheet),),
    )
    run(roller, 9)
    state = save(roller)
    restore(state)
    with pytest.raises(SnapshotError, match="^the saved state is damaged: "):
        restore(rewritten(state, with_attribute(kind, name, value)))


class Harmful:
    """What a pickle of this runs when it is read."""

    def __reduce__(self) -> tuple[Any, ...]:
        return print, ("run",)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda _: b"", "no saved state"),
        (lambda state: b"\x80\x04" + state, "no saved state"),
        (lambda _: pickle.dumps(Harmful()), "no saved state"),
        (lambda state: state.replace(b"state 1\n", b"state 2\n", 1), "another form"),
        (lambda state: state.replace(b'"version": "', b'"version": "9', 1), "of version 9"),
        (lambda state: state[:-1], "is damaged"),
        (lambda state: state + b"1", "is damaged"),
        (lambda state: state[: len(MAGIC)], "header"),
        (lambda state: state[:-9] + b"x" + state[-8:], "checksum"),
        (lambda _: MAGIC + b"[" * 900 + b"\n", "header"),
        (lambda _: MAGIC + b"{}\n", "header"),
    ],
)
def test_what_is_no_state_is_refused_in_one_line(
    change: Callable[[bytes], bytes], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    state = change(save(Emulator(Configuration(), start_ns=0)))
    with pytest.raises(SnapshotError, match=message) as refusal:
        restore(state)
    assert "\n" not in str(refusal.value)
    assert capsys.readouterr().out == ""


def test_a_damaged_byte_anywhere_is_noticed() -> None:
    state = save(Emulator(Configuration(), start_ns=0))
    random = np.random.default_rng(1)
    for place in random.integers(len(MAGIC), len(state), 60):
        damaged = bytearray(state)
        damaged[place] ^= 0x10
        with pytest.raises(SnapshotError):
            restore(bytes(damaged))


def test_objects_that_share_and_refer_back_come_out_as_they_were() -> None:
    shared = np.arange(3.0)
    item: dict[str, Any] = {"a": shared, "b": [shared, (1, None, True, "ü", -0.0, float("nan"))]}
    item["self"] = item
    item["set"] = {1, 2}
    item["scalar"] = np.float32(0.1)
    found = graph.read(json.loads(json.dumps(graph.write(item)[0])), graph.write(item)[1])
    assert found["self"] is found
    assert found["a"] is found["b"][0]
    assert found["b"][1][:4] == (1, None, True, "ü")
    assert np.signbit(found["b"][1][4])
    assert np.isnan(found["b"][1][5])
    assert found["set"] == {1, 2}
    assert found["scalar"] == np.float32(0.1)
    assert found["scalar"].dtype == np.float32
