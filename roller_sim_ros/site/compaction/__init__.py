# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Laws of how passes compact the ground; a new one is one file and one line here."""

from roller_sim_ros.site.compaction.exponential import Exponential
from roller_sim_ros.site.compaction.hyperbolic import Hyperbolic
from roller_sim_ros.site.compaction.law import CompactionLaw

LAWS: dict[str, type[CompactionLaw]] = {
    "exponential": Exponential,
    "hyperbolic": Hyperbolic,
}
"""All laws by the name that a scenario's ``kind`` gives them."""

__all__ = ["LAWS", "CompactionLaw", "Exponential", "Hyperbolic"]
