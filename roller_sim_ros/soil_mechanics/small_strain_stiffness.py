# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Shear modulus of granular ground at small strain: eqs (3) and (4).

    G_max = C_1 (C_2 − e)² / (1 + e) √σ̄_0,    σ̄_0 = (1 + 2 K_0)/3 σ_v

with the constants of Hardin and Richart (1963), which are for G and σ̄_0 in pounds per square inch:

============== ===== ==== ==========================
grains          C_1  C_2  void ratios they tested
============== ===== ==== ==========================
round           2630 2.17 about 0.3 to 0.8
angular         1230 2.97 about 0.6 to 1.3
============== ===== ==== ==========================

Both sides in the same unit, C_1 has the dimension √(stress). So in any unit
G_max = C_1 (C_2 − e)²/(1 + e) √(σ̄_0 · 1 psi), that is C_1 √6.895 = 6906 and 3230 for kilopascals. From the
literature as commonly cited (Richart, Hall and Woods, Vibrations of Soils and Foundations, 1970), not
verified in the original.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roller_sim_ros.parameters import ParameterError

PSI_PA = 0.45359237 * 9.80665 / 0.0254**2
"""One pound-force per square inch, Pa."""


@dataclass(frozen=True)
class Grains:
    """Constants of eq. (3).

    Attributes
    ----------
    factor_sqrt_psi : float
        C_1, √psi.
    void_ratio : float
        C_2, the void ratio at which the formula gives no stiffness.
    """

    factor_sqrt_psi: float
    void_ratio: float


GRAINS: dict[str, Grains] = {
    "round": Grains(2630.0, 2.17),
    "angular": Grains(1230.0, 2.97),
}
"""Hardin and Richart (1963) by the shape of the grains."""


def small_strain_modulus(void_ratio: float, mean_stress_pa: float, grains: str = "round") -> float:
    """Return G_max, eq. (3), Pa.

    Parameters
    ----------
    void_ratio : float
        e, volume of the pores over that of the grains; below C_2.
    mean_stress_pa : float
        σ̄_0, mean principal effective stress, Pa.
    grains : str
        Shape, a key of `GRAINS`.

    Raises
    ------
    ParameterError
        If the grains are unknown, the void ratio is not between 0 and C_2, or the stress is not positive.
    """
    if grains not in GRAINS:
        raise ParameterError("grains", grains, f"must be one of {', '.join(GRAINS)}")
    constants = GRAINS[grains]
    if not 0.0 < void_ratio < constants.void_ratio:
        raise ParameterError(
            "void_ratio", void_ratio, f"must be between 0 and {constants.void_ratio:g}"
        )
    if not (mean_stress_pa > 0.0 and math.isfinite(mean_stress_pa)):
        raise ParameterError("mean_stress_pa", mean_stress_pa, "must be positive")
    density = (constants.void_ratio - void_ratio) ** 2 / (1.0 + void_ratio)
    return constants.factor_sqrt_psi * density * math.sqrt(mean_stress_pa * PSI_PA)


def mean_effective_stress(
    unit_weight_n_m3: float, depth_m: float, earth_pressure_coefficient: float
) -> float:
    """Return σ̄_0 = (1 + 2 K_0)/3 γ z in a level layer above the water table, eq. (4), Pa.

    Parameters
    ----------
    unit_weight_n_m3 : float
        γ, N/m³.
    depth_m : float
        z, m.
    earth_pressure_coefficient : float
        K_0, horizontal over vertical effective stress at rest; grows with compaction.
    """
    return (1.0 + 2.0 * earth_pressure_coefficient) / 3.0 * unit_weight_n_m3 * depth_m
