# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What of a window is a motion, what is noise, and why there may be no waveform."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from roller_sim_ros.estimate import EstimateError, Status
from roller_sim_ros.estimate.waveform import is_clipped, waveform
from roller_sim_ros.half_space.point_load import FloatArray

N = 128
ROWS = 16


def motion(order_half: float = 0.0, rows: int = ROWS) -> FloatArray:
    """A blow a revolution, and a share of a subharmonic."""
    turns = np.arange(rows * N) / N
    wave = 40.0 * np.sin(2 * np.pi * turns) + 20.0 * np.exp(np.cos(2 * np.pi * turns) * 3.0 - 3.0)
    return np.asarray((wave + order_half * np.sin(np.pi * turns)).reshape(rows, N))


def test_period_one_and_its_mean_do_not_matter() -> None:
    found = waveform(motion() + 9.81)
    assert found.status is Status.OK
    assert found.period == 1
    assert found.vertical.shape == (N,)
    np.testing.assert_allclose(found.vertical, motion()[0] - motion().mean(), atol=1e-9)
    assert found.noise < 1e-9


def test_a_subharmonic_doubles_the_period() -> None:
    found = waveform(motion(order_half=4.0))
    assert found.period == 2
    assert found.vertical.shape == (2 * N,)


def test_noise_is_averaged_and_measured() -> None:
    draw = np.random.default_rng(1)
    found = waveform(motion() + 2.0 * draw.standard_normal((ROWS, N)))
    assert found.status is Status.OK
    assert found.period == 1
    # 16 revolutions leave a quarter; the estimate from 15 × 128 differences is good to 5 %.
    assert found.noise == pytest.approx(0.5, rel=0.1)


def test_noise_behind_a_low_pass_is_no_chaos() -> None:
    draw = np.random.default_rng(2)
    noise = draw.standard_normal(ROWS * N)
    orders = np.arange(ROWS * N // 2 + 1) / ROWS
    noise = np.fft.irfft(np.fft.rfft(noise) / (1.0 + (orders / 30.0) ** 4), ROWS * N)
    found = waveform(motion() + 5.0 * noise.reshape(ROWS, N))
    assert found.status is Status.OK


def test_motion_that_does_not_repeat_is_chaotic() -> None:
    draw = np.random.default_rng(3)
    rows = motion()
    rows = rows * draw.uniform(0.7, 1.3, (ROWS, 1))
    assert waveform(rows).status is Status.CHAOTIC
    assert waveform(rows + draw.standard_normal(rows.shape)).status is Status.CHAOTIC


@pytest.mark.parametrize(
    "growth", [np.linspace(0.7, 1.3, ROWS), 1.0 + 0.5 * 0.7 ** np.arange(ROWS)]
)
def test_drifting_and_decaying_motions_are_unsettled(growth: FloatArray) -> None:
    assert waveform(motion() * growth[:, np.newaxis]).status is Status.UNSETTLED


def clipped(rows: FloatArray) -> FloatArray:
    return np.asarray(np.clip(rows, -30.0, 30.0))


def with_nan(rows: FloatArray) -> FloatArray:
    rows[3, 5] = np.nan
    return rows


@pytest.mark.parametrize(
    ("change", "status"),
    [
        (clipped, Status.CLIPPED),
        (with_nan, Status.MISSING),
        (lambda rows: rows[:3], Status.TOO_FEW),
        (lambda rows: 1e-4 * rows, Status.STANDING),
        (np.zeros_like, Status.STANDING),
    ],
)
def test_why_there_is_none(change: Callable[[FloatArray], FloatArray], status: Status) -> None:
    found = waveform(change(motion()))
    assert found.status is status
    assert not len(found.vertical)


@pytest.mark.parametrize("shape", [(128,), (16, 32), (2, 16, 128), (0,)])
def test_other_shapes_are_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(EstimateError, match=r"revolutions, samples per revolution"):
        waveform(np.zeros(shape))


def test_a_coarse_converter_does_not_clip() -> None:
    turns = np.arange(ROWS * N) / N
    wave = 40.0 * np.sin(2 * np.pi * turns)
    for step in (0.01, 0.05, 0.24):
        assert not is_clipped(np.round(wave / step) * step)
        held: NDArray[np.float64] = np.round(np.clip(wave, -35.0, 100.0) / step) * step
        assert is_clipped(held)


def test_every_status_says_what_it_means() -> None:
    assert len({status.label for status in Status}) == len(Status)
    assert all(len(status.meaning) > 20 for status in Status if status is not Status.OK)
    assert [status for status in Status if status.stands] == [Status.OK, Status.PLASTIC_UNCERTAIN]
