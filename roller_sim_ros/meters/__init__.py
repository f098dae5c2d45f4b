# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Compaction meters: CMV, RMV, period and mode, from published samples or from the truth."""

from roller_sim_ros.meters.compaction_meter import CompactionMeter, MeterValue
from roller_sim_ros.meters.mode import Mode
from roller_sim_ros.meters.status import Status
from roller_sim_ros.meters.summary import SUMMARY_REVOLUTIONS, Summary, summarise
from roller_sim_ros.meters.truth import TruthMeter, TruthValue

__all__ = [
    "SUMMARY_REVOLUTIONS",
    "CompactionMeter",
    "MeterValue",
    "Mode",
    "Status",
    "Summary",
    "TruthMeter",
    "TruthValue",
    "summarise",
]
