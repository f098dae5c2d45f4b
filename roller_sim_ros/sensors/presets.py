# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Accelerometers by name: what their data sheets state, value by value with its source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from roller_sim_ros.sensors.sheet import G

_ASSUMED = "assumed: a usual value"
_MS1000 = "Colibrys MS1000 data sheet of 2016-12-30, MS1010"
_ADXL1002 = "Analog Devices ADXL1002 data sheet, as commonly cited"


@dataclass(frozen=True)
class Stated:
    """One value of a preset.

    Attributes
    ----------
    value : float or int
        In the unit of the parameter.
    source : str
        Where it is from.
    verified : bool
        Whether it was read there.
    """

    value: float | int
    source: str
    verified: bool = False


@dataclass(frozen=True)
class Preset:
    """An accelerometer by name.

    Attributes
    ----------
    doc : str
        What it is, in a sentence without a full stop.
    stated : mapping
        Values by the names of the data sheet's parameters; the others have their defaults.
    """

    doc: str
    stated: Mapping[str, Stated] = field(default_factory=dict)

    def values(self) -> dict[str, float | int]:
        """Return the values alone."""
        return {name: item.value for name, item in self.stated.items()}


MEMS_50G = Preset(
    "industrial MEMS of ±50 g: enough for any jump",
    {
        "range_m_s2": Stated(50.0 * G, _ADXL1002),
        "sensitivity_error": Stated(0.01, _ASSUMED),
        "bias_vertical_m_s2": Stated(0.1 * G, _ASSUMED),
        "bias_horizontal_m_s2": Stated(-0.05 * G, _ASSUMED),
        "drift_m_s2": Stated(0.01 * G, _ASSUMED),
        "drift_time_s": Stated(300.0, _ASSUMED),
        "noise_density": Stated(25e-6 * G, _ADXL1002),
        "bandwidth_hz": Stated(11e3, _ADXL1002),
        "cross_axis": Stated(0.01, _ADXL1002),
        "adc_bits": Stated(16, _ASSUMED),
    },
)

MEMS_10G = Preset(
    "inertial MEMS of ±10 g: clips in double jump, on purpose",
    {
        "range_m_s2": Stated(10.0 * G, _MS1000, verified=True),
        "sensitivity_error": Stated(120e-6, f"{_MS1000}: residual modelling error", verified=True),
        "bias_vertical_m_s2": Stated(
            1.2e-3 * G, f"{_MS1000}: long-term repeatability", verified=True
        ),
        "bias_horizontal_m_s2": Stated(
            -1.2e-3 * G, f"{_MS1000}: long-term repeatability", verified=True
        ),
        "drift_m_s2": Stated(15e-6 * G, f"{_MS1000}: in-run stability", verified=True),
        "drift_time_s": Stated(300.0, _ASSUMED),
        "noise_density": Stated(34e-6 * G, _MS1000, verified=True),
        "bandwidth_hz": Stated(800.0, "assumed: an anti-aliasing filter outside the sensor"),
        "cross_axis": Stated(0.01, f"{_MS1000}: misalignment of 10 mrad", verified=True),
        "adc_bits": Stated(16, _ASSUMED),
    },
)
