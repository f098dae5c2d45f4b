"""A trace in the formats of other tools: tables, sound, maps."""

from roller_sim_ros.export.formats import FORMATS
from roller_sim_ros.export.table import Request
from roller_sim_ros.export.tables import TABLES

__all__ = ["FORMATS", "TABLES", "Request"]
