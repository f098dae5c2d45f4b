# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A spot where the ground differs, fading out to both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roller_sim_ros.site.declaration import declare
from roller_sim_ros.site.features.feature import Feature
from roller_sim_ros.site.profile import Array, Profile


@dataclass(frozen=True)
class Spot(Feature):
    """Multiplies G by a ratio in its middle and by its powers ½ (1 + cos) beside it, down to 1 at its ends."""

    at_m: float = declare("chainage of its middle", minimum=0.0)
    length_m: float = declare("length along the lane", minimum=0.01, maximum=10000.0)

    def weight(self, profile: Profile) -> Array:
        """Return 1 in the middle of the spot, 0 at its ends and beyond."""
        distance = np.abs(profile.centres_m - self.at_m) / (0.5 * self.length_m)
        fading: Array = 0.5 * (1.0 + np.cos(np.pi * np.minimum(distance, 1.0)))
        return fading

    def write(
        self,
        profile: Profile,
        stiffness_ratio: float,
        plastic_ratio: float | None,
        compactability: float,
    ) -> None:
        """Write the spot into the profile."""
        weight = self.weight(profile)
        profile.stiffen(
            stiffness_ratio**weight, None if plastic_ratio is None else plastic_ratio**weight
        )
        profile.compactability *= 1.0 - weight * (1.0 - compactability)
