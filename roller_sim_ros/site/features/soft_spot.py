# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A soft spot: ground that gives way and hardly compacts."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.site.declaration import declare
from roller_sim_ros.site.features.feature import Stream
from roller_sim_ros.site.features.spot import Spot
from roller_sim_ros.site.profile import Profile


@dataclass(frozen=True)
class SoftSpot(Spot):
    """Wet or badly filled ground."""

    stiffness_ratio: float = declare(
        "G in its middle over that of the ground around",
        default=0.5,
        minimum=0.02,
        maximum=1.0,
        source="assumed",
    )
    plastic_ratio: float | None = declare(
        "p in its middle over that of the ground around; left out: it goes with G to the power −0.5686",
        default=None,
        minimum=1.0,
        maximum=50.0,
    )
    compactability: float = declare(
        "share of the way to the limits of compaction that its middle can go",
        default=0.3,
        minimum=0.0,
        maximum=1.0,
        source="assumed: water that cannot drain keeps it soft",
    )

    def apply(self, profile: Profile, stream: Stream) -> None:
        """Write the spot into the profile."""
        del stream
        self.write(profile, self.stiffness_ratio, self.plastic_ratio, self.compactability)
