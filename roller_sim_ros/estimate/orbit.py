# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The steady motion of the model on one ground after another, by the kernels, each from the last one's state."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS, Ground
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.estimate.frozen_fit import FrozenFitGround
from roller_sim_ros.estimate.surfaces import on
from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.parameters import PARAMETERS, Configuration, Soil
from roller_sim_ros.sweep.records import VERTICAL, Records
from roller_sim_ros.sweep.settling import Run, settle

Array = NDArray[np.float64]

FIRST_REVOLUTIONS = 160
"""Before the first motion is looked at."""

REVOLUTIONS = 16
"""Before each further look; a multiple of every period."""

MOST_REVOLUTIONS = 320
"""For one ground; a motion that has not come to repeat by then is taken as it is."""

AMPLITUDE_RATE = 2e-3
"""From the amplitude at the start to the known one, m/s."""

REPEATS = 1e-6
"""Share of the peak to which a motion has to repeat."""


class Orbit:
    """Drum on the ground of the model, on which the ground can be changed.

    Parameters
    ----------
    known : Configuration
        Machine, exciter, half space, density, Poisson's ratio.
    logs : ndarray, shape (2,)
        ln G and ln p of the first ground.
    period : int
        Revolutions of the motion that is looked for.
    samples : int
        Samples per revolution.
    start_factor : float
        Amplitude at the start, from rest, over the known one, to which the exciter then goes. Which of several motions
        the drum settles on depends on it.
    """

    def __init__(
        self,
        known: Configuration,
        logs: Array,
        period: int,
        samples: int,
        start_factor: float = 1.0,
    ) -> None:
        self._known = known
        self._period = period
        most = PARAMETERS["exciter.amplitude_m"][0].maximum or 0.0
        start = min(start_factor * known.exciter.amplitude_m, most)
        self._drive = ExciterDrive(
            replace(
                known.exciter,
                vibrate=True,
                amplitude_m=start,
                amplitude_rate_m_per_s=AMPLITUDE_RATE,
            ),
            min(known.sampling.floor_hz, known.exciter.frequency_hz),
            run_up=False,
            samples=samples,
        )
        self._drive.target_amplitude_m = known.exciter.amplitude_m
        self._samples = samples
        self._fresh = True
        first = on(known, *np.exp(logs))
        self._ground = self._made(first)
        self._run_in(first.soil)

    def _made(self, first: Configuration) -> Ground:
        arguments: tuple[Any, ...] = (
            first.machine,
            first.soil,
            first.half_space,
            first.exciter,
            self._samples,
        )
        if first.half_space.model == "rational":
            return FrozenFitGround(*arguments)
        return GROUNDS[first.half_space.model](*arguments)

    def _run_in(self, soil: Soil) -> None:
        """Go to the known amplitude."""
        drive = self._drive
        revolutions = 0
        while drive.amplitude_m != drive.target_amplitude_m or revolutions % REVOLUTIONS:
            self._ground.begin(drive.next_revolution(), soil)
            self._ground.advance(0, self._samples)
            revolutions += 1

    def vertical(self, logs: Array) -> Array:
        """Return the motion on a ground, one period of vertical acceleration without its mean.

        Parameters
        ----------
        logs : ndarray, shape (2,)
            ln G and ln p.

        Returns
        -------
        ndarray, shape (period × samples,)
            m/s².
        """
        soil = on(self._known, *np.exp(logs)).soil
        self._ground.begin(self._drive.next_revolution(), soil)
        kept = 2 * self._period
        looked_at = -(-kept // REVOLUTIONS) * REVOLUTIONS
        before = FIRST_REVOLUTIONS if self._fresh else looked_at
        self._fresh = False
        done = 0
        while True:
            records = Records(1, looked_at, self._samples)
            run = Run(0, self._ground.kernel_arguments, np.zeros(at.STATE_SIZE), before)
            settle(self._known.half_space.model, [run], False, records)
            done += before + looked_at
            rows = records.samples[0, -kept:, VERTICAL].reshape(2, -1)
            change = float(np.abs(rows[1] - rows[0]).max())
            if change <= REPEATS * float(np.abs(rows[1]).max()) or done >= MOST_REVOLUTIONS:
                return np.asarray(rows[1] - rows[1].mean())
            before = 0
