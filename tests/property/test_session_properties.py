# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What holds for every way of driving a session, and for its time, whatever is commanded when."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import Applied, Block, Session
from roller_sim_ros.wire.types import decode

SAMPLES = 128
TURN = 2.0 * math.pi
MODELS = ("exact", "rational", "two-pole")
FREQUENCIES = st.one_of(st.just(0.0), st.floats(0.0, 45.0))
AMPLITUDES = st.floats(0.0, 2.5e-3)
SOILS = st.tuples(st.floats(15e6, 120e6), st.floats(3e-4, 1.5e-3))


@dataclass(frozen=True)
class Event:
    """A command or a change that is given before a sample."""

    sample: int
    command: tuple[bool, float, float] | None = None
    soil: tuple[float, float] | None = None

    def give(self, session: Session | Emulator) -> None:
        if self.command is not None:
            vibrate, frequency_hz, amplitude_m = self.command
            values = {"vibrate": vibrate, "frequency_hz": frequency_hz, "amplitude_m": amplitude_m}
            if isinstance(session, Emulator):
                session.command(**values)  # type: ignore[arg-type]
            else:
                session.command_exciter(**values)  # type: ignore[arg-type]
        if self.soil is not None:
            session.change(
                {
                    "soil.shear_modulus_pa": self.soil[0],
                    "soil.plastic_parameter_m": self.soil[1],
                }
            )


REVOLUTIONS = 24
EVENTS = st.lists(
    st.builds(
        Event,
        sample=st.integers(0, REVOLUTIONS * SAMPLES - 1),
        command=st.one_of(st.none(), st.tuples(st.booleans(), FREQUENCIES, AMPLITUDES)),
        soil=st.one_of(st.none(), SOILS),
    ),
    max_size=5,
).map(lambda events: sorted(events, key=lambda event: event.sample))
BLOCKS = st.lists(st.integers(1, SAMPLES), min_size=1, max_size=12)
"""Sizes of blocks that are asked for in turn."""

STARTS = st.fixed_dictionaries(
    {
        "half_space.model": st.sampled_from(MODELS),
        "exciter.kind": st.sampled_from(("circular", "directed")),
        "exciter.tilt_rad": st.floats(-0.5, 0.5),
        "exciter.frequency_hz": FREQUENCIES,
        "exciter.amplitude_m": AMPLITUDES,
        "exciter.frequency_rate_hz_per_s": st.sampled_from((10.0, 60.0)),
        "exciter.amplitude_rate_m_per_s": st.sampled_from((2e-3, 0.1)),
        "soil.shear_modulus_pa": st.floats(15e6, 120e6),
        "soil.plastic_parameter_m": st.floats(3e-4, 1.5e-3),
    }
)


