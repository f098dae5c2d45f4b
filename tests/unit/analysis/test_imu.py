# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Rate and frequency of an Imu stream: exact, or an honest error."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.imu import ImuRate, ImuReader, find_rate
from roller_sim_ros.analysis.samples import Piece


def stream(
    rate_hz: float, excitation_hz: float, count: int = 8192, jitter: float = 0.0
) -> tuple[list[int], list[float]]:
    """Stamps and specific force of a drum in double jump."""
    rng = np.random.default_rng(1)
    time_s = np.arange(count) / rate_hz
    phase = 2.0 * np.pi * excitation_hz * time_s + 0.7
    stamps = 10**18 + np.rint((time_s + jitter * rng.normal(size=count) / rate_hz) * 1e9)
    vertical = 50.0 * np.sin(phase) + 28.0 * np.sin(0.5 * phase) + 11.0 * np.sin(2 * phase) + 9.81
    return [int(stamp) for stamp in stamps], list(vertical)


@pytest.mark.parametrize(("excitation", "per_revolution"), [(28.0, 128), (36.25, 128), (33.0, 32)])
@pytest.mark.parametrize("given", [False, True])
def test_whole_samples_per_revolution_are_found(
    excitation: float, per_revolution: int, given: bool
) -> None:
    stamps, vertical = stream(excitation * per_revolution, excitation)
    rate = find_rate(stamps, vertical, excitation if given else None)
    assert rate.samples_per_revolution == per_revolution
    assert rate.excitation_hz == pytest.approx(excitation, rel=1e-7)
    assert rate.sample_period_s == pytest.approx(1.0 / (excitation * per_revolution), rel=1e-7)


def test_small_jitter_and_lost_samples_are_borne() -> None:
    stamps, vertical = stream(3584.0, 28.0, jitter=0.02)
    del stamps[1000:1003], vertical[1000:1003]
    rate = find_rate(stamps, vertical)
    assert rate.samples_per_revolution == 128
    assert rate.excitation_hz == pytest.approx(28.0, rel=1e-5)


@pytest.mark.parametrize(
    ("rate_hz", "excitation", "given", "words"),
    [
        (3600.0, 28.0, None, r"128\.571 samples per revolution at 28\.000 Hz"),
        (3600.0, 28.0, 28.0, r"128\.571 samples per revolution"),
        (3584.0, 28.1, None, "samples per revolution at 28.100 Hz"),
        (3584.0, 28.1, 28.0, "excitation is at 28.100 Hz, not at the 28.000 Hz"),
        (280.0, 28.0, None, "whole number of at least 16"),
        (50.0, 28.0, 28.0, "too low for an excitation"),
    ],
)
def test_other_rates_are_refused(
    rate_hz: float, excitation: float, given: float | None, words: str
) -> None:
    stamps, vertical = stream(rate_hz, excitation)
    with pytest.raises(BagError, match=words):
        find_rate(stamps, vertical, given)


def test_streams_that_cannot_be_judged_are_refused() -> None:
    stamps, vertical = stream(3584.0, 28.0)
    with pytest.raises(BagError, match="too few"):
        find_rate(stamps[:511], vertical[:511])
    with pytest.raises(BagError, match="does not vibrate"):
        find_rate(stamps, [9.81] * len(stamps))
    with pytest.raises(BagError, match="do not advance"):
        find_rate([stamps[0]] * 1000, vertical[:1000])
    jittered, _ = stream(3584.0, 28.0, jitter=0.2)
    with pytest.raises(BagError, match="not equidistant"):
        find_rate(jittered, vertical)
    holes = [stamp for index, stamp in enumerate(stamps) if index % 100]
    with pytest.raises(BagError, match="in a row"):
        find_rate(holes, vertical[: len(holes)])


def message(stamp: int, vertical: float) -> Any:
    return SimpleNamespace(
        header=SimpleNamespace(stamp=SimpleNamespace(sec=stamp // 10**9, nanosec=stamp % 10**9)),
        linear_acceleration=SimpleNamespace(x=1.5, z=vertical),
    )


def read(stamps: list[int], rate: ImuRate) -> list[Piece]:
    reader = ImuReader(rate)
    pieces = [
        piece
        for index, stamp in enumerate(stamps)
        for piece in reader.read(message(stamp, float(index)))
    ]
    return pieces + list(reader.flush())


RATE = ImuRate(1.0 / 3584.0, 28.0, 128)


def test_pieces_are_revolutions() -> None:
    stamps, _ = stream(3584.0, 28.0, 300)
    pieces = read(stamps, RATE)
    assert [(piece.first_sample, len(piece)) for piece in pieces] == [
        (0, 128),
        (128, 128),
        (256, 44),
    ]
    assert [piece.phase_rad for piece in pieces] == [0.0, 0.0, 0.0]
    assert pieces[1].stamp_ns == stamps[128]
    assert pieces[1].vertical.tolist() == list(range(128, 256))
    assert pieces[1].specific_force


def test_lost_repeated_and_late_samples_keep_their_index() -> None:
    stamps, _ = stream(3584.0, 28.0, 400)
    received = stamps[:100] + stamps[103:120] + [stamps[119]] + stamps[121:125] + [stamps[120]]
    pieces = read(received + stamps[125:], RATE)
    seen = [range(piece.first_sample, piece.first_sample + len(piece)) for piece in pieces]
    samples = [index for indices in seen for index in indices]
    assert samples == [*range(100), *range(103, 120), 119, *range(121, 125), 120, *range(125, 400)]


def test_a_change_of_the_rate_is_refused_also_a_slow_one() -> None:
    stamps, _ = stream(3584.0, 28.0, 4096)
    later, _ = stream(3584.0 * 1.5, 42.0, 4096)
    with pytest.raises(BagError, match=r"from 0\.279018 to 0\.186012 ms after 4096 samples"):
        read(stamps + [stamps[-1] + 186012 + stamp - later[0] for stamp in later], RATE)
    slow = [int(10**18 + index * (279017.857 + index * 0.05)) for index in range(8192)]
    with pytest.raises(BagError, match="does not stay constant"):
        read(slow, RATE)
