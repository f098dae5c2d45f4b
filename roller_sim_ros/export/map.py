# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Meter values on a grid over the ground, as intelligent-compaction viewers show them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import Bag, BagError
from roller_sim_ros.analysis.samples import METER_TYPE, NANOSECONDS, stamp_ns
from roller_sim_ros.export.table import Columns, Request, topic_of
from roller_sim_ros.meters.mode import Mode
from roller_sim_ros.sensors.geodesy import Geodetic, offset_of, place_of

FIX_TYPE = "sensor_msgs/msg/NavSatFix"

MOST_SILENT_S = 1.0
"""Longest time between two fixes that is bridged by a straight line."""

JUMPING = (Mode.DOUBLE_JUMP, Mode.QUAD_JUMP, Mode.CHAOTIC)


def cells(bag: Bag, request: Request) -> Columns:
    """Return meter values gathered in square cells, sides to east and north; a row a cell with values.

    A value is put where the antenna was at its stamp, between the two fixes around it. The origin is the
    first fix; values further than `MOST_SILENT_S` from one are left out.

    Parameters
    ----------
    bag : Bag
        With `CompactionMeter` and `NavSatFix` messages.
    request : Request
        Topic of the meter, side of the cells.

    Raises
    ------
    BagError
        If positions or values are missing, or none lies near the other.
    """
    meter = topic_of(bag, request, METER_TYPE, "record meter")
    fix = topic_of(
        bag,
        replace(request, topic=None),
        FIX_TYPE,
        "a map needs positions: let the roller carry a gnss sensor",
    )
    values: list[tuple[float, ...]] = []
    fixes: list[tuple[float, ...]] = []
    origin: Geodetic | None = None
    start_ns = 0
    for received in bag.messages({meter, fix}):
        request.progress(bag.progress)
        message = received.message
        start_ns = start_ns or stamp_ns(message)
        time_s = (stamp_ns(message) - start_ns) / NANOSECONDS
        if received.topic == meter:
            values.append((time_s, message.cmv, message.rmv, message.mode))
        elif message.status.status >= 0:
            place = Geodetic(message.latitude, message.longitude, message.altitude)
            origin = origin or place
            fixes.append((time_s, *offset_of(origin, place)[:2]))
    if not (origin and fixes and values):
        raise BagError(f"{request.path}: there are no meter values with positions in it")
    return _gathered(request, origin, np.array(fixes), np.array(values))


def _gathered(
    request: Request,
    origin: Geodetic,
    fixes: NDArray[np.float64],
    values: NDArray[np.float64],
) -> Columns:
    time_s, cell_m = values[:, 0], request.cell_m
    after = np.clip(np.searchsorted(fixes[:, 0], time_s), 1, max(1, len(fixes) - 1))
    before_s, after_s = fixes[after - 1, 0], fixes[np.minimum(after, len(fixes) - 1), 0]
    near = (time_s >= before_s) & (time_s <= after_s) & (after_s - before_s <= MOST_SILENT_S)
    near &= ~np.isnan(values[:, 1])
    if not near.any():
        raise BagError(f"{request.path}: no meter value lies between two fixes")
    values, time_s = values[near], time_s[near]
    indices = np.stack(
        [
            np.floor(np.interp(time_s, fixes[:, 0], fixes[:, column]) / cell_m).astype(np.int64)
            for column in (1, 2)
        ],
        axis=1,
    )
    found, cell_of = np.unique(indices, axis=0, return_inverse=True)
    cell_of = cell_of.reshape(-1)
    count = np.bincount(cell_of)
    last = np.zeros(len(found), dtype=np.int64)
    last[cell_of] = np.arange(len(cell_of))
    middle = (found + 0.5) * cell_m
    places = [place_of(origin, east_m, north_m, 0.0) for east_m, north_m in middle]
    jumping = np.isin(values[:, 3], JUMPING).astype(float)

    def mean(column: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.bincount(cell_of, weights=column) / count

    return {
        "latitude_deg": np.array([place.latitude_deg for place in places]),
        "longitude_deg": np.array([place.longitude_deg for place in places]),
        "east_m": middle[:, 0],
        "north_m": middle[:, 1],
        "size_m": np.full(len(found), cell_m),
        "values": count,
        "last_time_s": time_s[last],
        "cmv_last": values[last, 1],
        "cmv_mean": mean(values[:, 1]),
        "rmv_last": values[last, 2],
        "rmv_mean": mean(np.nan_to_num(values[:, 2])),
        "jumping_share": mean(jumping),
    }
