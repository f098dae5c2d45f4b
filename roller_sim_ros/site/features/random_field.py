# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Scatter of the ground along the lane: a random field with a correlation length."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from roller_sim_ros.site.declaration import declare
from roller_sim_ros.site.features.feature import Feature, Stream, require_order
from roller_sim_ros.site.profile import Profile

CLIPPED_AT = 3.0
"""Standard deviations beyond which the field is cut off: 0.3 % of the cells."""


@dataclass(frozen=True)
class RandomField(Feature):
    """Multiplies G by a stationary lognormal field of mean 1; p goes with it.

    ln of the field is Gaussian with the correlation exp(−|Δx|/L): a first-order Markov process, drawn exactly at
    the cells' middles.
    """

    coefficient_of_variation: float = declare(
        "standard deviation of G over its mean", minimum=0.0, maximum=1.0
    )
    correlation_length_m: float = declare(
        "distance over which the correlation falls to 1/e (L)", minimum=0.01, maximum=10000.0
    )
    from_m: float = declare("chainage where it begins", default=0.0, minimum=0.0)
    to_m: float | None = declare("chainage where it ends; left out: the lane's end", default=None)
    seed: int | None = declare(
        "seed of its own; left out: it follows from the scenario's",
        default=None,
        minimum=0,
        maximum=2**63 - 1,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        require_order(self.from_m, self.to_m)

    def apply(self, profile: Profile, stream: Stream) -> None:
        """Multiply the cells by the field."""
        cells = len(profile.shear_modulus_pa)
        correlation = math.exp(-profile.cell_m / self.correlation_length_m)
        draws = stream(self.seed).standard_normal(cells)
        draws[1:] *= math.sqrt(1.0 - correlation * correlation)
        field = np.array(list(accumulate(draws, lambda last, draw: correlation * last + draw)))
        variance = math.log1p(self.coefficient_of_variation**2)
        scatter = math.sqrt(variance) * np.clip(field, -CLIPPED_AT, CLIPPED_AT)
        ratio = np.exp(scatter - 0.5 * variance)
        profile.stiffen(np.where(profile.between(self.from_m, self.to_m), ratio, 1.0))
