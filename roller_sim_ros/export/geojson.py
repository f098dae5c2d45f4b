# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The map as GeoJSON."""

from __future__ import annotations

import json
import math
from pathlib import Path

from roller_sim_ros.export.table import Table
from roller_sim_ros.sensors.geodesy import Geodetic, place_of

_CORNERS = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5))
"""Counter-clockwise and closed (RFC 7946, section 3.1.6), in sides of the cell from its middle."""


def write_geojson(table: Table, path: Path) -> None:
    """Write a FeatureCollection, a polygon a cell with its values as properties; unknown ones are null."""
    columns = {name: column.tolist() for name, column in table.whole().items()}
    features = []
    for row in zip(*columns.values(), strict=True):
        cell = dict(zip(columns, row, strict=True))
        middle = Geodetic(cell.pop("latitude_deg"), cell.pop("longitude_deg"), 0.0)
        size_m = cell["size_m"]
        corners = [place_of(middle, east * size_m, north * size_m, 0.0) for east, north in _CORNERS]
        ring = [[round(it.longitude_deg, 9), round(it.latitude_deg, 9)] for it in corners]
        features.append(
            {
                "type": "Feature",
                "geometry": {"type": "Polygon", "coordinates": [ring]},
                "properties": {
                    name: None if math.isnan(value) else value for name, value in cell.items()
                },
            }
        )
    collection = {"type": "FeatureCollection", "features": features}
    path.write_text(json.dumps(collection, allow_nan=False) + "\n", encoding="utf-8")
