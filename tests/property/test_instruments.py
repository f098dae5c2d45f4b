# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sensors and faults: the size of the blocks has no part in them, and one stream of numbers changes no other."""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.emulation.instruments import Instruments
from roller_sim_ros.faults import FAULTS, FaultRefused, Scheduled
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.scenario.window import Window
from roller_sim_ros.sensors import Choice, Reading
from roller_sim_ros.session import Session
from roller_sim_ros.wire.types import decode

CONFIGURATION = Configuration().changed(
    {
        "half_space.model": "two-pole",
        "soil.shear_modulus_pa": 35e6,
        "soil.plastic_parameter_m": 8e-4,
    }
)
SENSORS: Mapping[str, Choice] = {
    "ideal": Choice("ideal"),
    "mems_10g": Choice("mems_10g"),
    "fixed rate": Choice(
        "mems_50g",
        {"sample_rate_hz": 1700.0, "jitter_s": 5e-5, "clock_skew_ppm": 80.0, "drift_m_s2": 0.2},
    ),
}
OTHERS = (
    Choice("tacho", {"jitter_s": 1e-5, "missing_probability": 0.2, "phase_rad": 2.0}),
    Choice("odometry"),
    Choice("gnss"),
)


def instruments(sensor: Choice, faults: tuple[str, ...], seed: int) -> tuple[Session, Instruments]:
    session = Session(CONFIGURATION, run_up=True)
    session.command_travel(1.0)
    window = Window(from_revolution=3, to_revolution=9)
    scheduled = [Scheduled(fault, window) for fault in faults]
    return session, Instruments(session, (sensor, *OTHERS), scheduled, seed)


def step(session: Session, roller: Instruments, size: int) -> tuple[list[Reading], list[Any]]:
    block = session.advance(size)
    readings = roller.read(block)
    others = [
        decode(item.data, item.type_name)
        for item in roller.messages(block, 0)
        if item.topic != "faults"
    ]
    return readings, others


def run(session: Session, roller: Instruments, sizes: list[int], revolutions: int) -> list[Any]:
    """Return samples, their indices and clipping, and what the other sensors say, as comparable lists."""
    readings: list[Reading] = []
    others: list[Any] = []
    for _ in range(revolutions):
        for size in sizes:
            new, more = step(session, roller, size)
            readings += new
            others += more
    samples = [
        (int(index), float(v), float(h), int(c))
        for item in readings
        for index, v, h, c in zip(
            item.first_sample + np.arange(len(item)),
            item.vertical,
            item.horizontal,
            item.clipped if len(item.clipped) else np.zeros(len(item)),
            strict=True,
        )
    ]
    return [samples, sorted(map(repr, others))]


cuts = st.lists(st.integers(1, 127), max_size=4).map(
    lambda places: np.diff(sorted({0, 128, *places})).tolist()
)


@settings(max_examples=20, deadline=None)
@given(
    sensor=st.sampled_from(sorted(SENSORS)),
    faults=st.lists(
        st.sampled_from(sorted(set(FAULTS) - {"reordered", "duplicate"})), unique=True, max_size=3
    ),
    sizes=cuts,
    seed=st.integers(0, 2**32),
)
def test_block_size_changes_no_bit(
    sensor: str, faults: list[str], sizes: list[int], seed: int
) -> None:
    # What comes twice or in the wrong order are messages, and those are what blocks make them.
    if "stuck" in faults:
        faults = ["stuck"]
    whole, parts = (
        run(*instruments(SENSORS[sensor], tuple(faults), seed), cut, 12) for cut in ([128], sizes)
    )
    # Finer blocks may bring samples of a late sensor a little earlier.
    assert abs(len(whole[0]) - len(parts[0])) <= 128 * 12
    common = min(len(whole[0]), len(parts[0]))
    assert whole[0][:common] == parts[0][:common]
    assert whole[1] == parts[1]
    if "delay" not in faults:
        assert common > 10 * 50


def test_numbers_of_one_sensor_and_one_fault_are_those_of_no_other() -> None:
    """A noisier tacho, a receiver less or a fault more leave the accelerometer's samples as they were."""
    alone = Session(CONFIGURATION)
    suite = Instruments(alone, (SENSORS["fixed rate"],), (), 5)
    first = run(alone, suite, [128], 12)[0]
    session, roller = instruments(SENSORS["fixed rate"], ("lost_pulse", "stale_position"), 5)
    # Compared on the same motion: this one runs up, the other does not.
    other = Session(CONFIGURATION)
    crowded = Instruments(
        other,
        (SENSORS["fixed rate"], *OTHERS),
        [Scheduled("lost_pulse", Window()), Scheduled("stale_position", Window())],
        5,
    )
    assert run(other, crowded, [128], 12)[0] == first
    assert run(session, roller, [128], 12)[0] != first


@pytest.mark.parametrize("sensor", sorted(SENSORS))
def test_a_saved_state_goes_on_with_the_same_bits(sensor: str) -> None:
    faults = ("spike", "noise_burst", "dropout", "lost_pulse", "clock_skew")
    session, roller = instruments(SENSORS[sensor], faults, 3)
    run(session, roller, [128], 6)
    sensors, engine, delivery = pickle.loads(
        pickle.dumps((roller.suite, roller.faults, roller._delivery))
    )
    expected = run(session, roller, [128], 6)
    again, other = instruments(SENSORS[sensor], faults, 3)
    run(again, other, [128], 6)
    other.suite, other.faults, other._delivery = sensors, engine, delivery
    again.supervision = engine
    assert run(again, other, [128], 6) == expected


@settings(max_examples=200, deadline=None)
@given(
    fault=st.sampled_from([*FAULTS, "", "no such fault"]),
    values=st.dictionaries(
        st.sampled_from(["axis", "probability", "bias_m_s2", "skew_ppm", "factor", "x"]),
        st.one_of(st.floats(), st.text(max_size=3), st.integers(), st.booleans(), st.none()),
        max_size=2,
    ),
)
def test_whatever_is_asked_for_is_done_or_refused_in_words(
    fault: str, values: dict[str, Any]
) -> None:
    session = Session(CONFIGURATION)
    roller = Instruments(session)
    refusal = None
    try:
        roller.faults.inject(fault, values)
    except (FaultRefused, ParameterError) as error:
        refusal = str(error)
    assert refusal is None or len(refusal) > 10
    step(session, roller, 128)
    assert bool(roller.faults.active) is (refusal is None)
