"""One roller of a sweep: from point to point, over its revolutions, down to the settled ones."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import GROUNDS
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.exciter import ExciterDrive, Revolution
from roller_sim_ros.meters import SUMMARY_REVOLUTIONS
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.sweep.settling import LOOPS, watch

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Settled:
    """What a roller's last revolutions at a point were.

    Attributes
    ----------
    samples : ndarray, shape (revolutions, OUT_ROWS, samples)
        The last revolutions, rows as in `roller_sim_ros.drum_soil.state`.
    synchronous : bool
        Whether every revolution of samples is one of the eccentric, all at one frequency.
    computed : int
        Revolutions that were stepped over; fewer than the run has where its motion repeats to rounding.
    """

    samples: Array
    synchronous: bool
    computed: int


class Roller:
    """A drum on its ground, for one point after another.

    The samples are those of a `roller_sim_ros.session.Session` with the same parameters; from the second point
    on, of one that goes on with commands and changes to the next point's.

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

    def settle(self, revolutions: int, *, early_stop: bool) -> Settled:
        """Step over some revolutions and return the last of them, an even number up to 64.

        Parameters
        ----------
        revolutions : int
            How many; at least 2.
        early_stop : bool
            Stop where the motion repeats to rounding.
        """
        kept = min(SUMMARY_REVOLUTIONS, revolutions - revolutions % 2)
        before = revolutions - kept
        done = 0
        steady = False
        while done < before and not steady:
            steady = self._begin()
            if not steady:
                self._ground.advance(0, self._samples)
                done += 1
        if steady:
            return self._repeat(before - done, kept, done, early_stop=early_stop)
        return self._step(kept, done)

    def _begin(self) -> bool:
        """Begin the next revolution; return whether all that follow are like it."""
        revolution = self._drive.next_revolution()
        self._ground.begin(revolution, self._configuration.soil)
        return self._is_steady(revolution)

    def _is_steady(self, revolution: Revolution) -> bool:
        return (
            revolution.frequency_hz == self._drive.target_frequency_hz >= self._floor_hz
            and revolution.amplitude_m == self._drive.target_amplitude_m
            and revolution.start_acceleration == revolution.end_acceleration
            and revolution.phase_rad == 0.0
        )

    def _repeat(self, before: int, kept: int, done: int, *, early_stop: bool) -> Settled:
        """Step over revolutions that are all alike, without coming back to Python."""
        loop = LOOPS[self._configuration.half_space.model]
        arguments = self._ground.kernel_arguments
        watched = watch(self._scales())
        samples = np.empty((kept, at.OUT_ROWS, self._samples))
        ran, period = loop(before, early_stop, watched, arguments, samples[:1])
        done += ran
        if period:
            loop(period, False, watched, arguments, samples[:period])
            for first in range(period, kept, period):
                samples[first : first + period] = samples[:period]
            return Settled(samples, True, done + period)
        loop(kept, False, watched, arguments, samples)
        return Settled(samples, True, done + kept)

    def _step(self, kept: int, done: int) -> Settled:
        """Step over revolutions that may differ."""
        samples = np.empty((kept, at.OUT_ROWS, self._samples))
        frequencies = set()
        whole = True
        for row in samples:
            revolution = self._drive.next_revolution()
            self._ground.begin(revolution, self._configuration.soil)
            row[:] = self._ground.advance(0, self._samples)
            frequencies.add(revolution.frequency_hz)
            whole = whole and revolution.phase_increment_rad == 2.0 * math.pi / self._samples
        return Settled(samples, whole and len(frequencies) == 1, done + kept)

    def _scales(self) -> Array:
        """Return the sizes of the state's values, from the static deflection and the exciter."""
        machine, exciter = self._configuration.machine, self._configuration.exciter
        load = machine.static_load_n
        depth = self._ground.strip.static_compliance * load
        depth += self._configuration.soil.plastic_parameter_m
        omega = 2.0 * math.pi * self._drive.frequency_hz
        scales = np.zeros(at.STATE_SIZE)
        scales[[at.DEPTH, at.SURFACE, at.PLASTIC]] = depth
        scales[[at.VELOCITY, at.SURFACE_VELOCITY]] = omega * (depth + exciter.amplitude_m)
        scales[at.FORCE] = load
        return scales
