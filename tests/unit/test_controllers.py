# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The example controllers' laws, one measurement at a time, and how measurements are made of messages."""

from __future__ import annotations

import ast
import math
import subprocess
import sys
from dataclasses import replace
from itertools import permutations
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from examples.controllers.force_limiter import ForceLimiter
from examples.controllers.jump_guard import JumpGuard
from examples.controllers.measurement import Collector, Measurement
from examples.controllers.model_based import ModelBased
from examples.controllers.phase_tracker import PhaseTracker
from roller_sim_ros.parameters import Configuration, Exciter, Soil
from roller_sim_ros.session import Session

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "controllers"
NAMES = ("jump_guard", "phase_tracker", "force_limiter", "model_based")

QUIET = Measurement(
    stamp_ns=0,
    revolution=20,
    cmv=30.0,
    rmv=0.1,
    lag_rad=math.radians(150.0),
    frequency_hz=28.0,
    amplitude_m=1.6e-3,
    commanded_frequency_hz=28.0,
    commanded_amplitude_m=1.6e-3,
    vertical=np.zeros((0, 128)),
    phase_rad=math.nan,
)
UNKNOWN = replace(QUIET, cmv=math.nan, rmv=math.nan, lag_rad=math.nan)


@pytest.mark.parametrize("name", NAMES)
def test_controller_is_short_and_its_law_needs_no_ros(name: str) -> None:
    source = (FOLDER / f"{name}.py").read_text(encoding="utf-8")
    assert source.count("\n") < 150
    script = f"import sys, examples.controllers.{name}; sys.exit('rclpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], cwd=FOLDER.parents[1]).returncode == 0


def test_controllers_hear_only_what_a_real_roller_says() -> None:
    tree = ast.parse((FOLDER / "node.py").read_text(encoding="utf-8"))
    words = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant)}
    topics = {"meter", "drum/acceleration", "exciter/state", "exciter/command", "cmd_vel"}
    assert {word for word in words if isinstance(word, str) and "/" in word} < topics
    assert topics < words


@pytest.mark.parametrize("law", [JumpGuard, PhaseTracker, ForceLimiter, ModelBased])
def test_what_is_not_known_changes_nothing(law) -> None:
    controller = law()
    for revolution in range(100):
        command = controller.update(replace(UNKNOWN, revolution=revolution))
        assert (command.frequency_hz, command.amplitude_m) == (28.0, 1.6e-3)


def test_guard_cuts_once_a_window_and_rises_slowly_to_the_first_amplitude() -> None:
    guard = JumpGuard()
    loud = replace(QUIET, rmv=50.0)
    amplitudes = [guard.update(loud).amplitude_m for _ in range(22)]
    assert amplitudes[0] == pytest.approx(0.85 * 1.6e-3)
    assert len(set(amplitudes[:21])) == 1
    assert amplitudes[21] == pytest.approx(0.85**2 * 1.6e-3)
    quiet = [guard.update(QUIET).amplitude_m for _ in range(1000)]
    assert quiet[63] == amplitudes[21]
    assert quiet[64] == pytest.approx(1.0005 * amplitudes[21])
    assert quiet[-1] == 1.6e-3


def test_guard_does_not_cut_below_its_least_amplitude_nor_raise_one_that_began_lower() -> None:
    loud = replace(QUIET, rmv=50.0)
    guard = JumpGuard()
    assert min(guard.update(loud).amplitude_m for _ in range(500)) == 0.4e-3
    guard, small = JumpGuard(), replace(loud, commanded_amplitude_m=0.3e-3)
    assert {guard.update(small).amplitude_m for _ in range(100)} == {0.3e-3}


@pytest.mark.parametrize(("lag_deg", "sign"), [(150.0, -1), (130.0, 1), (140.3, 0)])
def test_tracker_turns_the_frequency_towards_its_setpoint(lag_deg: float, sign: int) -> None:
    tracker = PhaseTracker()
    command = tracker.update(replace(QUIET, lag_rad=math.radians(lag_deg)))
    assert np.sign(command.frequency_hz - 28.0) == sign
    for _ in range(2000):
        command = tracker.update(replace(QUIET, lag_rad=math.radians(lag_deg)))
    assert command.frequency_hz == {-1: 18.0, 0: 28.0, 1: 35.0}[sign]


