# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Writes the tables of docs/meters.md and docs/soil.md: what the model makes of the meters, and the presets.

``--check`` writes nothing and fails when a page is not what it would be.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from roller_sim_ros.meters import summarise
from roller_sim_ros.meters.drum import Drum, DrumMotion
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import DRUM_METERS, METERS, ORDERS, evaluate, evaluate_drum
from roller_sim_ros.offline.run import run, step_whole_revolutions
from roller_sim_ros.parameters import (
    Configuration,
    Exciter,
    Machine,
    Soil,
    covarying_plastic_parameter,
)
from roller_sim_ros.soil_mechanics import MACHINES, SOILS, GranularSoil
from tools.generated import write_or_check
from tools.markdown_table import table
from tools.sections import with_sections

ROOT = Path(__file__).resolve().parent.parent

REVOLUTIONS = 1000
SHEAR_MODULI_MPA = (15, 25, 35, 45, 55, 65, 80, 100, 120)
AMPLITUDES_MM = (0.8, 1.6)
PLASTIC_MM = (0.3, 0.6, 1.2)

VALUE_HEAD = ("CMV", "RMV", "CCV", "Omega, J", "E_vib, MPa", "k_s, MN/m")


def meter_values(soil: Soil, amplitude_m: float) -> tuple[str, ...]:
    """Return mode and meter values of the paper's roller at 28 Hz, settled from rest, as a table shows them."""
    configuration = Configuration(soil=soil, exciter=Exciter(amplitude_m=amplitude_m))
    tail = run(
        step_whole_revolutions(configuration, run_up=False), REVOLUTIONS, 128, lambda _: None
    )
    drum = Drum.of(configuration.machine, configuration.exciter)
    motion = DrumMotion(tail.vertical, drum, amplitude_m, float(tail.excitation_hz[-1]))
    of = evaluate(order_amplitudes(tail.vertical, ORDERS)) | {
        name: float(value) for name, value in evaluate_drum(motion).items()
    }
    summary = summarise(
        tail.vertical, tail.soil_force, tail.contact_state, configuration.machine.static_load_n
    )
    return (
        summary.mode.label,
        f"{of['cmv']:.0f}",
        f"{of['rmv']:.0f}",
        f"{of['ccv']:.0f}",
        f"{of['omega']:.0f}",
        f"{of['e_vib'] / 1e6:.0f}",
        f"{of['k_s'] / 1e6:.0f}",
    )


def stiffness_table() -> str:
    """Meter values against G at two amplitudes, p going with G."""
    rows = []
    for amplitude_mm in AMPLITUDES_MM:
        for modulus_mpa in SHEAR_MODULI_MPA:
            modulus_pa = modulus_mpa * 1e6
            soil = Soil(
                shear_modulus_pa=modulus_pa,
                plastic_parameter_m=covarying_plastic_parameter(modulus_pa),
            )
            values = meter_values(soil, amplitude_mm * 1e-3)
            rows.append((f"{amplitude_mm}", f"{modulus_mpa}", f"{2.5 * modulus_mpa:.0f}", *values))
    return table(("A, mm", "G, MPa", "2 (1 + ν) G, MPa", "mode", *VALUE_HEAD), rows)


def plastic_table() -> str:
    """Meter values against p at one G."""
    rows = []
    for plastic_mm in PLASTIC_MM:
        soil = Soil(shear_modulus_pa=60e6, plastic_parameter_m=plastic_mm * 1e-3)
        rows.append((f"{plastic_mm}", *meter_values(soil, 0.8e-3)))
    return table(("p, mm", "mode", *VALUE_HEAD), rows)


def definitions_table() -> str:
    """What every meter value states of itself."""
    rows = [
        (
            f"{meter.label}",
            meter.unit or "–",
            "acceleration" if meter in METERS else "acceleration, eccentric's phase, machine",
            meter.source,
            yes(meter.verified),
        )
        for meter in (*METERS, *DRUM_METERS)
    ]
    return table(("value", "unit", "needs", "source of the definition", "verified"), rows)


def soils_table() -> str:
    """Grounds by name."""
    rows = []
    for preset in SOILS.values():
        soil = preset.soil(Machine())
        state = ("", "", "", "")
        if isinstance(preset.ground, GranularSoil):
            state = (
                f"{preset.ground.void_ratio:g}",
                f"{math.degrees(preset.ground.friction_angle_rad):.1f}",
                f"{preset.ground.unit_weight_n_m3 / 1e3:.2f}",
                f"{preset.ground.earth_pressure_coefficient:g}",
            )
        values = (f"{soil.shear_modulus_pa / 1e6:.1f}", f"{soil.plastic_parameter_m * 1e3:.2f}")
        rows.append(
            (f"`{preset.name}`", preset.doc, *state, *values, preset.source, yes(preset.verified))
        )
    head = ("soil", "what", "e", "φ, °", "γ, kN/m³", "K_0", "G, MPa", "p, mm")
    return table((*head, "source", "verified"), rows)


def machines_table() -> str:
    """Rollers by name."""
    rows = []
    for preset in MACHINES.values():
        machine = preset.machine
        rows.append(
            (
                f"`{preset.name}`",
                preset.doc,
                f"{machine.drum_mass_kg:.0f}",
                f"{machine.frame_mass_kg:.0f}",
                f"{2.0 * machine.drum_radius_m:.2f} × {machine.drum_width_m:.2f}",
                f"{preset.frequency_hz:g}",
                f"{preset.amplitude_m * 1e3:.2f}",
                preset.source,
                yes(preset.verified),
            )
        )
    head = ("machine", "what", "m_d, kg", "m_f, kg", "drum, m", "f, Hz", "A, mm")
    return table((*head, "source", "verified"), rows)


def n_gamma_table() -> str:
    """The plastic parameter by friction angle and by author of N_γ, for the paper's machine."""
    rows = []
    for degrees in (35, 40, 45, 50):
        state = replace(
            GranularSoil(), friction_angle_rad=math.radians(degrees), unit_weight_n_m3=20e3
        )
        values = [
            replace(state, n_gamma=author).soil(Machine()).plastic_parameter_m * 1e3
            for author in ("vesic", "meyerhof")
        ]
        rows.append((f"{degrees}", *(f"{value:.2f}" for value in values)))
    return table(("φ, °", "p by Vesić, mm", "p by Meyerhof, mm"), rows)


def yes(verified: bool) -> str:
    return "yes" if verified else "no"


PAGES = {
    "docs/meters.md": {
        "definitions": definitions_table,
        "stiffness": stiffness_table,
        "plastic": plastic_table,
    },
    "docs/soil.md": {
        "soils": soils_table,
        "machines": machines_table,
        "friction": n_gamma_table,
    },
}


def contents() -> dict[str, str]:
    """Return {path from the root: text} of the pages with their tables as they are now."""
    return {
        name: with_sections(ROOT / name, {mark: make() for mark, make in tables.items()})
        for name, tables in PAGES.items()
    }


def main(arguments: Sequence[str]) -> int:
    return write_or_check(ROOT, contents(), arguments, "python -m tools.generate_tables")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
