# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A stretch of other ground."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.parameters import Soil
from roller_sim_ros.site.declaration import declare
from roller_sim_ros.site.features.feature import Feature, Stream, require_order
from roller_sim_ros.site.ground_values import GroundValues
from roller_sim_ros.site.profile import Profile


@dataclass(frozen=True)
class Section(GroundValues, Feature):
    """A stretch of one ground with sharp ends."""

    from_m: float = declare("chainage where it begins", default=0.0, minimum=0.0)
    to_m: float | None = declare("chainage where it ends; left out: the lane's end", default=None)

    def __post_init__(self) -> None:
        super().__post_init__()
        require_order(self.from_m, self.to_m)

    def apply(self, profile: Profile, stream: Stream) -> None:
        """Write the ground into the cells of the stretch."""
        del stream
        inside = profile.between(self.from_m, self.to_m)
        for index in inside.nonzero()[0]:
            soil = self.soil(
                profile.machine,
                Soil(
                    float(profile.shear_modulus_pa[index]),
                    float(profile.plastic_parameter_m[index]),
                    float(profile.density_kg_m3[index]),
                    float(profile.poisson_ratio[index]),
                ),
            )
            profile.shear_modulus_pa[index] = soil.shear_modulus_pa
            profile.plastic_parameter_m[index] = soil.plastic_parameter_m
            profile.density_kg_m3[index] = soil.density_kg_m3
            profile.poisson_ratio[index] = soil.poisson_ratio
