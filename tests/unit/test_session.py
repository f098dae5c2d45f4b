# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The session: blocks, commands, changes, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import GRAVITY_M_S2, Configuration, ParameterError
from roller_sim_ros.session import (
    Applied,
    Block,
    CommandRefused,
    ExciterCommand,
    Refusal,
    Session,
    warm_up,
)
from roller_sim_ros.session.block import AIR, UNLOADING

TURN = 2.0 * math.pi


def session(**values: bool | float | str) -> Session:
    """Return a session with some parameters changed, `__` for the dot of their names."""
    named = {name.replace("__", "."): value for name, value in values.items()}
    return Session(Configuration().changed(named))


def command(roller: Session, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
    roller.command_exciter(vibrate=vibrate, frequency_hz=frequency_hz, amplitude_m=amplitude_m)


def equal(a: Block, b: Block) -> bool:
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in vars(a))


def test_it_starts_in_static_equilibrium() -> None:
    roller = session(exciter__vibrate=False)
    block = roller.advance(128)
    load = roller.configuration.machine.static_load_n
    assert block.soil_force == pytest.approx(load, rel=1e-9)
    assert np.abs(block.acceleration_vertical).max() < 1e-6
    assert not block.acceleration_horizontal.any()
    assert np.ptp(block.drum_height) < 1e-9
    assert (block.contact_state == UNLOADING).all()
    assert block.plastic_depth[0] == pytest.approx(0.65e-3)


def test_the_first_sample_has_the_exciter_s_full_horizontal_force() -> None:
    block = session().advance(128)
    amplitude = 1.6e-3 * (TURN * 28.0) ** 2
    assert amplitude / GRAVITY_M_S2 == pytest.approx(5.05, abs=0.005)  # the paper's machine
    phase = block.eccentric_phase_rad + np.arange(128) * block.phase_increment_rad
    assert block.acceleration_horizontal == pytest.approx(amplitude * np.cos(phase), abs=1e-9)


def test_in_the_air_only_exciter_and_weight_act() -> None:
    roller = session(soil__shear_modulus_pa=80e6, soil__plastic_parameter_m=0.5e-3)
    for _ in range(100):
        block = roller.advance(128)
    amplitude = 1.6e-3 * (TURN * 28.0) ** 2
    fall = roller.configuration.machine.static_load_n / 3200.0
    phase = np.arange(128) * TURN / 128
    air = block.contact_state == AIR
    assert air.any()
    expected = amplitude * np.sin(phase) - fall
    assert block.acceleration_vertical[air] == pytest.approx(expected[air], abs=1e-6)


def test_a_directed_exciter_moves_the_drum_along_its_line() -> None:
    roller = session(exciter__kind="directed", exciter__tilt_rad=math.radians(30.0))
    block = roller.advance(128)
    amplitude = 0.5 * 1.6e-3 * (TURN * 28.0) ** 2
    expected = amplitude * np.sin(np.arange(128) * TURN / 128)
    assert block.acceleration_horizontal == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("before", "samples"), [(0, 0), (0, -1), (0, 129), (100, 29)])
def test_a_block_never_reaches_over_a_multiple_of_128(before: int, samples: int) -> None:
    roller = session()
    if before:
        roller.advance(before)
    with pytest.raises(RollerSimError, match=rf"advance\({samples}\): must be 1 … {128 - before}"):
        roller.advance(samples)
    # Nothing happened.
    assert roller.next_sample == before
    assert len(roller.advance(128 - before)) == 128 - before


def test_blocks_tell_where_they_are() -> None:
    roller = session()
    roller.advance(128)
    roller.advance(16)
    block = roller.advance(8)
    assert (block.first_sample, len(block)) == (144, 8)
    assert block.time_s == pytest.approx(144 / (28.0 * 128), rel=1e-12)
    assert block.eccentric_phase_rad == pytest.approx(16 * TURN / 128)
    assert (block.shear_modulus_pa, block.plastic_parameter_m) == (50e6, 0.65e-3)
    assert roller.next_sample == 152


def test_other_numbers_of_samples_per_revolution() -> None:
    roller = session(sampling__samples_per_revolution=512)
    assert roller.samples_per_revolution == 512
    block = roller.advance(512)
    assert block.sample_period_s == 1.0 / (28.0 * 512)


@pytest.mark.parametrize("at", [0, 1, 64, 127])
def test_commands_wait_for_the_next_multiple_of_128(at: int) -> None:
    roller = session()
    roller.advance(128)
    if at:
        roller.advance(at)
    command(roller, True, 28.1, 1.62e-3)
    if at:
        assert roller.advance(128 - at).excitation_hz == 28.0
        assert roller.applied() == []
        assert roller.exciter_status().commanded_frequency_hz == 28.0
    assert roller.advance(1).excitation_hz == 28.1
    effect = 256 if at else 128
    assert roller.applied() == [
        Applied(effect, "exciter.frequency_hz", 28.1),
        Applied(effect, "exciter.amplitude_m", 1.62e-3),
    ]
    assert roller.applied() == []
    status = roller.exciter_status()
    assert (status.vibrating, status.applied_sample) == (True, effect)
    assert (status.commanded_frequency_hz, status.frequency_hz) == (28.1, 28.1)
    assert (status.commanded_amplitude_m, status.amplitude_m) == (1.62e-3, 1.62e-3)
    assert status.force_amplitude_n == pytest.approx(3200.0 * 1.62e-3 * (TURN * 28.1) ** 2)


