# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Stretches of a run that show how it moved: one for each mode that lasted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.decoding import Decoder
from roller_sim_ros.analysis.samples import ACCELERATION_TYPE, TRUTH_TYPE
from roller_sim_ros.meters import Mode
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.report.run_record import FieldReader, RunRecord
from roller_sim_ros.traces.columns import read_messages
from roller_sim_ros.traces.reader import TraceReader

REVOLUTIONS = 16
SAMPLES = REVOLUTIONS * SAMPLES_PER_REVOLUTION
MOST = 4
"""Windows of a report, those of the modes that lasted longest."""
LEAST = 4
"""Revolutions in a row that make a mode worth a window: the meter may name one on the way between two others."""

TRUTH_FIELDS = ("horizontal", "soil_force", "drum_height", "contact_state")


@dataclass(frozen=True)
class Window:
    """Whole revolutions in one mode.

    Attributes
    ----------
    mode : Mode
        Mode as the meter tells it.
    share : float
        Part of the run's revolutions in this mode.
    time_s, excitation_hz : float
        Where the window ends, and at what frequency.
    vertical, horizontal : ndarray, shape (2048,)
        Acceleration as delivered, m/s².
    truth : dict of ndarray
        Fields of DrumSoilState by name, the height over the untouched surface; empty when the trace holds none there.
    """

    mode: Mode
    share: float
    time_s: float
    excitation_hz: float
    vertical: NDArray[np.float64]
    horizontal: NDArray[np.float64]
    truth: dict[str, NDArray[np.float64]]


def read_windows(record: RunRecord, progress: Callable[[float], None]) -> list[Window]:
    """Return a window for each of the modes that lasted longest, in the order of time.

    Of a mode the middle of its longest stretch is shown; without meter values, or where samples are missing, there
    is none.
    """
    chosen = _chosen(record)
    if not chosen:
        return []
    decoder = Decoder()
    reader = TraceReader(record.path)
    names = [record.acceleration_topic, *([record.truth_topic] if record.truth_topic else [])]
    readers: dict[str, FieldReader] = {}
    for name in names:
        decoder.add(reader.topics[name].type_name, reader.topics[name].schema_text)
        readers[name] = FieldReader(decoder, reader.topics[name].type_name)
    stores = [_Store(last_sample - SAMPLES + 1) for _, _, last_sample, _, _ in chosen]
    spans = [span for *_, span in chosen]
    fields = {
        ACCELERATION_TYPE: ("vertical", "horizontal"),
        TRUTH_TYPE: TRUTH_FIELDS,
    }
    for chunk in read_messages(record.path, names, progress, between=spans):
        for name, messages in chunk.items():
            kind = reader.topics[name].type_name
            for layout, _, alike in readers[name].parts(messages):
                first = layout.field(alike, "sequence").astype(np.int64)
                for field in fields[kind]:
                    values = layout.field(alike, field)
                    if field == "drum_height":
                        # The datum follows the drum where it sinks; over one height, both together.
                        values = values + layout.field(alike, "datum")[:, None]
                    for store in stores:
                        store.put(kind, field, first, values)
    found = []
    for (mode, share, _, time_s, _), store in zip(chosen, stores, strict=True):
        vertical = store.whole(ACCELERATION_TYPE, "vertical")
        horizontal = store.whole(ACCELERATION_TYPE, "horizontal")
        if vertical is None or horizontal is None:
            continue
        truth = {name: store.whole(TRUTH_TYPE, name) for name in TRUTH_FIELDS}
        known = {name: values for name, values in truth.items() if values is not None}
        frequency = np.interp(
            time_s, record.envelope["time_s"], record.envelope["excitation_frequency"]
        )
        found.append(
            Window(
                mode,
                share,
                time_s,
                float(frequency),
                vertical,
                horizontal,
                known if len(known) == len(TRUTH_FIELDS) else {},
            )
        )
    return sorted(found, key=lambda window: window.time_s)


def _chosen(record: RunRecord) -> list[tuple[Mode, float, int, float, tuple[int, int]]]:
    """Return mode, share of the revolutions, last sample, its time, and the log times around of the windows."""
    if not record.meter:
        return []
    modes = np.where(record.meter["status"] == 0, record.meter["mode"], int(Mode.UNKNOWN))
    edges = np.flatnonzero(np.diff(modes)) + 1
    starts = np.concatenate([[0], edges])
    ends = np.concatenate([edges, [len(modes)]])
    found: list[tuple[Mode, float, int, float, tuple[int, int]]] = []
    for mode in Mode:
        of_mode = modes[starts] == int(mode)
        lengths = (ends - starts) * of_mode
        longest = int(np.argmax(lengths))
        if mode is Mode.UNKNOWN or lengths[longest] < LEAST:
            continue
        place = int(starts[longest] + lengths[longest] // 2)
        share = float(np.count_nonzero(modes == int(mode)) / len(modes))
        last_sample = int(record.meter["last_sample"][place])
        # When they were received need not be when they are from.
        log_ns = record.meter["log_time_ns"]
        span = (
            int(log_ns[max(0, place - 2 * REVOLUTIONS)]),
            int(log_ns[min(len(log_ns) - 1, place + REVOLUTIONS)]),
        )
        found.append((mode, share, last_sample, float(record.meter["time_s"][place]), span))
    found.sort(key=lambda item: -item[1])
    return found[:MOST]


class _Store:
    """Samples of one window, by field, as they come."""

    def __init__(self, first_sample: int) -> None:
        self._first = first_sample
        self._values: dict[tuple[str, str], NDArray[np.float64]] = {}

    def put(
        self, kind: str, field: str, first: NDArray[np.int64], values: NDArray[np.generic]
    ) -> None:
        """Keep what of messages lies in the window; values are of the shape (messages, samples)."""
        inside = (first + values.shape[1] > self._first) & (first < self._first + SAMPLES)
        if not inside.any():
            return
        kept = self._values.setdefault((kind, field), np.full(SAMPLES, np.nan))
        index = first[inside, None] - self._first + np.arange(values.shape[1])
        flat, samples = index.ravel(), values[inside].ravel()
        within = (flat >= 0) & (flat < SAMPLES)
        kept[flat[within]] = samples[within]

    def whole(self, kind: str, field: str) -> NDArray[np.float64] | None:
        """Return all samples of a field, None when any is missing."""
        values = self._values.get((kind, field))
        return None if values is None or np.isnan(values).any() else values
