# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a data sheet states of an accelerometer: declared once; YAML, help and docs follow."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters import ParameterError, ParameterGroup
from roller_sim_ros.parameters.quantity import parameter

G = 9.80665
"""Standard gravity in m/s²: data sheets count in it."""


@dataclass(frozen=True)
class AccelerometerSheet(ParameterGroup):
    """Two axes of one kind on one carrier; the defaults are those of a sensor without any error."""

    group: ClassVar[str] = "accelerometer"

    range_m_s2: float = parameter(
        0.0,
        "m/s²",
        "range to either side, beyond which it clips; 0: none",
        minimum=0.0,
        maximum=1e5,
    )
    sensitivity_error: float = parameter(
        0.0, "", "relative error of the sensitivity, both axes", minimum=-0.5, maximum=0.5
    )
    bias_vertical_m_s2: float = parameter(
        0.0, "m/s²", "constant bias of the vertical axis", minimum=-1e3, maximum=1e3
    )
    bias_horizontal_m_s2: float = parameter(
        0.0, "m/s²", "constant bias of the horizontal axis", minimum=-1e3, maximum=1e3
    )
    drift_m_s2: float = parameter(
        0.0,
        "m/s²",
        "standard deviation of the drifting part of the bias, a first-order Gauss-Markov process",
        minimum=0.0,
        maximum=1e3,
    )
    drift_time_s: float = parameter(
        100.0, "s", "correlation time of the drift", minimum=1e-3, maximum=1e6
    )
    noise_density: float = parameter(
        0.0,
        "m/s²/√Hz",
        "one-sided density of the white noise, shaped by the bandwidth",
        minimum=0.0,
        maximum=10.0,
    )
    bandwidth_hz: float = parameter(
        0.0,
        "Hz",
        "−3 dB frequency of the analogue second-order Butterworth low-pass before sampling; 0: no limit",
        minimum=0.0,
        maximum=1e6,
    )
    cross_axis: float = parameter(
        0.0, "", "share of the other axis that each axis reads", minimum=-0.5, maximum=0.5
    )
    mounting_angle_rad: float = parameter(
        0.0,
        "rad",
        "angle by which the sensor's vertical axis leans forward",
        minimum=-math.pi,
        maximum=math.pi,
    )
    adc_bits: int = parameter(
        0, "", "bits of the converter, over the range to both sides; 0: none", minimum=0, maximum=31
    )
    sample_rate_hz: float = parameter(
        0.0,
        "Hz",
        "fixed sample rate by the sensor's own clock; 0: 128 samples per revolution of the eccentric",
        minimum=0.0,
        maximum=2e4,
    )
    clock_skew_ppm: float = parameter(
        0.0, "ppm", "how much its clock runs fast", minimum=-1e5, maximum=1e5
    )
    jitter_s: float = parameter(
        0.0,
        "s",
        "standard deviation of the sampling instants, fixed sample rate only; none is off by more than 0.45 periods",
        minimum=0.0,
        maximum=1e-2,
    )
    latency_s: float = parameter(
        0.0, "s", "time from a sample to its delivery", minimum=0.0, maximum=10.0
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.adc_bits and not self.range_m_s2:
            raise ParameterError(
                f"{self.group}.adc_bits", self.adc_bits, "a converter needs a range (range_m_s2)"
            )
        if self.adc_bits == 1:
            raise ParameterError(f"{self.group}.adc_bits", 1, "must be 0, or at least 2")
        if self.jitter_s and not self.sample_rate_hz:
            raise ParameterError(
                f"{self.group}.jitter_s",
                self.jitter_s,
                "needs a fixed sample rate (sample_rate_hz)",
            )
        if 0.0 < self.bandwidth_hz < 1.0:
            raise ParameterError(
                f"{self.group}.bandwidth_hz", self.bandwidth_hz, "must be 0, or at least 1 Hz"
            )
        if 0.0 < self.sample_rate_hz < 10.0:
            raise ParameterError(
                f"{self.group}.sample_rate_hz", self.sample_rate_hz, "must be 0, or at least 10 Hz"
            )
