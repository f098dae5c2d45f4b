# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A drum on paper: waveforms whose flights, period and harmonics are known by construction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

N = 128
AIR = 2


@dataclass(frozen=True)
class Waveform:
    """Vertical acceleration (m/s²), soil force over drum mass (m/s²) and contact state, `count` per revolution."""

    vertical: NDArray[np.float64]
    force: NDArray[np.float64]
    state: NDArray[np.uint8]


def bouncing(
    revolutions: int,
    period: int,
    air: float,
    exciter: float = 50.0,
    weight: float = 17.17,
    count: int = N,
) -> Waveform:
    """A drum that takes one blow in `period` revolutions and flies for the share `air` of them.

    In the air a = exciter sin φ − weight; the blow is a sine² that carries the weight over the period.
    """
    samples = period * count
    contact = round((1.0 - air) * samples)
    shape = np.sin(np.pi * (np.arange(contact) + 0.5) / contact) ** 2
    force = np.zeros(samples)
    force[:contact] = shape * (weight * samples / shape.sum())
    force = np.tile(np.roll(force, count // 4), revolutions // period)
    phase = 2.0 * np.pi * np.arange(revolutions * count) / count
    state = np.where(force > 0.0, 0, AIR).astype(np.uint8)
    return Waveform(exciter * np.sin(phase) + force - weight, force, state)


@pytest.fixture(scope="session")
def drum() -> Callable[..., Waveform]:
    return bouncing
