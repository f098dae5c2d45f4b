# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The exciter: its kind, what is commanded of it and how fast it follows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters.quantity import ParameterGroup, parameter


@dataclass(frozen=True)
class Exciter(ParameterGroup):
    """Rotating eccentric (circular) or two counter-rotating masses (directed)."""

    group: ClassVar[str] = "exciter"

    kind: str = parameter(
        "circular",
        "",
        "circular: one rotating eccentric; directed: counter-rotating masses, force along one line",
        choices=("circular", "directed"),
        flag="--exciter",
    )
    tilt_rad: float = parameter(
        0.0,
        "rad",
        "directed exciter: angle of its line of force from the vertical, positive forward",
        minimum=-1.5707963267948966,
        maximum=1.5707963267948966,
        flag="--tilt-deg",
        scale=0.017453292519943295,
        flag_unit="deg",
    )
    vibrate: bool = parameter(
        True, "", "whether the exciter is commanded to run at the start", live=True
    )
    frequency_hz: float = parameter(
        28.0,
        "Hz",
        "commanded excitation frequency (f)",
        minimum=0.0,
        maximum=80.0,
        live=True,
        flag="--frequency-hz",
        flag_unit="Hz",
    )
    amplitude_m: float = parameter(
        1.6e-3,
        "m",
        "commanded nominal amplitude (A = m_e r_e / m_d)",
        minimum=0.0,
        maximum=5e-3,
        live=True,
        flag="--amplitude-mm",
        scale=1e-3,
        flag_unit="mm",
    )
    frequency_rate_hz_per_s: float = parameter(
        10.0,
        "Hz/s",
        "how fast the frequency follows its command",
        minimum=0.01,
        maximum=1000.0,
        live=True,
    )
    amplitude_rate_m_per_s: float = parameter(
        2e-3,
        "m/s",
        "how fast the amplitude follows its command",
        minimum=1e-5,
        maximum=1.0,
        live=True,
    )
    command_timeout_s: float = parameter(
        0.0,
        "s",
        "the exciter runs down when no command came for so long; 0 switches the watchdog off",
        minimum=0.0,
        maximum=3600.0,
        live=True,
    )
