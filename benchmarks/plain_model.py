# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's roller on its two-pole half space as plain differential equations, for scipy's `solve_ivp`.

The phases of Figure 13 each with their own equations, events between them, the soil renewed at the drum's apex.
Shares no code with the package: a second opinion on its model, and what one would write without it. Depths are
positive down.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Event = Callable[[float, Array], float]
Method = Literal["RK45", "DOP853", "LSODA"]

GRAVITY = 9.81
FRAME_MASS = 2400.0
DRUM_MASS = 3200.0
DRUM_RADIUS = 0.75
DRUM_WIDTH = 2.1
DENSITY = 2000.0
POISSON_RATIO = 0.25
AREA_FACTOR = 4.0
QUALITY = 0.4
FREQUENCY_FACTOR = 2.75

LOADING, UNLOADING, AIR = 0, 1, 2

JUST_TURNED = 1e-15
"""m/s: the velocity after an apex, so that the same apex is not found again."""


@dataclass(frozen=True)
class Samples:
    """What a sensor would see, sampled like the package's blocks.

    Attributes
    ----------
    acceleration : ndarray
        Vertical acceleration of the drum, m/s², z up.
    force : ndarray
        Soil force, N.
    phase : ndarray
        Contact state.
    """

    acceleration: Array
    force: Array
    phase: NDArray[np.uint8]