def revolution_of(sample: int) -> int:
    """Return the revolution at whose start something given before a sample takes effect."""
    return -(-sample // SAMPLES)


def drive(session: Session, events: list[Event], sizes: list[int]) -> list[Block]:
    """Step over all revolutions in blocks of the sizes in turn; give each event right before its sample."""
    blocks = []
    waiting = list(events)
    while session.next_sample < REVOLUTIONS * SAMPLES:
        while waiting and waiting[0].sample == session.next_sample:
            waiting.pop(0).give(session)
        stops = [SAMPLES - session.next_sample % SAMPLES, sizes[len(blocks) % len(sizes)]]
        if waiting:
            stops.append(waiting[0].sample - session.next_sample)
        blocks.append(session.advance(min(stops)))
    return blocks


def drive_by_revolutions(session: Session, events: list[Event]) -> list[Block]:
    """Step by whole revolutions; give each event right before the one that it takes effect at."""
    blocks = []
    for revolution in range(REVOLUTIONS):
        for event in events:
            if revolution_of(event.sample) == revolution:
                event.give(session)
        blocks.append(session.advance(SAMPLES))
    return blocks


def samples_of(blocks: list[Block]) -> dict[str, NDArray[np.generic]]:
    """Return every quantity of every sample, those that a block has once repeated for each of its samples."""
    found = {}
    for item in fields(Block):
        if item.name in ("first_sample", "time_s", "eccentric_phase_rad"):
            continue  # of the first sample of a block
        parts = [np.broadcast_to(getattr(block, item.name), len(block)) for block in blocks]
        found[item.name] = np.concatenate(parts)
    return found


@given(STARTS, st.booleans(), EVENTS, BLOCKS)
@settings(max_examples=50, deadline=None, derandomize=True)
def test_neither_blocks_nor_the_moment_of_a_command_change_a_bit(
    start: dict[str, bool | float | str], run_up: bool, events: list[Event], sizes: list[int]
) -> None:
    configuration = Configuration().changed(start)
    one, other = Session(configuration, run_up=run_up), Session(configuration, run_up=run_up)
    whole, parts = drive_by_revolutions(one, events), drive(other, events, sizes)
    expected, found = samples_of(whole), samples_of(parts)
    for name, values in expected.items():
        assert values.tobytes() == found[name].tobytes(), name
    assert one.applied() == other.applied()
    assert one.configuration == other.configuration


@given(STARTS, st.booleans(), EVENTS, BLOCKS)
@settings(max_examples=60, deadline=None, derandomize=True)
def test_time_and_phase_go_on_from_block_to_block(
    start: dict[str, bool | float | str], run_up: bool, events: list[Event], sizes: list[int]
) -> None:
    blocks = drive(Session(Configuration().changed(start), run_up=run_up), events, sizes)
    sample, time_s, phase = 0, 0.0, 0.0
    for block in blocks:
        assert block.first_sample == sample
        assert block.time_s == pytest.approx(time_s, rel=1e-12, abs=1e-12)
        apart = (block.eccentric_phase_rad - phase) % TURN
        assert min(apart, TURN - apart) < 1e-7
        assert 0.0 <= block.eccentric_phase_rad < TURN
        sample += len(block)
        time_s += len(block) * block.sample_period_s
        phase = block.eccentric_phase_rad + len(block) * block.phase_increment_rad


@given(STARTS, st.booleans(), EVENTS)
@settings(max_examples=60, deadline=None, derandomize=True)
def test_what_is_applied_is_what_was_asked_at_the_next_multiple_of_128(
    start: dict[str, bool | float | str], run_up: bool, events: list[Event]
) -> None:
    session = Session(Configuration().changed(start), run_up=run_up)
    values = session.configuration.flat()
    expected = []
    for revolution in range(REVOLUTIONS):
        asked: dict[str, bool | float] = {}
        for event in events:
            if revolution_of(event.sample) == revolution:
                if event.command is not None:
                    names = ("exciter.vibrate", "exciter.frequency_hz", "exciter.amplitude_m")
                    asked.update(zip(names, event.command, strict=True))
                if event.soil is not None:
                    names = ("soil.shear_modulus_pa", "soil.plastic_parameter_m")
                    asked.update(zip(names, event.soil, strict=False))
        for name, value in asked.items():
            if values[name] != value:
                expected.append(Applied(revolution * SAMPLES, name, value))
                values[name] = value
    drive(session, events, [SAMPLES])
    assert session.applied() == expected
    assert session.configuration.flat() == values


@given(STARTS, EVENTS, st.sampled_from((4, 16, 64, 128)))
@settings(max_examples=15, deadline=None, derandomize=True)
def test_the_emulator_publishes_the_session_s_samples(
    start: dict[str, bool | float | str], events: list[Event], size: int
) -> None:
    configuration = Configuration().changed(start)
    session = Session(configuration, run_up=True)
    expected = samples_of(drive_by_revolutions(session, events))
    emulator = Emulator(configuration, start_ns=0, run_up=True)
    vertical, forces, applied = [], [], []
    for first in range(0, REVOLUTIONS * SAMPLES, size):
        for event in events:
            if first - size < event.sample <= first:
                event.give(emulator)
        for message in emulator.advance(size):
            if message.topic == "drum/acceleration":
                vertical.append(decode(message.data, message.type_name).vertical)
            elif message.topic == "truth":
                forces.append(decode(message.data, message.type_name).soil_force)
            elif message.topic == "applied":
                applied.append(decode(message.data, message.type_name).sample)
    single = np.float32
    assert (
        np.concatenate(vertical).tobytes()
        == expected["acceleration_vertical"].astype(single).tobytes()
    )
    assert np.concatenate(forces).tobytes() == expected["soil_force"].astype(single).tobytes()
    assert applied == [change.sample for change in session.applied()]


@given(STARTS, st.integers(1, 30))
@settings(max_examples=30, deadline=None, derandomize=True)
def test_a_stopped_roller_comes_to_rest_under_its_weight_and_keeps_giving_samples(
    start: dict[str, bool | float | str], revolutions: int
) -> None:
    session = Session(Configuration().changed(start))
    for _ in range(revolutions):
        session.advance(SAMPLES)
    exciter = session.configuration.exciter
    session.command_exciter(
        vibrate=False, frequency_hz=exciter.frequency_hz, amplitude_m=exciter.amplitude_m
    )
    stopped_s = 0.0
    while stopped_s < exciter.frequency_hz / exciter.frequency_rate_hz_per_s + 3.0:
        block = session.advance(SAMPLES)
        stopped_s += SAMPLES * block.sample_period_s
    load = session.configuration.machine.static_load_n
    for _ in range(3):
        block = session.advance(SAMPLES)
        assert block.excitation_hz == 0.0
        assert block.phase_increment_rad == 0.0
        assert block.sample_period_s == 1.0 / (SAMPLES * 10.0)
        assert block.soil_force == pytest.approx(load, rel=1e-3)
        assert np.abs(block.acceleration_vertical).max() < 0.02
        assert not block.acceleration_horizontal.any()


@given(STARTS, st.booleans(), EVENTS, FREQUENCIES, AMPLITUDES)
@settings(max_examples=40, deadline=None, derandomize=True)
def test_both_components_of_the_force_go_on_through_changes_stop_and_restart(
    start: dict[str, bool | float | str],
    run_up: bool,
    events: list[Event],
    frequency_hz: float,
    amplitude_m: float,
) -> None:
    """The exciter's force is what moves the drum beside the soil's force and the weight."""
    configuration = Configuration().changed({**start, "exciter.kind": "circular"})
    session = Session(configuration, run_up=run_up)
    stop = Event(REVOLUTIONS // 2 * SAMPLES, (False, frequency_hz, amplitude_m))
    restart = Event((REVOLUTIONS // 2 + 6) * SAMPLES, (True, frequency_hz, amplitude_m))
    events = sorted([*events, stop, restart], key=lambda event: event.sample)
    mass, load = configuration.machine.drum_mass_kg, configuration.machine.static_load_n
    amplitude = session.exciter_status().force_amplitude_n / mass
    phase = 0.0
    for revolution in range(2 * REVOLUTIONS):
        for event in events:
            if revolution_of(event.sample) == revolution:
                event.give(session)
        block = session.advance(SAMPLES)
        end = session.exciter_status().force_amplitude_n / mass
        # From where the revolution before ended, in a line to where this one ends.
        sample = np.arange(SAMPLES)
        size = amplitude + (end - amplitude) * sample / SAMPLES
        angle = phase + sample * block.phase_increment_rad
        vertical = block.acceleration_vertical - (block.soil_force - load) / mass
        near = 1e-6 * max(amplitude, end) + 1e-9 * load / mass
        assert np.abs(block.acceleration_horizontal - size * np.cos(angle)).max() <= near
        assert np.abs(vertical - size * np.sin(angle)).max() <= near
        amplitude = end
        phase += SAMPLES * block.phase_increment_rad
