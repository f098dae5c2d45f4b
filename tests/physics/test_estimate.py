# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground estimated back from motions whose ground is known."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.estimate import Status, WindowEstimate, estimate, estimate_window
from roller_sim_ros.estimate.inversion import invert
from roller_sim_ros.estimate.low_pass import low_pass, passed
from roller_sim_ros.estimate.soil_map import best_ground
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.parameters import Configuration
from tools.estimate_accuracy import UNKNOWN, Trip, random_trips, round_trip

Result = tuple[Trip, WindowEstimate, float]
POINTS = 115
"""Of which at least 100 are periodic."""


def settled(
    configuration: Configuration, *, start: float | None = None, revolutions: int = 400
) -> NDArray[np.float64]:
    """Output of the last 16 revolutions, rows as in `state`; from another amplitude than the configuration's."""
    exciter = configuration.exciter
    first = exciter.amplitude_m if start is None else start
    drive = ExciterDrive(dataclasses.replace(exciter, amplitude_m=first), 10.0, run_up=False)
    ground = GROUNDS[configuration.half_space.model](
        configuration.machine,
        configuration.soil,
        configuration.half_space,
        configuration.exciter,
        128,
    )
    parts = []
    for revolution in range(revolutions):
        if revolution == 50:
            drive.target_amplitude_m = exciter.amplitude_m
        ground.begin(drive.next_revolution(), configuration.soil)
        parts.append(ground.advance(0, 128))
    return np.concatenate(parts[-16:], axis=1)


def window(configuration: Configuration, **options: Any) -> NDArray[np.float64]:
    vertical = settled(configuration, **options)[at.OUT_VERTICAL]
    return np.asarray(vertical.reshape(16, 128))


def ground(shear_modulus_mpa: float, plastic_mm: float, **values: Any) -> Configuration:
    return Configuration().changed(
        {
            "soil.shear_modulus_pa": shear_modulus_mpa * 1e6,
            "soil.plastic_parameter_m": plastic_mm * 1e-3,
            **{name.replace("__", "."): value for name, value in values.items()},
        }
    )


def medians(results: list[Result]) -> tuple[float, float]:
    errors = np.abs([trip.errors(found) for trip, found, _ in results if found.period])
    g, p = np.median(errors, axis=0)
    return float(g), float(p)


@pytest.fixture(scope="module")
def trips() -> list[Trip]:
    return random_trips("exact", POINTS, seed=11)


@pytest.fixture(scope="module")
def clean(trips: list[Trip]) -> list[Result]:
    return round_trip(trips)


def test_round_trip_without_noise(clean: list[Result]) -> None:
    told = [found for _, found, _ in clean if found.period]
    assert len(told) >= 100
    # Continuous contact, lift-off and double jump are all among them.
    assert {1, 2} <= {found.period for found in told}
    small = [
        found
        for trip, found, _ in clean
        if found.period and trip.configuration.exciter.amplitude_m < 0.4e-3
    ]
    assert len(small) >= 5
    g, p = medians(clean)
    assert g <= 0.01
    assert p <= 0.02


def test_round_trip_with_the_noise_of_a_sensor(trips: list[Trip]) -> None:
    results = round_trip(trips, noise_seed=12)
    g, p = medians(results)
    assert g <= 0.05
    assert p <= 0.10
    # The spread means something: two of them hold nearly all errors, and they are not much too wide.
    standing = [(trip, found) for trip, found, _ in results if found.status.stands]
    assert len(standing) >= 95
    z = np.array(
        [
            (
                trip.errors(found)[0] * found.shear_modulus_pa / found.shear_modulus_spread_pa,
                trip.errors(found)[1] * found.plastic_parameter_m / found.plastic_spread_m,
            )
            for trip, found in standing
        ]
    )
    assert np.all((np.abs(z) <= 2.5).mean(axis=0) >= 0.85)
    assert np.all((np.abs(z) >= 0.4).mean(axis=0) >= 0.4)


