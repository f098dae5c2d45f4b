# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`roller-sim export`: each format is read back with what its users read it with, and holds what the trace holds."""

from __future__ import annotations

import csv
import json
import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
from numpy.typing import NDArray
from scipy.io import loadmat, wavfile

from roller_sim_ros import commands
from roller_sim_ros.sensors.geodesy import Geodetic, offset_of, place_of
from roller_sim_ros.traces.reader import TraceReader
from roller_sim_ros.wire.types import decode

SCENARIO = """\
title: short lane
machine: {preset: paper-10t}
lane: {length_m: 6}
travel: {speed_m_s: 1.5, passes: 2}
ground: {preset: paper-soft}
exciter: {frequency_hz: 28, amplitude_mm: 1.6}
sensors:
  - name: mems_50g
  - name: gnss
seed: 3
"""
FREQUENCY_HZ = 28.0


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("export")
    (folder / "lane.yaml").write_text(SCENARIO, encoding="utf-8")
    path = folder / "lane.mcap"
    assert commands.main(["run", str(folder / "lane.yaml"), "--record", str(path)]) == 0
    return path


@pytest.fixture(scope="module")
def recorded(trace: Path) -> dict[str, list[Any]]:
    """Messages by topic, decoded without what is tested."""
    found: dict[str, list[Any]] = {}
    for item in TraceReader(trace).messages({"/drum/acceleration", "/truth", "/meter", "/fix"}):
        found.setdefault(item.topic, []).append(decode(item.data, item.type_name))
    return found


def joined(messages: list[Any], field: str) -> NDArray[Any]:
    return np.concatenate([np.asarray(getattr(item, field)) for item in messages])


def times(messages: list[Any]) -> NDArray[np.float64]:
    """Times of the samples since the first, s."""
    first = messages[0].header.stamp
    return np.concatenate(
        [
            (item.header.stamp.sec - first.sec)
            + (item.header.stamp.nanosec - first.nanosec) * 1e-9
            + np.arange(len(item.vertical)) * item.sample_period
            for item in messages
        ]
    )


def export(trace: Path, name: str, *arguments: str) -> Path:
    path = trace.with_name(name)
    assert commands.main(["export", str(trace), str(path), *arguments]) == 0
    return path


def test_parquet_holds_the_samples_bit_for_bit(trace: Path, recorded: dict[str, list[Any]]) -> None:
    frame = pandas.read_parquet(export(trace, "samples.parquet"))
    messages = recorded["/drum/acceleration"]
    assert len(frame) == sum(len(item.vertical) for item in messages)
    np.testing.assert_array_equal(frame["vertical_m_s2"], joined(messages, "vertical"))
    np.testing.assert_array_equal(frame["horizontal_m_s2"], joined(messages, "horizontal"))
    np.testing.assert_array_equal(frame["sample"], np.arange(len(frame)))
    np.testing.assert_allclose(frame["time_s"], times(messages), atol=2e-9)
    turn = np.angle(np.exp(1j * np.diff(frame["eccentric_phase_rad"])))
    np.testing.assert_allclose(turn, 2.0 * math.pi / 128, rtol=1e-9)


def test_parquet_tells_the_parameters_of_the_run(trace: Path) -> None:
    from pyarrow.parquet import read_schema

    path = export(trace, "truth.parquet", "--table", "truth")
    notes = json.loads(read_schema(path).metadata[b"roller_sim_parameters"])
    assert float(notes["exciter.frequency_hz"]) == FREQUENCY_HZ


def test_matlab_holds_the_truth_as_columns(trace: Path, recorded: dict[str, list[Any]]) -> None:
    found = loadmat(export(trace, "truth.mat", "--table", "truth"))
    messages = recorded["/truth"]
    force = joined(messages, "soil_force")
    assert found["soil_force_n"].shape == (len(force), 1)
    np.testing.assert_array_equal(found["soil_force_n"][:, 0], force)
    np.testing.assert_array_equal(found["contact_state"][:, 0], joined(messages, "contact_state"))
    # The datum moves where the ground changes; the height of the column is over the first one.
    datum = np.repeat([it.datum for it in messages], [len(it.vertical) for it in messages])
    height = joined(messages, "drum_height") + datum - datum[0]
    np.testing.assert_allclose(found["drum_height_m"][:, 0], height, atol=1e-9)
    assert found["parameters"]["exciter_frequency_hz"][0, 0][0] == repr(FREQUENCY_HZ)


def test_csv_holds_a_row_a_revolution(trace: Path, recorded: dict[str, list[Any]]) -> None:
    frame = pandas.read_csv(export(trace, "meters.csv"))
    messages = recorded["/meter"]
    assert frame["last_sample"].tolist() == [item.last_sample for item in messages]
    np.testing.assert_array_equal(frame["recorded_cmv"], [item.cmv for item in messages])


