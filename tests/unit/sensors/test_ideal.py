# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ideal accelerometer: the truth in single precision, with or without gravity."""

from __future__ import annotations

import numpy as np
import pytest

from roller_sim_ros.sensors import SENSORS, IdealAccelerometer, Kind, specific_force
from roller_sim_ros.session.block import Block


def block(vertical: np.ndarray, horizontal: np.ndarray) -> Block:
    zero = np.zeros(len(vertical))
    return Block(
        first_sample=256,
        time_s=1.25,
        sample_period_s=1.0 / 3584.0,
        excitation_hz=28.0,
        eccentric_phase_rad=0.0,
        phase_increment_rad=2.0 * np.pi / 128,
        acceleration_vertical=vertical,
        acceleration_horizontal=horizontal,
        soil_force=zero,
        drum_height=zero,
        soil_displacement=zero,
        plastic_depth=zero,
        height_datum=zero,
        contact_state=zero.astype(np.uint8),
        shear_modulus_pa=50e6,
        plastic_parameter_m=0.65e-3,
    )


def test_kinds_have_the_values_of_the_message() -> None:
    assert (Kind.COORDINATE_ACCELERATION, Kind.SPECIFIC_FORCE) == (0, 1)


def test_coordinate_acceleration_is_the_truth_rounded_to_single_precision() -> None:
    vertical, horizontal = np.random.default_rng(0).normal(size=(2, 16)) * 50.0
    (reading,) = IdealAccelerometer().read(block(vertical, horizontal))
    assert reading.kind is Kind.COORDINATE_ACCELERATION
    assert reading.vertical.dtype == reading.horizontal.dtype == np.float32
    assert np.array_equal(reading.vertical, vertical.astype(np.float32))
    assert np.array_equal(reading.horizontal, horizontal.astype(np.float32))
    assert reading.sensor_time_s == 1.25
    assert (reading.scale, reading.clipped.size) == (0.0, 0)
    assert reading.raw_vertical.size == reading.raw_horizontal.size == 0


def test_specific_force_reads_the_support_at_rest_and_nothing_in_free_fall() -> None:
    (rest,) = IdealAccelerometer(Kind.SPECIFIC_FORCE).read(block(np.zeros(4), np.zeros(4)))
    assert rest.kind is Kind.SPECIFIC_FORCE
    assert rest.vertical == pytest.approx(9.81)
    assert np.all(rest.horizontal == 0.0)
    falling, _ = specific_force(np.full(3, -9.81), np.zeros(3))
    assert np.all(falling == 0.0)


def test_sensors_are_made_by_name() -> None:
    model = SENSORS["ideal"]
    sensor = model.make(model.parameters({"kind": "specific_force"}), 0)
    assert isinstance(sensor, IdealAccelerometer)
    assert sensor.kind is Kind.SPECIFIC_FORCE