def test_what_does_not_repeat_is_not_estimated(clean: list[Result]) -> None:
    silent = [found for _, found, _ in clean if not found.period]
    assert silent
    assert {found.status for found in silent} <= {Status.CHAOTIC, Status.UNSETTLED}
    assert all(np.isnan(found.shear_modulus_pa) for found in silent)


@pytest.mark.parametrize(("model", "points"), [("two-pole", 30), ("rational", 8)])
def test_round_trip_on_the_other_half_spaces(model: str, points: int) -> None:
    results = round_trip(random_trips(model, points, seed=13))
    g, p = medians(results)
    assert g <= 0.01
    assert p <= 0.02


def test_the_modelled_motion_is_the_measured_one(clean: list[Result]) -> None:
    for _, found, _ in clean:
        if found.period:
            left = found.modelled - found.measured
            assert found.misfit_m_s2 == pytest.approx(np.sqrt(np.mean(left**2)))
    shares = [found.misfit_share for _, found, _ in clean if found.period]
    assert np.median(shares) < 1e-4


@pytest.mark.parametrize(("modulus", "plastic", "amplitude"), [(35, 0.8, 1.6), (60, 0.6, 0.2)])
def test_the_inversion_alone_finds_the_force_and_nearly_the_ground(
    modulus: float, plastic: float, amplitude: float
) -> None:
    configuration = ground(modulus, plastic, exciter__amplitude_m=amplitude * 1e-3)
    out = settled(configuration)[:, :128]
    vertical = out[at.OUT_VERTICAL]
    inverted = invert(vertical - vertical.mean(), 0.0, 1, configuration)
    load = configuration.machine.static_load_n
    np.testing.assert_allclose(inverted.force, out[at.OUT_FORCE], atol=2e-3 * load)
    logs = best_ground(inverted, 1, configuration.changed(UNKNOWN))
    # The blow's kinks lie between samples: a few per cent, where the fit of the motion starts from.
    np.testing.assert_allclose(np.exp(logs), [modulus * 1e6, plastic * 1e-3], rtol=0.05)


@pytest.mark.parametrize(
    "changes",
    [
        {"exciter.kind": "directed", "exciter.tilt_rad": 0.4},
        {"machine.drum_mass_kg": 4466.0, "machine.frame_mass_kg": 2534.0},
        {"soil.density_kg_m3": 1700.0, "soil.poisson_ratio": 0.4},
        {"half_space.area_factor": 3.0, "half_space.static_formula": "paper"},
        {"exciter.frequency_hz": 8.0, "exciter.amplitude_m": 2e-3},
    ],
)
def test_whatever_is_known_is_used(changes: dict[str, Any]) -> None:
    configuration = ground(45.0, 0.7).changed(changes)
    if configuration.exciter.frequency_hz < 10.0:
        # Below the sampling floor there are more samples to a revolution; here they are laid on 128 again.
        drive_floor = configuration.changed({"sampling.floor_hz": 5.0})
        rows = _below_the_floor(drive_floor)
    else:
        rows = window(configuration)
    found = estimate_window(rows, configuration.changed(UNKNOWN))
    assert found.status is Status.OK
    assert found.shear_modulus_pa == pytest.approx(45e6, rel=0.01)
    assert found.plastic_parameter_m == pytest.approx(0.7e-3, rel=0.02)


def _below_the_floor(configuration: Configuration) -> NDArray[np.float64]:
    from roller_sim_ros.session import Session

    session = Session(configuration, run_up=False)
    rows = [session.advance(128).acceleration_vertical for _ in range(100)]
    return np.stack(rows[-16:])


