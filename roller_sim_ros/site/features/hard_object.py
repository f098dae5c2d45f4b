# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A buried hard object: a boulder, a pipe, an old foundation."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.site.declaration import declare
from roller_sim_ros.site.features.feature import Stream
from roller_sim_ros.site.features.spot import Spot
from roller_sim_ros.site.profile import Profile


@dataclass(frozen=True)
class HardObject(Spot):
    """What the drum feels of it at the surface; how deep it lies is not modelled."""

    stiffness_ratio: float = declare(
        "G over its middle over that of the ground around",
        default=4.0,
        minimum=1.0,
        maximum=50.0,
        source="assumed",
    )
    plastic_ratio: float | None = declare(
        "p over its middle over that of the ground around; left out: it goes with G to the power −0.5686",
        default=None,
        minimum=0.02,
        maximum=1.0,
    )

    def apply(self, profile: Profile, stream: Stream) -> None:
        """Write the object into the profile; it does not compact."""
        del stream
        self.write(profile, self.stiffness_ratio, self.plastic_ratio, 0.0)