class PlainRoller:
    """Starts in static equilibrium, the exciter at once at its full frequency and amplitude.

    Parameters
    ----------
    shear_modulus, plastic, frequency, amplitude : float
        G in Pa, p in m, f in Hz, A in m.
    """

    def __init__(
        self, shear_modulus: float, plastic: float, frequency: float, amplitude: float
    ) -> None:
        half_width = AREA_FACTOR * math.sqrt(2.0 * DRUM_RADIUS * plastic)
        half_length = 0.5 * DRUM_WIDTH
        alpha = half_length / half_width
        influence = (
            2.0 / 3.0 * math.asinh(alpha)
            + (alpha + alpha**3 / 6.0) * math.asinh(1.0 / alpha)
            - alpha / 6.0 * math.sqrt(1.0 + alpha**2)
        )
        self.compliance = (
            3.0
            * influence
            / (4.0 * math.pi * alpha)
            * (1.0 - POISSON_RATIO)
            / (shear_modulus * half_width)
        )
        natural = (
            FREQUENCY_FACTOR
            * math.sqrt(shear_modulus / DENSITY)
            / math.sqrt(half_width * half_length)
        )
        self.stiffness = natural**2
        self.damping = natural / QUALITY
        self.load = (FRAME_MASS + DRUM_MASS) * GRAVITY
        self.plastic = plastic / self.load
        self.period = 1.0 / frequency
        self.omega = 2.0 * math.pi * frequency
        self.thrust = amplitude * self.omega**2

        self.time = 0.0
        self.phase = UNLOADING
        surface = self.compliance * self.load
        self.q = plastic
        self.datum = 0.0
        self.force_at_start = self.load
        self.rest = self.q
        self.y = np.array([surface + plastic, 0.0, surface, 0.0])

    def force(self, t: float, y: Array) -> float:
        """F_s in the present phase."""
        if self.phase == AIR:
            return 0.0
        if self.phase == LOADING:
            # d = e + q + D, and q grows by p F/F_stat.
            return float(self.force_at_start + (y[0] - y[2] - self.rest) / self.plastic)
        # Drum and surface accelerate alike.
        pull = self.load / DRUM_MASS - self.thrust * math.sin(self.omega * t)
        pull += self.stiffness * y[2] + self.damping * y[3]
        return float(pull / (self.stiffness * self.compliance + 1.0 / DRUM_MASS))

    def rates(self, t: float, y: Array) -> list[float]:
        """d', d'', e', e''."""
        force = self.force(t, y)
        drum = (self.load - force) / DRUM_MASS - self.thrust * math.sin(self.omega * t)
        if self.phase == UNLOADING:
            return [y[1], drum, y[3], drum]
        surface = self.stiffness * (self.compliance * force - y[2]) - self.damping * y[3]
        return [y[1], drum, y[3], surface]

    def force_rate(self, t: float, y: Array) -> float:
        """F_s' in unloading."""
        force = self.force(t, y)
        drum = (self.load - force) / DRUM_MASS - self.thrust * math.sin(self.omega * t)
        pull = -self.thrust * self.omega * math.cos(self.omega * t)
        pull += self.stiffness * y[3] + self.damping * drum
        return float(pull / (self.stiffness * self.compliance + 1.0 / DRUM_MASS))

    def events(self) -> list[Event]:
        """What ends the present phase, and the apex, last; all fall through zero."""

        def apex(_: float, y: Array) -> float:
            return float(-y[1])

        def loading_ends(_: float, y: Array) -> float:
            return float(y[1] - y[3])

        def lift_off(t: float, y: Array) -> float:
            return self.force(t, y)

        def reloading(t: float, y: Array) -> float:
            return -self.force_rate(t, y)

        def contact(_: float, y: Array) -> float:
            return float(y[2] + self.q + self.datum - y[0])

        events: dict[int, list[Event]] = {
            LOADING: [loading_ends],
            UNLOADING: [lift_off, reloading],
            AIR: [contact],
        }
        chosen = [*events[self.phase], apex]
        for event in chosen:
            event.terminal = True  # type: ignore[attr-defined]
            event.direction = -1.0  # type: ignore[attr-defined]
        return chosen

    def pass_event(self, index: int, force: float) -> None:
        """Go on in the phase that follows an event; `force` is that before it."""
        if self.phase == LOADING:
            # Also at an apex: what has yielded so far.
            self.q += self.plastic * (force - self.force_at_start)
        if index == len(self.events()) - 1:
            fresh = self.plastic * force
            gap = self.y[0] - self.y[2]
            self.datum = max(self.datum, gap - fresh)
            self.q = fresh if self.phase == AIR else gap - self.datum
            self.y[1] = JUST_TURNED
            if self.phase == UNLOADING:
                self.y[3] = JUST_TURNED
        elif self.phase == LOADING:
            self.phase = UNLOADING
            if self.force_rate(self.time, self.y) > 0.0:
                force = self.force(self.time, self.y)
                self.phase = LOADING
        elif self.phase == UNLOADING:
            self.phase = AIR if index == 0 else LOADING
        else:
            self.phase = LOADING
            force = 0.0
        self.force_at_start = force
        self.rest = self.q + self.datum

    def run(
        self,
        revolutions: int,
        *,
        samples_per_revolution: int = 128,
        method: Method = "RK45",
        rtol: float = 1e-6,
        max_step: float = math.inf,
    ) -> Samples:
        """Go on for some revolutions.

        Parameters
        ----------
        revolutions, samples_per_revolution : int
            How long, and how densely sampled.
        method, rtol, max_step
            As of `solve_ivp`; the absolute tolerances are rtol times 1 mm and 0.1 m/s.
        """
        h = self.period / samples_per_revolution
        first = round(self.time / h)
        times = h * np.arange(first, first + revolutions * samples_per_revolution + 1)
        count = len(times) - 1
        acceleration, forces = np.empty(count), np.empty(count)
        phases = np.empty(count, dtype=np.uint8)
        done = 0
        while done < count:
            until = min(done + samples_per_revolution, count)
            found = solve_ivp(
                self.rates,
                (self.time, times[until]),
                self.y,
                method=method,
                t_eval=times[done : until + 1],
                events=self.events(),
                rtol=rtol,
                atol=rtol * np.array([1e-3, 0.1, 1e-3, 0.1]),
                max_step=max_step,
            )
            if found.status < 0:
                raise RuntimeError(found.message)
            for t, y in zip(found.t[: until - done], np.transpose(found.y), strict=False):
                force = self.force(t, y)
                forces[done] = force
                acceleration[done] = self.thrust * math.sin(self.omega * t)
                acceleration[done] += (force - self.load) / DRUM_MASS
                phases[done] = self.phase
                done += 1
            if found.t_events and found.y_events and found.status == 1:
                index = next(n for n, t in enumerate(found.t_events) if t.size)
                self.time = float(found.t_events[index][0])
                self.y = np.array(found.y_events[index][0])
                self.pass_event(index, self.force(self.time, self.y))
            else:
                self.time = float(times[until])
                self.y = np.array(found.y[:, -1])
                # The next stretch starts anew in the same phase.
                force = self.force(self.time, self.y)
                if self.phase == LOADING:
                    self.q += self.plastic * (force - self.force_at_start)
                    self.force_at_start, self.rest = force, self.q + self.datum
        return Samples(acceleration, forces, phases)
