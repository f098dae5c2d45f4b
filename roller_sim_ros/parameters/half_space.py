# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How the elastic half space is modelled (paper, eqs 5 to 10)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters.quantity import ParameterGroup, parameter


@dataclass(frozen=True)
class HalfSpace(ParameterGroup):
    """Model of the half space and the constants the paper leaves open."""

    group: ClassVar[str] = "half_space"

    model: str = parameter(
        "exact",
        "",
        "exact: the undamped half space itself; rational: poles and zeros fitted to it; two-pole: the paper's "
        "second-order approximation",
        choices=("exact", "rational", "two-pole"),
        flag="--half-space",
    )
    area_factor: float = parameter(
        4.0,
        "",
        "loaded width of the half space over the contact width (k); the paper gives no number",
        minimum=1.0,
        maximum=10.0,
        flag="--area-factor",
    )
    static_formula: str = parameter(
        "exact",
        "",
        "influence integral I(α): the exact Boussinesq integral or the paper's 0.66 ln(7.9 α)",
        choices=("exact", "paper"),
        flag="--static-formula",
    )
    quality_factor: float = parameter(
        0.4,
        "",
        "two-pole only: Q, lowered from 0.6 by the paper for internal damping",
        minimum=0.05,
        maximum=5.0,
        flag="--quality-factor",
    )
    frequency_factor: float = parameter(
        2.75,
        "",
        "two-pole only: ω0 √(BL)/v_s",
        minimum=0.2,
        maximum=20.0,
        flag="--frequency-factor",
    )
    order: int = parameter(
        4,
        "",
        "rational only: number of poles of the fitted transfer function",
        minimum=1,
        maximum=8,
        flag="--order",
    )
