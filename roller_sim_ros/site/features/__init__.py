# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Features of the ground along the lane; a new one is one file and one line here."""

from roller_sim_ros.site.features.feature import Feature, Stream
from roller_sim_ros.site.features.gradient import Gradient
from roller_sim_ros.site.features.hard_object import HardObject
from roller_sim_ros.site.features.random_field import RandomField
from roller_sim_ros.site.features.section import Section
from roller_sim_ros.site.features.soft_spot import SoftSpot

FEATURES: dict[str, type[Feature]] = {
    "section": Section,
    "gradient": Gradient,
    "random_field": RandomField,
    "soft_spot": SoftSpot,
    "hard_object": HardObject,
}
"""All features by the name that a scenario's ``kind`` gives them."""

__all__ = [
    "FEATURES",
    "Feature",
    "Gradient",
    "HardObject",
    "RandomField",
    "Section",
    "SoftSpot",
    "Stream",
]
