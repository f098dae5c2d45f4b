# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Rollers by name, each with where its numbers are from."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from roller_sim_ros.parameters import GRAVITY_M_S2, Machine, Value
from roller_sim_ros.soil_mechanics.plastic_parameter import line_load
from roller_sim_ros.soil_mechanics.presets import find


@dataclass(frozen=True)
class MachinePreset:
    """A roller with a name.

    Attributes
    ----------
    name, doc : str
        As on the command line, and a line on it.
    machine : Machine
        Masses and drum.
    frequency_hz, amplitude_m : float
        Its exciter's setting, the one of high amplitude where there are two.
    source : str
        Where the numbers are from, and which of them are assumed.
    verified : bool
        Whether all of them were read there.
    """

    name: str
    doc: str
    machine: Machine
    frequency_hz: float
    amplitude_m: float
    source: str
    verified: bool

    def values(self) -> dict[str, Value]:
        """Return {dotted name: SI value} of the parameters of machine and exciter that it sets."""
        return {
            **{
                f"machine.{item.name}": getattr(self.machine, item.name)
                for item in fields(self.machine)
            },
            "exciter.frequency_hz": self.frequency_hz,
            "exciter.amplitude_m": self.amplitude_m,
        }


def drum_mass(force_amplitude_n: float, amplitude_m: float, frequency_hz: float) -> float:
    """Return m_d = F_e / (A ω²) from what catalogues state, kg: A is the free drum's amplitude."""
    return force_amplitude_n / (amplitude_m * (2.0 * math.pi * frequency_hz) ** 2)


def frame_mass(drum_mass_kg: float, drum_width_m: float) -> float:
    """Return the m_f, kg, that gives the line load of the paper's machine, 26 kN/m."""
    return line_load(Machine()) * drum_width_m / GRAVITY_M_S2 - drum_mass_kg


_WIDTH_M = 2.13
"""84 inches, the usual drum of this class."""

_DIMENSIONS = "drum of 2.13 m by 1.50 m as usual in this class, assumed"


def _from_catalogue(
    name: str, doc: str, force_n: float, amplitude_m: float, frequency_hz: float, catalogue: str
) -> MachinePreset:
    mass_kg = round(drum_mass(force_n, amplitude_m, frequency_hz), 0)
    machine = Machine(
        drum_mass_kg=mass_kg,
        frame_mass_kg=round(frame_mass(mass_kg, _WIDTH_M), 0),
        drum_width_m=_WIDTH_M,
    )
    source = (
        f"{catalogue}, as commonly cited; m_d = F_e / (A ω²) from these; m_f for the line load of the paper's "
        f"machine, assumed; {_DIMENSIONS}"
    )
    return MachinePreset(name, doc, machine, frequency_hz, amplitude_m, source, verified=False)


_AXAS_DRUM_KG = 3765.8 + 220.4 + 108.2 + 88.074
"""Drum, drive disc, vibration plate and eccentric axle of the multibody model."""

MACHINES: dict[str, MachinePreset] = {
    preset.name: preset
    for preset in (
        MachinePreset(
            "paper-10t",
            "the paper's machine, the default",
            Machine(),
            28.0,
            1.6e-3,
            "Sandström, Numerical simulation of a vibratory roller on cohesionless soil (1994), 'Roller data'",
            verified=True,
        ),
        MachinePreset(
            "multibody",
            "the roller of a public multibody model",
            Machine(
                frame_mass_kg=3159.0,
                drum_mass_kg=_AXAS_DRUM_KG,
                drum_radius_m=0.759,
                eccentric_mass_kg=88.074,
            ),
            29.0,
            7.31 / _AXAS_DRUM_KG,
            "Axås, A coupled multibody and discrete element approach for roller compaction dynamics (Chalmers, 2020), "
            "the model's code: m_e r_e 7.31 kg m; its drive disc, 220 kg behind rubber elements, is counted with "
            "the drum; the width is not stated there: that of the paper's machine",
            verified=False,
        ),
        MachinePreset(
            "sd-150",
            "Ingersoll Rand SD-150",
            Machine(frame_mass_kg=2534.0, drum_mass_kg=4466.0, drum_width_m=_WIDTH_M),
            30.0,
            4.25 / 4466.0,
            "van Susante and Mooney, J. Eng. Mech. 134 (2008), as commonly cited: masses and m_e r_e 4.25 kg m; "
            f"30 Hz assumed; {_DIMENSIONS}",
            verified=False,
        ),
        _from_catalogue(
            "cs-563e",
            "Caterpillar CS-563E, high amplitude (low: 0.85 mm)",
            266e3,
            1.7e-3,
            31.9,
            "Caterpillar's catalogue: 31.9 Hz, 1.7 mm with 266 kN and 0.85 mm with 133 kN",
        ),
        _from_catalogue(
            "ca250",
            "Dynapac CA250, high amplitude",
            246e3,
            1.7e-3,
            33.0,
            "Dynapac's catalogue: 33 Hz, 1.7 mm, 246 kN",
        ),
    )
}
"""All rollers; a new one is one entry."""


def machine_preset(name: str) -> MachinePreset:
    """Return a preset by its name.

    Raises
    ------
    ParameterError
        If there is none; the message lists those that there are.
    """
    return find("machine", name, MACHINES)
