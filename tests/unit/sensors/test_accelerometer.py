# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The accelerometer of a data sheet: what each statement of the sheet does to the signal."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.sensors import SENSORS, Accelerometer, AccelerometerSheet, Kind, Reading
from roller_sim_ros.sensors.converter import Converter
from roller_sim_ros.sensors.sheet import G
from roller_sim_ros.session import Session
from tests.motions import Array, blocks


def sheet(**values: float) -> AccelerometerSheet:
    return AccelerometerSheet(**values)  # type: ignore[arg-type]


def read(
    values: AccelerometerSheet, revolutions: int = 2, seed: int = 0, **motion: object
) -> list[Reading]:
    sensor = Accelerometer(values, seed)
    return [item for block in blocks(revolutions, **motion) for item in sensor.read(block)]  # type: ignore[arg-type]


def joined(readings: Iterable[Reading], axis: str = "vertical") -> NDArray[np.float32]:
    return np.concatenate([getattr(reading, axis) for reading in readings])


def wave(amplitude: float, hz: float) -> object:
    def motion(time_s: Array) -> Array:
        return amplitude * np.sin(2.0 * np.pi * hz * time_s)

    return motion


def test_a_sensor_without_errors_reads_specific_force() -> None:
    readings = read(sheet(), vertical=wave(50.0, 28.0), horizontal=wave(20.0, 56.0))
    assert all(reading.kind is Kind.SPECIFIC_FORCE for reading in readings)
    time_s = np.arange(256) / (28.0 * 128)
    expected = 9.81 + 50.0 * np.sin(2.0 * np.pi * 28.0 * time_s)
    assert joined(readings) == pytest.approx(expected, abs=1e-5)
    assert joined(readings, "horizontal") == pytest.approx(
        20.0 * np.sin(2.0 * np.pi * 56.0 * time_s), abs=1e-5
    )
    assert [reading.first_sample for reading in readings] == [0, 128]
    assert all(reading.raw_vertical.size == 0 and reading.scale == 0.0 for reading in readings)


@pytest.mark.parametrize("angle", [0.1, -0.7, math.pi / 2])
def test_a_leaning_sensor_at_rest_reads_gravity_along_its_axes(angle: float) -> None:
    readings = read(sheet(mounting_angle_rad=angle))
    assert joined(readings) == pytest.approx(9.81 * math.cos(angle), abs=1e-5)
    # Its own forward axis points downwards by the angle.
    assert joined(readings, "horizontal") == pytest.approx(-9.81 * math.sin(angle), abs=1e-5)


def test_each_axis_reads_a_share_of_the_other() -> None:
    readings = read(sheet(cross_axis=0.02), horizontal=wave(30.0, 28.0))
    time_s = np.arange(256) / (28.0 * 128)
    horizontal = 30.0 * np.sin(2.0 * np.pi * 28.0 * time_s)
    assert joined(readings) == pytest.approx(9.81 + 0.02 * horizontal, abs=1e-5)
    assert joined(readings, "horizontal") == pytest.approx(horizontal + 0.02 * 9.81, abs=1e-5)


def test_sensitivity_and_bias_are_those_of_the_sheet() -> None:
    values = sheet(sensitivity_error=0.02, bias_vertical_m_s2=0.5, bias_horizontal_m_s2=-0.25)
    readings = read(values)
    assert joined(readings) == pytest.approx(9.81 * 1.02 + 0.5, abs=1e-5)
    assert joined(readings, "horizontal") == pytest.approx(-0.25)


def test_beyond_the_range_it_clips_and_counts_and_never_wraps_around() -> None:
    values = sheet(range_m_s2=100.0, adc_bits=12)
    readings = read(values, vertical=wave(1e6, 28.0), horizontal=wave(250.0, 28.0))
    count = 2**11
    for axis in ("vertical", "horizontal"):
        raw = joined(readings, f"raw_{axis}")
        assert raw.max() == count - 1
        assert raw.min() == -(count - 1)
    time_s = np.arange(256) / (28.0 * 128)
    true = np.sin(2.0 * np.pi * 28.0 * time_s)
    # The sign is that of the signal: an integer that wraps around would turn it.
    beyond = np.abs(true) > 1e-3
    assert np.array_equal(np.sign(joined(readings)[beyond]), np.sign(true[beyond]))
    clipped = sum(int(reading.clipped.sum()) for reading in readings)
    assert clipped == (np.abs(1e6 * true + 9.81) > 100.0).sum() + (np.abs(250 * true) > 100.0).sum()


