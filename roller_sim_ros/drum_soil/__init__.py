# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Drum and soil: the phases of Figure 13, a kernel for each kind of half space.

A new half space is one file with a `Ground` and one line in `GROUNDS` (and its name among the choices of the
parameter ``half_space.model``). The phases themselves are in `contact`, one part of a step in `parts`.
"""

from roller_sim_ros.drum_soil.exact_ground import ExactGround
from roller_sim_ros.drum_soil.ground import Ground, LoadedStrip, loaded_strip
from roller_sim_ros.drum_soil.rational_ground import RationalGround
from roller_sim_ros.drum_soil.state import AIR, LOADING, UNLOADING
from roller_sim_ros.drum_soil.two_pole_ground import TwoPoleGround

GROUNDS: dict[str, type[Ground]] = {
    "exact": ExactGround,
    "rational": RationalGround,
    "two-pole": TwoPoleGround,
}

__all__ = [
    "AIR",
    "GROUNDS",
    "LOADING",
    "UNLOADING",
    "ExactGround",
    "Ground",
    "RationalGround",
    "LoadedStrip",
    "TwoPoleGround",
    "loaded_strip",
]