def test_force_is_estimated_from_acceleration_and_masses() -> None:
    configuration = Configuration(soil=Soil(80e6, 0.5e-3), exciter=Exciter(amplitude_m=0.8e-3))
    session = Session(configuration)
    blocks = [session.advance(128) for _ in range(60)]
    gravity = 9.81
    measurement = replace(
        QUIET,
        amplitude_m=0.8e-3,
        vertical=np.array([it.acceleration_vertical for it in blocks[-16:]]) + gravity,
        phase_rad=0.0,
    )
    true = max(it.soil_force.max() for it in blocks[-4:]) / configuration.machine.static_load_n
    assert ForceLimiter().force_ratio(measurement) == pytest.approx(true, rel=0.01)


def test_limiter_lowers_fast_and_rises_slowly(monkeypatch) -> None:
    limiter = ForceLimiter(limit=3.0)
    measured = replace(QUIET, vertical=np.zeros((16, 128)), phase_rad=0.0)
    monkeypatch.setattr(limiter, "force_ratio", lambda _: 3.6)
    first = limiter.update(measured).amplitude_m
    assert first == pytest.approx(1.6e-3 / 1.2**0.1)
    monkeypatch.setattr(limiter, "force_ratio", lambda _: 2.5)
    assert limiter.update(measured).amplitude_m == pytest.approx(first * 1.2**0.02)
    assert [limiter.update(measured).amplitude_m for _ in range(200)][-1] == 1.6e-3
    monkeypatch.setattr(limiter, "force_ratio", lambda _: 9.0)
    assert [limiter.update(measured).amplitude_m for _ in range(200)][-1] == 0.2e-3


def test_model_based_controller_knows_where_its_model_jumps() -> None:
    controller = ModelBased()
    controller.known = replace(controller.known, soil=Soil(80e6, 0.5e-3))
    assert controller.jumps(28.0, 1.6e-3)
    assert not controller.jumps(28.0, 0.8e-3)
    stiff_hz = controller.resonance_hz()
    controller.known = replace(controller.known, soil=Soil(20e6, 1.1e-3))
    assert controller.resonance_hz() < 0.7 * stiff_hz


def messages() -> list[tuple[str, SimpleNamespace]]:
    """Two revolutions of 28 Hz in blocks of 64, with their meter values and states."""

    def header(sample: int) -> SimpleNamespace:
        second, nanosecond = divmod(round(sample * 1e9 / (28.0 * 128)), 10**9)
        return SimpleNamespace(stamp=SimpleNamespace(sec=second, nanosec=nanosecond))

    blocks = [
        SimpleNamespace(
            sequence=sequence,
            phase_increment=2.0 * math.pi / 128,
            eccentric_phase=math.pi * (sequence % 128 > 0),
            vertical=np.full(64, float(sequence)),
        )
        for sequence in range(0, 256, 64)
    ]
    meters = [
        SimpleNamespace(
            header=header(last),
            last_sample=last,
            cmv=1.0,
            rmv=2.0,
            excitation_frequency=28.0,
            fundamental_phase=0.5,
        )
        for last in (127, 255)
    ]
    states = [
        SimpleNamespace(
            header=header(sample),
            amplitude=a,
            commanded_frequency=28.0,
            commanded_amplitude=2.0 * a,
        )
        for sample, a in ((0, 1e-3), (128, 2e-3))
    ]
    return [
        *(("acceleration", it) for it in blocks),
        *(("meter", it) for it in meters),
        *(("exciter_state", it) for it in states),
    ]


def collected(order: list[tuple[str, SimpleNamespace]]) -> list[Measurement]:
    collector = Collector()
    return [it for name, message in order for it in getattr(collector, name)(message)]


def test_measurements_do_not_depend_on_the_order_between_topics() -> None:
    everything = messages()
    topics = [[it for it in everything if it[0] == name] for name in dict(everything)]
    runs = [collected([it for topic in order for it in topic]) for order in permutations(topics)]
    for run in runs:
        assert [it.revolution for it in run] == [0, 1]
        assert [len(it.vertical) for it in run] == [1, 2]
        # The state that began with a revolution may come before or after the revolution's value: the earlier holds.
        assert [it.amplitude_m for it in run] == [1e-3, 1e-3]
        assert run[1].vertical[:, 127].tolist() == [64.0, 192.0]
        assert run[1].lag_rad == pytest.approx(math.pi - 0.5)
        assert run[1].phase_rad == 0.0


def test_samples_after_a_gap_begin_anew_and_standing_gives_none() -> None:
    everything = messages()
    lost = [it for it in everything if getattr(it[1], "sequence", None) != 64]
    assert [len(it.vertical) for it in collected(lost)] == [0, 1]
    for name, message in everything:
        if name == "acceleration":
            message.phase_increment = 0.0
    assert [len(it.vertical) for it in collected(everything)] == [0, 0]