@pytest.mark.parametrize("bits", [8, 16, 24])
def test_the_converter_comes_last_and_is_half_a_count_off_at_most(bits: int) -> None:
    values = sheet(range_m_s2=200.0, adc_bits=bits, noise_density=1e-3, bandwidth_hz=1000.0)
    readings = read(values, vertical=wave(100.0, 28.0))
    unrounded = read(
        sheet(range_m_s2=200.0, noise_density=1e-3, bandwidth_hz=1000.0), vertical=wave(100.0, 28.0)
    )
    scale = 200.0 / 2 ** (bits - 1)
    assert {reading.scale for reading in readings} == {scale}
    counts = joined(readings, "raw_vertical")
    assert joined(readings) == pytest.approx(counts * scale, rel=1e-7)
    off = joined(readings) - joined(unrounded)
    assert 0.0 < np.abs(off).max() <= 0.5 * scale + 2e-5


def test_what_is_no_number_has_the_count_that_nothing_else_has() -> None:
    converter = Converter(10.0, 8)
    found = converter.convert(np.array([np.nan, -1e9, 1e9, 0.0]))
    assert found.counts.tolist() == [-128, -127, 127, 0]
    assert np.isnan(found.values[0])
    assert found.clipped.tolist() == [False, True, True, False]


def test_the_sensor_s_clock_runs_off_by_its_skew() -> None:
    readings = read(sheet(clock_skew_ppm=1000.0), 10)
    for reading in readings:
        assert reading.sensor_time_s == pytest.approx(reading.time_s * 1.001, abs=1e-12)
    assert readings[-1].time_s == pytest.approx(9 / 28.0)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"adc_bits": 12}, r"accelerometer.adc_bits = 12: a converter needs a range"),
        ({"adc_bits": 1, "range_m_s2": 10.0}, "must be 0, or at least 2"),
        ({"jitter_s": 1e-5}, "needs a fixed sample rate"),
        ({"sample_rate_hz": 5.0}, "must be 0, or at least 10 Hz"),
        ({"bandwidth_hz": 0.5}, "must be 0, or at least 1 Hz"),
        ({"noise_density": -1.0}, "must be at least 0"),
        ({"range_m_s2": math.nan}, "must be finite"),
    ],
)
def test_a_sheet_that_cannot_be_is_refused(values: dict[str, float], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        sheet(**values)


def test_presets_say_where_their_values_are_from_and_pass_their_own_bounds() -> None:
    for name in ("mems_50g", "mems_10g"):
        model = SENSORS[name]
        assert model.preset is not None
        made = model.parameters({})
        for parameter, stated in model.preset.stated.items():
            assert getattr(made, parameter) == stated.value
            assert stated.source
    assert SENSORS["mems_50g"].parameters({}).range_m_s2 == pytest.approx(50.0 * G)  # type: ignore[attr-defined]


def test_a_drop_of_two_g_is_seen_by_both_presets_and_of_twenty_by_one() -> None:
    for amplitude, clips in ((2.0 * G, False), (20.0 * G, True)):
        found = {}
        for name in ("mems_50g", "mems_10g"):
            sensor = SENSORS[name].make(SENSORS[name].parameters({}), 1)
            readings = [
                item
                for block in blocks(4, wave(amplitude, 28.0))  # type: ignore[arg-type]
                for item in sensor.read(block)
            ]
            found[name] = sum(int(reading.clipped.sum()) for reading in readings)
        assert found["mems_50g"] == 0
        assert (found["mems_10g"] > 0) is clips


def test_in_double_jump_ten_g_clip_and_fifty_do_not() -> None:
    """The paper's stiffer ground at 28 Hz, 1.6 mm; a soft ground for comparison."""
    clipped = {}
    for ground, modulus_pa, plastic_m in (("soft", 35e6, 0.8e-3), ("stiff", 80e6, 0.5e-3)):
        configuration = Configuration().changed(
            {"soil.shear_modulus_pa": modulus_pa, "soil.plastic_parameter_m": plastic_m}
        )
        session = Session(configuration)
        blocks_of_it = [session.advance(128) for _ in range(60)]
        for name in ("mems_10g", "mems_50g"):
            sensor = SENSORS[name].make(SENSORS[name].parameters({}), 0)
            readings = [item for block in blocks_of_it for item in sensor.read(block)]
            clipped[name, ground] = sum(int(reading.clipped.sum()) for reading in readings[20:])
    assert clipped["mems_10g", "stiff"] > 0
    assert clipped["mems_10g", "soft"] == 0
    assert clipped["mems_50g", "stiff"] == 0
