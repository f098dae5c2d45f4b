# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Odometry and satellite position: rates, errors and places."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.sensors import SENSORS, Choice, Fix, Slot, Suite, Travelled
from roller_sim_ros.sensors.geodesy import Geodetic, from_ecef, place_of, to_ecef
from roller_sim_ros.sensors.gnss import Gnss, GnssSheet
from roller_sim_ros.sensors.odometry import Odometry, OdometrySheet
from roller_sim_ros.site import Position
from tests.motions import blocks

EQUATOR_M = 6378137.0
NO_ERROR = {"wander_m": 0.0, "noise_m": 0.0}


def drive(sensor: Odometry | Gnss, revolutions: int, speed_m_s: float, size: int = 128) -> list:  # type: ignore[type-arg]
    found: list[Travelled | Fix] = []
    for block in blocks(revolutions, size=size):
        revolution = block.first_sample // 128
        position = Position(revolution / 28.0 * speed_m_s, 1, speed_m_s)
        found += sensor.read(block, position)
    return found


@pytest.mark.parametrize("size", [16, 128])
def test_measurements_come_at_their_rate_with_the_position_of_their_time(size: int) -> None:
    found = drive(Odometry(OdometrySheet(scale_error=0.0, speed_noise_m_s=0.0)), 56, 1.5, size)
    assert [item.time_s for item in found] == pytest.approx(np.arange(40) / 20.0)
    assert [item.distance_m for item in found] == pytest.approx(1.5 * np.arange(40) / 20.0)
    assert {item.speed_m_s for item in found} == {1.5}


def test_dead_reckoning_runs_off_by_the_scale_error_and_within_its_deviation() -> None:
    found = drive(Odometry(OdometrySheet(scale_error=0.02, speed_noise_m_s=0.05), 1), 28 * 60, -1.0)
    last = found[-1]
    true_m = -1.0 * last.time_s
    assert last.distance_m == pytest.approx(1.02 * true_m, abs=5.0 * 0.05 * math.sqrt(60.0 / 20.0))
    assert abs(last.distance_m - true_m) < 5.0 * last.distance_deviation_m
    noise = np.array([item.speed_m_s for item in found]) + 1.02
    assert np.std(noise) == pytest.approx(0.05, rel=5.0 / math.sqrt(2.0 * len(noise)))


def test_a_standing_roller_measures_no_speed() -> None:
    found = drive(Odometry(OdometrySheet()), 28, 0.0)
    assert {(item.speed_m_s, item.distance_m) for item in found} == {(0.0, 0.0)}


@pytest.mark.parametrize("heading", [0.0, 90.0, 210.0])
def test_fixes_lie_on_the_lane(heading: float) -> None:
    sheet = GnssSheet(latitude_deg=0.0, longitude_deg=10.0, heading_deg=heading, **NO_ERROR)
    found = drive(Gnss(sheet), 28 * 10, 2.0)
    assert len(found) == 100
    last = found[-1]
    way_m = 2.0 * last.time_s
    # On the equator a degree of longitude is that of a circle, one of latitude that of the meridian's curve there.
    east_m = math.radians(last.place.longitude_deg - 10.0) * EQUATOR_M
    north_m = math.radians(last.place.latitude_deg) * EQUATOR_M * (1.0 - 0.00669437999014)
    assert east_m == pytest.approx(way_m * math.sin(math.radians(heading)), abs=1e-3)
    assert north_m == pytest.approx(way_m * math.cos(math.radians(heading)), abs=1e-3)


def test_the_error_of_a_fix_is_that_of_the_sheet() -> None:
    sheet = GnssSheet(wander_m=0.01, noise_m=0.02, wander_time_s=0.5, vertical_factor=3.0)
    found = drive(Gnss(sheet, 2), 28 * 600, 0.0)
    north_m = np.array([math.radians(it.place.latitude_deg - 59.35) for it in found]) * 6.3927e6
    up_m = np.array([it.place.altitude_m - 30.0 for it in found])
    variance = 0.01**2 + 0.02**2
    # Wander over 0.5 s is independent every 5 to 10 of 6000 fixes: 600 at least.
    assert np.var(north_m) == pytest.approx(variance, rel=5.0 * math.sqrt(2.0 / 600))
    assert np.var(up_m) == pytest.approx(9.0 * variance, rel=5.0 * math.sqrt(2.0 / 600))
    assert found[0].variances_m2 == pytest.approx((variance, variance, 9.0 * variance))
    rho = np.corrcoef(north_m[1:], north_m[:-1])[0, 1]
    assert rho == pytest.approx(0.2 * math.exp(-0.2), abs=5.0 / math.sqrt(6000))


def test_places_and_back() -> None:
    for latitude, longitude, altitude in (
        (0.0, 0.0, 0.0),
        (59.35, 18.07, 30.0),
        (-80.0, -170.0, 4e3),
    ):
        place = Geodetic(latitude, longitude, altitude)
        again = from_ecef(*to_ecef(place))
        assert again == pytest.approx(place, abs=1e-6)
        assert place_of(place, 0.0, 0.0, 5.0).altitude_m == pytest.approx(altitude + 5.0, abs=1e-6)
    # Known: the pole's radius, and a point on the equator.
    assert to_ecef(Geodetic(90.0, 0.0, 0.0))[2] == pytest.approx(6356752.3142, abs=1e-4)
    assert to_ecef(Geodetic(0.0, 90.0, 0.0)) == pytest.approx((0.0, EQUATOR_M, 0.0), abs=1e-6)


def test_a_suite_has_one_sensor_for_each_thing_and_an_accelerometer_always() -> None:
    assert Suite().slots == {Slot.ACCELERATION}
    suite = Suite([Choice("gnss"), Choice("mems_10g", {"adc_bits": 12})])
    assert suite.slots == {Slot.ACCELERATION, Slot.POSITION}
    assert suite.sheets[Slot.ACCELERATION].adc_bits == 12  # type: ignore[attr-defined]
    for choices, message in (
        ([Choice("mems_10"), Choice("gnss")], r"sensors\[0\].name = 'mems_10': .* mean mems_10g"),
        (
            [Choice("ideal"), Choice("mems_10g")],
            r"sensors\[1\].name .* acceleration of the drum already",
        ),
        (
            [Choice("gnss", {"wander": 1.0})],
            r"sensors\[0\].parameters.wander = 1.0: .* mean wander_m",
        ),
        (
            [Choice("tacho", {"jitter_s": -1.0})],
            r"sensors\[0\].parameters.jitter_s = -1.0: must be",
        ),
    ):
        with pytest.raises(ParameterError, match=message):
            Suite(choices)


@pytest.mark.parametrize("name", sorted(SENSORS))
def test_every_parameter_of_every_sensor_says_what_it_is(name: str) -> None:
    model = SENSORS[name]
    assert model.doc
    assert not model.doc.endswith(".")
    assert model.make(model.parameters({}), 0) is not None