@pytest.mark.parametrize("start_mm", [1.2, 1.9])
def test_either_of_two_motions_on_one_ground_is_found(start_mm: float) -> None:
    """28 Hz, 1.45 mm on the stiff ground double-jumps in two ways, by where the amplitude came from."""
    configuration = ground(80.0, 0.5, half_space__model="two-pole", exciter__amplitude_m=1.45e-3)
    found = estimate_window(
        window(configuration, start=start_mm * 1e-3), configuration.changed(UNKNOWN)
    )
    assert found.status is Status.OK
    assert found.shear_modulus_pa == pytest.approx(80e6, rel=0.01)
    assert found.plastic_parameter_m == pytest.approx(0.5e-3, rel=0.02)


def test_a_motion_that_begins_with_its_other_half() -> None:
    configuration = ground(80.0, 0.5)
    rows = window(configuration, revolutions=1000)
    for first in (0, 1):
        found = estimate_window(rows[first : first + 14], configuration.changed(UNKNOWN))
        assert found.period == 2
        assert found.shear_modulus_pa == pytest.approx(80e6, rel=0.01)


def test_samples_of_another_rate_with_their_phase() -> None:
    configuration = ground(35.0, 0.8)
    vertical = settled(configuration, revolutions=420)[at.OUT_VERTICAL]
    samples = np.concatenate([vertical, vertical])
    phase = 2.0 * np.pi * np.arange(len(samples)) / 128
    at_phase = np.arange(0.0, phase[-1], 2.0 * np.pi / 171.3)
    found = estimate(
        np.interp(at_phase, phase, samples), configuration.changed(UNKNOWN), phase_rad=at_phase
    )
    assert len(found) == 2
    for item in found:
        assert item.status is Status.OK
        assert item.shear_modulus_pa == pytest.approx(35e6, rel=0.02)
        assert item.plastic_parameter_m == pytest.approx(0.8e-3, rel=0.03)


def test_a_low_pass_that_is_known_does_no_harm() -> None:
    configuration = ground(50.0, 0.65, exciter__amplitude_m=1.2e-3)
    rows = window(configuration)
    response = low_pass(rows.size, 16, configuration.exciter.frequency_hz, 800.0)
    behind = passed(rows.ravel(), response).reshape(rows.shape)
    known = configuration.changed(UNKNOWN)
    found = estimate_window(behind, known, sensor_bandwidth_hz=800.0)
    assert found.shear_modulus_pa == pytest.approx(50e6, rel=0.01)
    assert found.plastic_parameter_m == pytest.approx(0.65e-3, rel=0.02)
    unknown = estimate_window(behind, known)
    assert abs(unknown.plastic_parameter_m / 0.65e-3 - 1.0) > 0.05


@pytest.mark.parametrize(
    ("change", "status"),
    [
        (lambda rows: np.clip(rows, -98.0, 98.0), Status.CLIPPED),
        (lambda rows: -rows, Status.MISFIT),
        (lambda rows: np.roll(rows, 32, axis=1), Status.MISFIT),
        (lambda rows: rows[:3], Status.TOO_FEW),
    ],
)
def test_bad_signals_are_told(
    change: Callable[[NDArray[np.float64]], NDArray[np.float64]], status: Status
) -> None:
    configuration = ground(80.0, 0.5)
    found = estimate_window(change(window(configuration)), configuration.changed(UNKNOWN))
    assert found.status is status


def test_where_the_noise_hides_the_ground_it_is_said() -> None:
    configuration = ground(90.0, 0.45, exciter__amplitude_m=0.06e-3, exciter__frequency_hz=16.0)
    draw = np.random.default_rng(4)
    rows = window(configuration) + 2.5 * draw.standard_normal((16, 128))
    found = estimate_window(rows, configuration.changed(UNKNOWN))
    assert found.status in (Status.UNCERTAIN, Status.PLASTIC_UNCERTAIN)
    assert found.plastic_spread_m > 0.2 * found.plastic_parameter_m


def test_a_standing_exciter_has_no_estimate() -> None:
    configuration = ground(50.0, 0.65).changed({"exciter.amplitude_m": 0.0})
    assert estimate_window(np.ones((16, 128)), configuration).status is Status.STANDING