def test_the_last_of_several_commands_counts_and_one_that_changes_nothing_is_acknowledged() -> None:
    roller = session()
    command(roller, True, 30.0, 1e-3)
    command(roller, True, 28.0, 1.6e-3)
    roller.advance(128)
    assert roller.applied() == []
    assert roller.exciter_status().applied_sample == 0
    command(roller, True, 28.0, 1.6e-3)
    roller.advance(128)
    assert roller.applied() == []
    assert roller.exciter_status().applied_sample == 128


def test_a_command_to_stop_keeps_frequency_and_amplitude_for_later() -> None:
    roller = session()
    command(roller, False, 28.0, 1.6e-3)
    roller.advance(128)
    status = roller.exciter_status()
    assert not status.vibrating
    assert status.commanded_frequency_hz == 28.0
    assert status.frequency_hz == pytest.approx(28.0 - 10.0 / 28.0)
    assert status.amplitude_m == 1.6e-3


REFUSED = {
    "nan": ((True, math.nan, 1e-3), Refusal.NOT_FINITE, "frequency nan Hz: must be finite"),
    "infinite": ((True, 28.0, math.inf), Refusal.NOT_FINITE, "amplitude inf m: must be finite"),
    "negative": ((True, -1.0, 1e-3), Refusal.NEGATIVE, "frequency -1 Hz: must not be negative"),
    "also when it is to stop": (
        (False, 28.0, -1e-9),
        Refusal.NEGATIVE,
        "amplitude -1e-09 m: must not be negative",
    ),
    "too fast": (
        (True, 80.1, 1e-3),
        Refusal.OUT_OF_RANGE,
        "frequency 80.1 Hz: must be at most 80 Hz",
    ),
    "too far": (
        (True, 28.0, 0.0051),
        Refusal.OUT_OF_RANGE,
        "amplitude 0.0051 m: must be at most 0.005 m",
    ),
}


@pytest.mark.parametrize(("values", "code", "reason"), REFUSED.values(), ids=REFUSED)
def test_bad_commands_are_refused_whole_and_the_roller_carries_on(
    values: tuple[bool, float, float], code: Refusal, reason: str
) -> None:
    roller, undisturbed = session(), session()
    for other in (roller, undisturbed):
        other.advance(64)
    with pytest.raises(CommandRefused) as caught:
        command(roller, *values)
    assert (caught.value.code, str(caught.value)) == (code, reason)
    for samples in (64, 128, 128):
        assert equal(roller.advance(samples), undisturbed.advance(samples))
    assert roller.applied() == []


def test_a_command_at_its_bounds_is_accepted() -> None:
    assert ExciterCommand(True, 80.0, 5e-3) == ExciterCommand(True, 80, 0.005)
    assert isinstance(ExciterCommand(True, 0, 0).frequency_hz, float)


def test_changes_wait_for_the_next_multiple_of_128() -> None:
    roller = session()
    roller.advance(100)
    roller.change({"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3})
    assert roller.advance(28).shear_modulus_pa == 50e6
    block = roller.advance(128)
    assert (block.shear_modulus_pa, block.plastic_parameter_m) == (80e6, 0.5e-3)
    assert roller.applied() == [
        Applied(128, "soil.shear_modulus_pa", 80e6),
        Applied(128, "soil.plastic_parameter_m", 0.5e-3),
    ]
    assert roller.configuration.soil.shear_modulus_pa == 80e6
    # The command took effect at no sample: a change is none.
    assert roller.exciter_status().applied_sample == 0


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        (
            {"soil.shear_modulus": 8e7},
            "there is no such parameter; did you mean soil.shear_modulus_pa",
        ),
        ({"machine.drum_mass_kg": 3000.0}, "cannot change while the roller runs"),
        ({"meter.window_revolutions": 8}, "cannot change while the roller runs"),
        ({"soil.shear_modulus_pa": 1.0}, "must be at least 2e\\+06 Pa"),
        ({"soil.shear_modulus_pa": math.nan}, "must be finite"),
        ({"soil.plastic_parameter_m": 0.5e-3, "soil.poisson_ratio": 0.5}, "must be at most 0.49"),
    ],
)
def test_bad_changes_are_refused_whole(values: dict[str, float], reason: str) -> None:
    roller, undisturbed = session(), session()
    with pytest.raises(ParameterError, match=reason):
        roller.change(values)
    for _ in range(2):
        assert equal(roller.advance(128), undisturbed.advance(128))
    assert roller.applied() == []


def test_changed_rates_hold_from_then_on() -> None:
    roller = session()
    roller.change({"exciter.frequency_rate_hz_per_s": 28.0})
    command(roller, True, 40.0, 1.6e-3)
    assert roller.advance(128).excitation_hz == pytest.approx(29.0)


def test_run_up_starts_from_standstill() -> None:
    roller = Session(Configuration(), run_up=True)
    block = roller.advance(128)
    assert block.excitation_hz <= 1.0
    assert block.sample_period_s == 1.0 / 1280
    assert np.abs(block.acceleration_horizontal).max() < 0.1


def test_warm_up_leaves_no_trace() -> None:
    configuration = Configuration().changed({"exciter.vibrate": False})
    warm_up(configuration)
    assert equal(Session(configuration).advance(128), Session(configuration).advance(128))
