# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The tables that a trace is exported as. A further one: a function here, a line in `TABLES`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from roller_sim_ros.analysis.analyse import analyse
from roller_sim_ros.analysis.bag import open_bag
from roller_sim_ros.analysis.history import COLUMNS, WHOLE_NUMBERS
from roller_sim_ros.analysis.result import Options
from roller_sim_ros.analysis.samples import (
    ACCELERATION_TYPE,
    NANOSECONDS,
    TRUTH_TYPE,
    AccelerationReader,
    stamp_ns,
)
from roller_sim_ros.export.map import cells
from roller_sim_ros.export.table import Columns, Request, Table, gathered, topic_of

TRUTH_COLUMNS = {
    "vertical_m_s2": "vertical",
    "horizontal_m_s2": "horizontal",
    "soil_force_n": "soil_force",
    "drum_height_m": "drum_height",
    "soil_displacement_m": "soil_displacement",
    "plastic_depth_m": "plastic_depth",
    "contact_state": "contact_state",
}
"""Columns of the truth by the field of DrumSoilState that they hold."""


def samples(request: Request) -> Table:
    """Return what the accelerometer delivered: a row a sample. Times are s since the first sample."""
    bag = open_bag(request.path)
    name = topic_of(bag, request, ACCELERATION_TYPE, "record drum/acceleration")

    def rows() -> Iterator[Columns]:
        reader = AccelerationReader()
        start_ns: int | None = None
        for received in bag.messages({name}):
            request.progress(bag.progress)
            for piece in reader.read(received.message):
                start_ns = piece.stamp_ns if start_ns is None else start_ns
                index = np.arange(len(piece))
                turn = piece.phase_rad + index * piece.phase_increment_rad
                yield {
                    "time_s": (piece.stamp_ns - start_ns) / NANOSECONDS
                    + index * piece.sample_period_s,
                    "sample": piece.first_sample + index,
                    "vertical_m_s2": piece.vertical,
                    "horizontal_m_s2": piece.horizontal,
                    "eccentric_phase_rad": turn % (2.0 * np.pi),
                    "excitation_frequency_hz": np.full(len(piece), piece.excitation_hz),
                }

    return Table("samples", bag.parameters, lambda: gathered(rows()), lambda: bag.damage)


def truth(request: Request) -> Table:
    """Return the motion itself, soil force and displacements: a row a sample, heights over the first datum."""
    bag = open_bag(request.path)
    name = topic_of(bag, request, TRUTH_TYPE, "record truth")

    def rows() -> Iterator[Columns]:
        start_ns: int | None = None
        datum_m = 0.0
        for received in bag.messages({name}):
            request.progress(bag.progress)
            message = received.message
            if start_ns is None:
                start_ns, datum_m = stamp_ns(message), float(message.datum)
            index = np.arange(len(message.vertical))
            turn = message.eccentric_phase + index * message.phase_increment
            found: Columns = {
                "time_s": (stamp_ns(message) - start_ns) / NANOSECONDS
                + index * message.sample_period,
                "sample": int(message.sequence) + index,
                "eccentric_phase_rad": turn % (2.0 * np.pi),
                "excitation_frequency_hz": np.full(len(index), message.excitation_frequency),
            }
            for column, field in TRUTH_COLUMNS.items():
                found[column] = np.asarray(getattr(message, field))
            found["drum_height_m"] = found["drum_height_m"] + (message.datum - datum_m)
            found["shear_modulus_pa"] = np.full(len(index), message.shear_modulus)
            found["plastic_parameter_m"] = np.full(len(index), message.plastic_parameter)
            yield found

    return Table("truth", bag.parameters, lambda: gathered(rows()), lambda: bag.damage)


def meters(request: Request) -> Table:
    """Return the meter values, computed anew, recorded and true: a row a revolution."""
    analysis = analyse(request.path, Options(topic=request.topic), request.progress)
    history = analysis.history
    columns: Columns = {
        name: history.integers(name) if name in WHOLE_NUMBERS else history.floats(name)
        for name in COLUMNS
    }
    return Table(
        "meters",
        open_bag(request.path).parameters,
        lambda: iter([columns]),
        lambda: analysis.damage,
    )


def site_map(request: Request) -> Table:
    """Return the meter values gathered in square cells of the ground: a row a cell."""
    bag = open_bag(request.path)
    columns = cells(bag, request)
    return Table("map", bag.parameters, lambda: iter([columns]), lambda: bag.damage)


TABLES = {"samples": samples, "truth": truth, "meters": meters, "map": site_map}
"""What can be exported, by the name on the command line."""
