# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Ground that becomes another one over a stretch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.site.declaration import declare, like
from roller_sim_ros.site.features.feature import Feature, Stream, require_order
from roller_sim_ros.site.profile import Profile


@dataclass(frozen=True)
class Gradient(Feature):
    """From what the ground is where the stretch begins, linearly to other values where it ends; they hold beyond."""

    from_m: float = declare("chainage where it begins", default=0.0, minimum=0.0)
    to_m: float | None = declare("chainage where it ends; left out: the lane's end", default=None)
    shear_modulus_mpa: float | None = like(
        "soil.shear_modulus_pa", "shear modulus where it ends; left out: it stays"
    )
    plastic_mm: float | None = like(
        "soil.plastic_parameter_m",
        "plastic parameter where it ends; left out: it goes with G to the power −0.5686, an assumption",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require_order(self.from_m, self.to_m)
        if self.shear_modulus_mpa is None and self.plastic_mm is None:
            raise ParameterError(
                "shear_modulus_mpa", None, "a gradient needs shear_modulus_mpa or plastic_mm"
            )

    def apply(self, profile: Profile, stream: Stream) -> None:
        """Write the slope into the cells from where it begins to the lane's end."""
        del stream
        centres = profile.centres_m
        first = int(np.searchsorted(centres, self.from_m))
        if first == len(centres):
            return
        to_m = float(centres[-1]) if self.to_m is None else self.to_m
        share = np.clip((centres[first:] - self.from_m) / max(to_m - self.from_m, 1e-9), 0.0, 1.0)
        before = float(profile.shear_modulus_pa[first])
        plastic = float(profile.plastic_parameter_m[first])
        ratio = np.ones(len(centres))
        plastic_ratio = None
        if self.shear_modulus_mpa is not None:
            ratio[first:] = 1.0 + share * (self.shear_modulus_mpa * 1e6 / before - 1.0)
        if self.plastic_mm is not None:
            plastic_ratio = np.ones(len(centres))
            plastic_ratio[first:] = 1.0 + share * (self.plastic_mm / 1e3 / plastic - 1.0)
        profile.shear_modulus_pa[first:] = before
        profile.plastic_parameter_m[first:] = plastic
        profile.stiffen(ratio, plastic_ratio)
