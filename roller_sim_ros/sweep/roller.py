# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""One roller of a sweep, going from point to point."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.exciter import ExciterDrive, Revolution
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep.records import Records
from roller_sim_ros.sweep.settling import Run

Array = NDArray[np.float64]


class Roller:
    """A drum on its ground, for one point after another.

    Its samples are those of a `roller_sim_ros.session.Session` with the same parameters; from the second point on, of
    one that goes on with commands and changes to the next point's.

    Parameters
    ----------
    configuration : Configuration
        The first point.
    """

    def __init__(self, configuration: Configuration) -> None:
        self._samples = configuration.sampling.samples_per_revolution
        self._floor_hz = configuration.sampling.floor_hz
        self._configuration = configuration
        self._drive = ExciterDrive(
            configuration.exciter, self._floor_hz, run_up=False, samples=self._samples
        )
        self._ground = GROUNDS[configuration.half_space.model](
            configuration.machine,
            configuration.soil,
            configuration.half_space,
            configuration.exciter,
            self._samples,
        )

    def go_to(self, configuration: Configuration) -> None:
        """Command another point; the roller goes there from where it is, as fast as its exciter follows."""
        exciter = configuration.exciter
        self._drive.target_frequency_hz = exciter.frequency_hz if exciter.vibrate else 0.0
        self._drive.target_amplitude_m = exciter.amplitude_m
        self._configuration = configuration

    def approach(self, place: int, before: int, records: Records) -> Run | None:
        """Step over revolutions until all that follow are alike.

        Parameters
        ----------
        place : int
            Number of the point in the records.
        before : int
            Revolutions before those that are to be recorded.
        records : Records
            Told of the revolutions that were stepped over.

        Returns
        -------
        Run or None
            What is left to be stepped, begun; None when nothing is left and the revolutions still differ.
        """
        for done in range(before + 1):
            if self._is_steady():
                self._begin()
                records.computed[place] = done
                return Run(place, self._ground.kernel_arguments, self._scales(), before - done)
            if done < before:
                self._begin()
                self._ground.advance(0, self._samples)
        records.computed[place] = before
        return None

    def record(self, place: int, records: Records) -> None:
        """Step over the revolutions that are recorded, each of which may be another."""
        frequencies = set()
        whole = True
        kept = records.samples.shape[1]
        for number in range(kept):
            revolution = self._begin()
            records.keep(place, number, self._ground.advance(0, self._samples))
            frequencies.add(revolution.frequency_hz)
            whole = whole and revolution.phase_increment_rad == 2.0 * math.pi / self._samples
        records.recorded[place] = kept
        records.computed[place] += kept
        records.synchronous[place] = whole and len(frequencies) == 1

    def _begin(self) -> Revolution:
        revolution = self._drive.next_revolution()
        self._ground.begin(revolution, self._configuration.soil)
        return revolution

    def _is_steady(self) -> bool:
        """Whether the next revolution and all after it are alike, from phase zero to phase zero."""
        drive = self._drive
        return (
            drive.frequency_hz == drive.target_frequency_hz >= self._floor_hz
            and drive.amplitude_m == drive.target_amplitude_m
        )

    def _scales(self) -> Array:
        """Return the sizes of the state's values, from the static deflection and the exciter."""
        configuration = self._configuration
        load = configuration.machine.static_load_n
        depth = self._ground.strip.static_compliance * load
        depth += configuration.soil.plastic_parameter_m
        omega = 2.0 * math.pi * configuration.exciter.frequency_hz
        scales = np.zeros(at.STATE_SIZE)
        scales[[at.DEPTH, at.SURFACE, at.PLASTIC]] = depth
        scales[[at.VELOCITY, at.SURFACE_VELOCITY]] = omega * (
            depth + configuration.exciter.amplitude_m
        )
        scales[at.FORCE] = load
        return scales
