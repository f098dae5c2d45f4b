# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The construction site: where the roller is and what ground is there."""

from roller_sim_ros.site.compaction import LAWS, CompactionLaw
from roller_sim_ros.site.features import FEATURES, Feature
from roller_sim_ros.site.ground_values import GroundValues
from roller_sim_ros.site.lane_site import GroundPlan, Lane, LaneSite
from roller_sim_ros.site.site import MAX_SPEED_M_S, Position, Site, UniformSite
from roller_sim_ros.site.streams import stream
from roller_sim_ros.site.travel import Plan

__all__ = [
    "FEATURES",
    "LAWS",
    "MAX_SPEED_M_S",
    "CompactionLaw",
    "Feature",
    "GroundPlan",
    "GroundValues",
    "Lane",
    "LaneSite",
    "Plan",
    "Position",
    "Site",
    "UniformSite",
    "stream",
]
