# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A trace in the formats of other tools: tables, sound, maps."""

from roller_sim_ros.export.formats import FORMATS
from roller_sim_ros.export.table import Request
from roller_sim_ros.export.tables import TABLES

__all__ = ["FORMATS", "TABLES", "Request"]