def test_csv_of_samples_reads_back_to_the_same_bits(
    trace: Path, recorded: dict[str, list[Any]]
) -> None:
    with export(trace, "samples.csv", "--table", "samples").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    vertical = np.array([row["vertical_m_s2"] for row in rows], dtype=np.float32)
    np.testing.assert_array_equal(vertical, joined(recorded["/drum/acceleration"], "vertical"))


def test_sound_has_the_drum_s_tones(trace: Path, recorded: dict[str, list[Any]]) -> None:
    rate_hz, sound = wavfile.read(export(trace, "drum.wav"))
    assert (rate_hz, sound.dtype, sound.shape[1]) == (8000, np.int16, 2)
    messages = recorded["/drum/acceleration"]
    vertical = joined(messages, "vertical").astype(float)
    seconds = sum(len(item.vertical) * item.sample_period for item in messages)
    assert abs(len(sound) / rate_hz - seconds) < 1.0 / FREQUENCY_HZ
    assert np.abs(sound).max() == 32767
    # One second of steady vibration: the same amplitudes of the orders, up to the scale.
    scale = np.abs(np.stack([vertical, joined(messages, "horizontal")])).max() / 32767
    for channel, field in enumerate(("vertical", "horizontal")):
        heard = np.fft.rfft(sound[24_000:32_000, channel] * scale) / 8000
        samples = joined(messages, field).astype(float)
        time_s = times(messages)
        chosen = (time_s >= 3.0 - 1e-9) & (time_s < 4.0 - 1e-9)
        measured = np.fft.rfft(samples[chosen]) / chosen.sum()
        for order in (1, 2, 3):
            line = round(order * FREQUENCY_HZ)
            assert abs(heard[line]) == pytest.approx(abs(measured[line]), rel=0.03, abs=0.05)


def test_map_puts_the_values_where_they_were_measured(
    trace: Path, recorded: dict[str, list[Any]]
) -> None:
    collection = json.loads(export(trace, "map.geojson", "--cell-m", "2").read_text("utf-8"))
    assert collection["type"] == "FeatureCollection"
    valid = [item for item in recorded["/meter"] if not math.isnan(item.cmv)]
    fixes = [Geodetic(it.latitude, it.longitude, it.altitude) for it in recorded["/fix"]]
    total = 0
    for feature in collection["features"]:
        (ring,) = feature["geometry"]["coordinates"]
        assert ring[0] == ring[-1]
        corners = [offset_of(fixes[0], Geodetic(lat, lon, 0.0)) for lon, lat in ring]
        sides = [math.dist(a[:2], b[:2]) for a, b in pairwise(corners)]
        assert sides == pytest.approx([2.0] * 4, abs=2e-3)
        properties = feature["properties"]
        total += properties["values"]
        low, high = min(it.cmv for it in valid), max(it.cmv for it in valid)
        assert low <= properties["cmv_mean"] <= high
        # Some fix of the run lies in the cell or next to it.
        middle = (properties["east_m"], properties["north_m"])
        nearest = min(math.dist(middle, offset_of(fixes[0], fix)[:2]) for fix in fixes)
        assert nearest < 2.0
    # All values lie on the lane, but for those before the first fix and after the last.
    assert 0.9 * len(valid) <= total <= len(valid)
    table = pandas.read_csv(export(trace, "map.csv", "--table", "map", "--cell-m", "2"))
    assert table["values"].sum() == total


def test_offset_is_the_inverse_of_place() -> None:
    origin = Geodetic(59.3, 18.1, 30.0)
    for offset in ((0.0, 0.0, 0.0), (120.0, -45.0, 2.5), (-3000.0, 800.0, -4.0)):
        assert offset_of(origin, place_of(origin, *offset)) == pytest.approx(offset, abs=1e-5)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["out.xlsx"], "the ending '.xlsx' is unknown; there are .csv"),
        (["out.wav", "--table", "meters"], ".wav cannot hold the table meters"),
        (["out.csv", "--table", "samples", "--topic", "/nobody"], "on /nobody"),
        (["missing/out.mat"], "cannot be written: No such file"),
    ],
)
def test_what_cannot_be_is_said_in_a_line(
    trace: Path, arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    name, *more = arguments
    folder = trace.with_name("refused")
    folder.mkdir(exist_ok=True)
    path = folder / name
    assert commands.main(["export", str(trace), str(path), *more]) == 1
    error = capsys.readouterr().err
    assert said in error
    assert error.count("\n") == 1
    assert list(folder.iterdir()) == []


def test_a_damaged_trace_is_written_as_far_as_it_goes(
    trace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    data = trace.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data[: len(data) // 2])
    path = tmp_path / "cut.parquet"
    assert commands.main(["export", str(cut), str(path)]) == 1
    assert "roller-sim recover" in capsys.readouterr().err
    assert 0 < len(pandas.read_parquet(path)) < 128 * FREQUENCY_HZ * 8
