# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements on the plastic layer and on soil mechanics: eqs (1) to (4), Figures 2 and 14."""

from __future__ import annotations

from dataclasses import replace
from typing import overload

import numpy as np

from roller_sim_ros.parameters import Machine
from roller_sim_ros.soil_mechanics import SOILS, GranularSoil, scaled_plastic_parameter
from roller_sim_ros.validation.statement import Finding, Statement, percent
from roller_sim_ros.validation.study import MODULI_PA, SOFT, Array, Ground, Study, covarying


@overload
def circle_over_parabola(settlement_m: float, radius_m: float) -> float: ...
@overload
def circle_over_parabola(settlement_m: Array, radius_m: float) -> Array: ...
def circle_over_parabola(settlement_m: float | Array, radius_m: float) -> float | Array:
    """Return the failure load under a circle over that under its parabola, at one settlement.

    The load goes with the contact's half width squared: 2 r z − z² of the circle, 2 r z of the parabola.
    """
    return 1.0 - settlement_m / (2.0 * radius_m)


def granular_presets(machine: Machine) -> dict[str, Ground]:
    """Return the gravels by name under a machine, from soil mechanics alone, from loose to dense."""
    found = {}
    for name, preset in SOILS.items():
        if isinstance(preset.ground, GranularSoil) and "gravel" in name:
            soil = preset.soil(machine)
            found[name] = (soil.shear_modulus_pa, soil.plastic_parameter_m)
    return dict(sorted(found.items(), key=lambda item: item[1][0]))


def linear_plastic_layer(study: Study) -> Finding:
    """Settlement against load under a circle in place of the parabola."""
    worst = 1.0 - circle_over_parabola(6.0 * SOFT[1], study.base.machine.drum_radius_m)
    return Finding.of(
        worst < 0.01,
        f"a circle bears {percent(worst)} less than the line at {6e3 * SOFT[1]:.1f} mm, six times the static load",
    )


def weak_is_plastic(study: Study) -> Finding:
    """Gravels from soil mechanics, loose to dense."""
    grounds = list(granular_presets(study.base.machine).values())
    falls = bool(np.all(np.diff([plastic for _, plastic in grounds]) < 0.0))
    texts = ", ".join(
        f"({modulus / 1e6:.0f} MPa, {plastic * 1e3:.2g} mm)" for modulus, plastic in grounds
    )
    return Finding.of(falls, f"loose to dense gravel by eqs (1) to (4): {texts}")


def scaled_with_radius(study: Study) -> Finding:
    """What twice the radius does to p under the same line load."""
    machine = study.base.machine
    larger = replace(machine, drum_radius_m=2.0 * machine.drum_radius_m)
    share = scaled_plastic_parameter(1.0, machine, larger)
    return Finding.of(
        abs(share - 1.0) > 0.1,
        f"twice the radius under the same line load gives {share:.3g} p (eqs 1 and 2)",
    )


def falling_covariation(study: Study) -> Finding:  # noqa: ARG001
    """The assumed curve."""
    plastic = [covarying(float(modulus))[1] for modulus in np.linspace(*MODULI_PA, 50)]
    return Finding.of(
        bool(np.all(np.diff(plastic) < 0.0)),
        f"by construction: a power law through the text's two points, {plastic[0] * 1e3:.2g} mm at 15 MPa to "
        f"{plastic[-1] * 1e3:.2g} mm at 120; the curve itself is lost",
    )


STATEMENTS = (
    Statement(
        "linear_plastic_layer",
        "Plastic deformation, Figure 2",
        "with a parabola for the cylinder, settlement and bearing capacity are linear",
        linear_plastic_layer,
        "figures 2",
        half_space=False,
    ),
    Statement(
        "falling_covariation",
        "Soil data, Figure 14",
        "a weak ground with low G has a high p",
        falling_covariation,
        "figures 14",
        half_space=False,
    ),
    Statement(
        "weak_is_plastic",
        "Soil data, Figure 14",
        "the same, from soil mechanics",
        weak_is_plastic,
        "figures 14",
        half_space=False,
    ),
    Statement(
        "scaled_with_radius",
        "Soil data",
        "between rollers p is scaled to the drum's radius",
        scaled_with_radius,
        "run --machine cs-563e --soil paper-soft",
        half_space=False,
    ),
)
