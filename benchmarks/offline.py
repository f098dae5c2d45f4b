# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How many times faster than real time the roller runs without ROS, and what its saved state costs."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from statistics import median

from benchmarks.options import Options
from benchmarks.table import Table, ratio, seconds
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.snapshot import restore, save
from roller_sim_ros.offline.run import run, step_whole_revolutions
from roller_sim_ros.offline.scenario_run import run_scenario, step_with_faults
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.scenario import Start, read_scenario, start_of
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.session import Session

REVOLUTIONS = 500
ROUNDS = 5
HALF_SPACES = ("two-pole", "rational", "exact")
SCENARIO, GRADIENT = "ten_passes_to_refusal", "soft_to_stiff"
HZ = 28.0
GROUNDS = (
    "On a lane the half space is made anew for every ground that the roller meets: two-pole by a formula, exact by its "
    "closed form, rational by a fit."
)

Timed = Callable[[str], float]
"""Returns the CPU time of one revolution on a half space, s."""


def measure(_options: Options) -> Table:
    """Time every way on every half space."""
    ways: list[tuple[str, Timed, str]] = [
        ("roller-sim run", _plain, "≥ 1000"),
        ("session on a scenario's lane", _lane, "≥ 1000"),
        ("session on a gradient, no ground twice", _gradient, ""),
        ("roller-sim run SCENARIO, with its map", _scenario, ""),
        ("all messages, blocks of 128 samples", lambda model: _messages(model, 128), ""),
        ("all messages, blocks of 16 samples", lambda model: _messages(model, 16), ""),
    ]
    rows = [
        (name, *(ratio(1.0 / HZ / timed(model)) for model in HALF_SPACES), aim)
        for name, timed, aim in ways
    ]
    state, save_s, restore_s = _state()
    note = (
        f"A saved state of `{SCENARIO}` has {len(state) / 1e3:.0f} kB; it is saved in {seconds(save_s)} and restored "
        f"in {seconds(restore_s)}."
    )
    return Table(
        title="Without ROS",
        says=(
            "Simulated time over CPU time of one core, at 28 Hz: how many times faster than real time. With messages "
            "means all that the node publishes, as bytes; what a trace adds is its compression. The scenario is "
            f"`{SCENARIO}`, with the gradient `{GRADIENT}`. Medians of {ROUNDS} rounds of {REVOLUTIONS} revolutions."
        ),
        columns=("way", *HALF_SPACES, "aim"),
        rows=rows,
        notes=[
            GROUNDS,
            note,
        ],
    )


def _median(action: Callable[[], object], rounds: int = ROUNDS) -> float:
    times = []
    for _ in range(rounds):
        begin = time.thread_time()
        action()
        times.append(time.thread_time() - begin)
    return median(times)


def _configuration(model: str) -> Configuration:
    return Configuration().changed({"half_space.model": model})


def _start(model: str, scenario: str = SCENARIO) -> Start:
    start = start_of(read_scenario(shipped_scenarios()[scenario]))
    half_space = replace(start.configuration.half_space, model=model)
    return start._replace(configuration=replace(start.configuration, half_space=half_space))


def _plain(model: str) -> float:
    step = step_whole_revolutions(_configuration(model), run_up=False)
    run(step, 50, SAMPLES_PER_REVOLUTION, _unseen)
    return _median(lambda: run(step, REVOLUTIONS, SAMPLES_PER_REVOLUTION, _unseen)) / REVOLUTIONS


def _lane(model: str) -> float:
    return _driven(_start(model).session(), REVOLUTIONS, ROUNDS)


def _gradient(model: str) -> float:
    # Within the one pass that the scenario has.
    return _driven(_start(model, GRADIENT).session(), 300, 3)


def _driven(session: Session, revolutions: int, rounds: int) -> float:
    def drive() -> None:
        for _ in range(revolutions):
            session.advance(SAMPLES_PER_REVOLUTION)

    drive()
    return _median(drive, rounds) / revolutions


def _scenario(model: str) -> float:
    scenario = read_scenario(shipped_scenarios()[SCENARIO])
    start = _start(model)
    session = start.session()
    step = step_with_faults(session, start)
    run_scenario(scenario, session, step, _unseen, 50)
    return (
        _median(lambda: run_scenario(scenario, session, step, _unseen, REVOLUTIONS)) / REVOLUTIONS
    )


def _messages(model: str, samples: int) -> float:
    emulator = Emulator(_configuration(model), start_ns=0)

    def drive() -> None:
        for _ in range(REVOLUTIONS * SAMPLES_PER_REVOLUTION // samples):
            emulator.advance(samples)

    drive()
    return _median(drive, 3) / REVOLUTIONS


def _state() -> tuple[bytes, float, float]:
    emulator = Emulator(start_ns=0, **_start("exact")._asdict())
    for _ in range(100):
        emulator.advance(SAMPLES_PER_REVOLUTION)
    state = save(emulator)
    return state, _median(lambda: save(emulator), 15), _median(lambda: restore(state), 15)


def _unseen(_: float) -> None:
    """Show no progress."""
