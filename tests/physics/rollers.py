# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Runs of the bare kernels for the physics tests: no session, no messages."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS, Ground
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.meters import Summary, summarise
from roller_sim_ros.parameters import Exciter, HalfSpace, Machine, Soil

MACHINE = Machine()
KEPT_REVOLUTIONS = 64


@dataclass(frozen=True)
class Point:
    """Exciter and soil of one run, SI."""

    frequency_hz: float
    amplitude_m: float
    shear_modulus_pa: float
    plastic_parameter_m: float

    @property
    def soil(self) -> Soil:
        return Soil(
            shear_modulus_pa=self.shear_modulus_pa, plastic_parameter_m=self.plastic_parameter_m
        )

    @property
    def exciter(self) -> Exciter:
        return Exciter(frequency_hz=self.frequency_hz, amplitude_m=self.amplitude_m)


@dataclass(frozen=True)
class Run:
    """The last revolutions of a run, and the ground after it."""

    samples: NDArray[np.float64]
    per_revolution: int
    ground: Ground
    state_before: NDArray[np.float64]

    def summary(self) -> Summary:
        return summarise(
            self.samples[at.OUT_VERTICAL],
            self.samples[at.OUT_FORCE],
            self.samples[at.OUT_PHASE].astype(np.uint8),
            MACHINE.static_load_n,
            self.per_revolution,
        )


def settled(
    point: Point,
    half_space: HalfSpace,
    *,
    per_revolution: int = 128,
    revolutions: int = 1000,
    kept: int = KEPT_REVOLUTIONS,
) -> Run:
    """Run from static equilibrium with the exciter at once at full frequency and amplitude."""
    drive = ExciterDrive(
        point.exciter, min(10.0, point.frequency_hz), run_up=False, samples=per_revolution
    )
    ground = GROUNDS[half_space.model](
        MACHINE, point.soil, half_space, point.exciter, per_revolution
    )
    parts = []
    state_before = ground.state.copy()
    for revolution in range(revolutions):
        ground.begin(drive.next_revolution(), point.soil)
        if revolution == revolutions - kept:
            state_before = ground.state.copy()
        out = ground.advance(0, per_revolution)
        if revolution >= revolutions - kept:
            parts.append(out)
    return Run(np.concatenate(parts, axis=1), per_revolution, ground, state_before)


def random_points(count: int, seed: int) -> list[Point]:
    """Return points inside the paper's ranges: 15…40 Hz, 0.1…2.5 mm, G 15…120 MPa, p about its power law."""
    draw = np.random.default_rng(seed)
    points = []
    for _ in range(count):
        shear_modulus = draw.uniform(15e6, 120e6)
        plastic = 0.8e-3 * (shear_modulus / 35e6) ** -0.5686 * draw.uniform(0.7, 1.4)
        points.append(
            Point(draw.uniform(15.0, 40.0), draw.uniform(1e-4, 2.5e-3), shear_modulus, plastic)
        )
    return points
