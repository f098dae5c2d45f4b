# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A fixed sample rate: nothing but what the low-pass lets through folds back, and the clock is the sensor's."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.sensors import Accelerometer, AccelerometerSheet, Reading
from tests.motions import blocks


def read(
    revolutions: int, order: float, amplitude: float = 10.0, size: int = 128, **values: float
) -> list[Reading]:
    sensor = Accelerometer(AccelerometerSheet(**values), 3)  # type: ignore[arg-type]
    found = []
    hz = 28.0
    for block in blocks(
        revolutions,
        lambda time_s: amplitude * np.sin(2.0 * np.pi * order * hz * time_s) - 9.81,
        hz=hz,
        size=size,
    ):
        found += sensor.read(block)
    return found


def line(readings: list[Reading], hz: float) -> float:
    """Return the amplitude of a line by least squares, and so without leakage."""
    values = np.concatenate([reading.vertical for reading in readings]).astype(float)
    time_s = np.concatenate(
        [reading.time_s + reading.sample_period_s * np.arange(len(reading)) for reading in readings]
    )
    turns = 2.0 * np.pi * hz * time_s
    basis = np.stack([np.sin(turns), np.cos(turns), np.ones_like(turns)], axis=1)
    fit, *_ = np.linalg.lstsq(basis, values, rcond=None)
    return math.hypot(fit[0], fit[1])


@pytest.mark.parametrize("order", [0.5, 1.0, 5.0, 20.0])
@pytest.mark.parametrize("rate_hz", [2000.0, 8000.0])
def test_a_tone_keeps_its_amplitude(order: float, rate_hz: float) -> None:
    readings = read(40, order, sample_rate_hz=rate_hz)
    assert line(readings, order * 28.0) == pytest.approx(10.0, rel=1e-3)


@pytest.mark.parametrize("bandwidth_hz", [0.0, 400.0])
def test_what_lies_beyond_half_the_rate_folds_back_as_it_does_in_a_sensor(
    bandwidth_hz: float,
) -> None:
    rate_hz, hz = 1000.0, 30.0 * 28.0  # 840 Hz are seen at 160 Hz
    readings = read(60, 30.0, sample_rate_hz=rate_hz, bandwidth_hz=bandwidth_hz)
    gain = 1.0
    if bandwidth_hz:
        gain = 1.0 / math.sqrt(1.0 + (hz / bandwidth_hz) ** 4)
    # The low-pass takes straight lines between the model's samples: (sinc 840/3584)² = 0.83 at worst.
    assert line(readings, rate_hz - hz) == pytest.approx(10.0 * gain, rel=0.2)
    # Nothing elsewhere: 10/(π · 140 Hz · 2.1 s) is what a fit of one line sees of another.
    assert line(readings, 300.0) < 0.02


def test_images_of_the_interpolation_are_below_a_thousandth() -> None:
    # Order 40 of 128: straight lines between the samples would leave an image at order 88 of a quarter of it.
    readings = read(60, 40.0, sample_rate_hz=16000.0)
    assert line(readings, 40.0 * 28.0) == pytest.approx(10.0, rel=1e-3)
    assert line(readings, 88.0 * 28.0) < 0.01


def test_samples_come_at_the_sensor_s_own_times() -> None:
    readings = read(28, 1.0, sample_rate_hz=1000.0, clock_skew_ppm=500.0)
    numbers = np.concatenate([it.first_sample + np.arange(len(it)) for it in readings])
    assert np.array_equal(numbers, np.arange(len(numbers)))
    for reading in readings:
        assert reading.sample_period_s == 1e-3
        assert reading.sensor_time_s == pytest.approx(reading.first_sample * 1e-3, abs=1e-12)
        assert reading.time_s == pytest.approx(reading.first_sample * 1e-3 / 1.0005, abs=1e-12)
        # All of one revolution, phase and phase increment its own.
        first, last = (
            reading.time_s * 28.0,
            (reading.time_s + (len(reading) - 1) / 1000.5) * 28.0,
        )
        assert math.floor(first + 1e-9) == reading.revolution
        assert math.floor(last - 1e-6) == reading.revolution
        assert reading.eccentric_phase_rad == pytest.approx(
            2.0 * math.pi * (first - reading.revolution), abs=1e-6
        )
        assert reading.phase_increment_rad == pytest.approx(2.0 * math.pi * 28.0 * 1e-3)
    # A second of session time is 1000.5 samples of a fast clock; the last few are still to come.
    assert 1000.5 - 8 < len(numbers) <= 1001


def test_jitter_is_a_noise_of_the_slope() -> None:
    # 0.1 ms rms at a slope of A ω cos: an error of A ω σ/√2 rms.
    clean = read(200, 1.0, sample_rate_hz=1000.0)
    shaky = read(200, 1.0, sample_rate_hz=1000.0, jitter_s=1e-4)
    off = np.concatenate([it.vertical for it in shaky]) - np.concatenate(
        [it.vertical for it in clean]
    )
    expected = 10.0 * 2.0 * math.pi * 28.0 * 1e-4 / math.sqrt(2.0)
    # Of n = 7100 independent numbers the rms is known to 1/√(2 n), five of them and the cosine's square: 8 %.
    assert math.sqrt(np.mean(off**2)) == pytest.approx(expected, rel=0.08)
    assert abs(np.mean(off)) < 5.0 * expected / math.sqrt(len(off))


def test_a_slow_sensor_leaves_revolutions_out() -> None:
    readings = read(28, 1.0, sample_rate_hz=10.0)
    assert sum(map(len, readings)) == 10
    assert len({reading.revolution for reading in readings}) == 10
