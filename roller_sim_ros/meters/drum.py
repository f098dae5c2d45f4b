# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a meter that knows its machine makes of the drum's acceleration: the soil's force and the drum's travel.

The drum's equation of motion (eq. 11) solved for the soil's force,

    F_s = m_d (z'' − mean) − F sin φ + F_stat,

needs the vertical acceleration, the eccentric's phase φ, the masses and the amplitude F of the exciter's vertical
force, m_e r_e ω² for a circular exciter. That is what a real meter has: an accelerometer, one pulse a
revolution, and the machine it is mounted on. The travel is the acceleration integrated twice, order by order,
over a window of whole revolutions: z_k = −a_k/ω_k². The window is taken to repeat.

Two things stay unknown. The mean acceleration, which is a bias, or gravity where the sensor reads specific
force: a drum that goes nowhere has none, so it is taken away. And the mean velocity: a drum that sinks steadily
into soft ground looks like one that does not, and its weight's work is not seen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from roller_sim_ros.exciter import DIRECTIONS
from roller_sim_ros.meters import kernels
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Exciter, Machine

Number = float | NDArray[np.float64]
"""One number, or one for each of several motions."""


@dataclass(frozen=True)
class Drum:
    """What is known of the machine; arrays of the motions' leading shape where they differ.

    Attributes
    ----------
    mass_kg : float or ndarray
        m_d.
    static_load_n : float or ndarray
        F_stat, on the ground at rest.
    radius_m, width_m : float or ndarray
        r and W.
    vertical_share : float or ndarray
        Of the exciter's force: 1 for a circular exciter, the cosine of its tilt for a directed one.
    """

    mass_kg: Number
    static_load_n: Number
    radius_m: Number
    width_m: Number
    vertical_share: Number = 1.0

    @classmethod
    def of(cls, machine: Machine, exciter: Exciter) -> Drum:
        """Return the facts of a machine with its exciter."""
        return cls(
            mass_kg=machine.drum_mass_kg,
            static_load_n=machine.static_load_n,
            radius_m=machine.drum_radius_m,
            width_m=machine.drum_width_m,
            vertical_share=DIRECTIONS[exciter.kind](exciter.tilt_rad).vertical_sine,
        )


@dataclass(frozen=True)
class DrumMotion:
    """Vertical motions over a window of whole revolutions at one frequency and amplitude.

    Attributes
    ----------
    vertical : ndarray, shape (..., revolutions × samples_per_revolution)
        Acceleration, m/s², up positive; coordinate acceleration or specific force.
    drum : Drum
        The machine.
    amplitude_m : float or ndarray, shape (...)
        Nominal amplitude A = m_e r_e / m_d.
    frequency_hz : float or ndarray, shape (...)
        Excitation frequency.
    phase_rad : float
        Phase of the eccentric at the first sample; its vertical force goes with the sine.
    samples_per_revolution : int
        Samples in one revolution.

    Raises
    ------
    ValueError
        On construction, if the samples are not an even number of whole revolutions, or none: orders of a half
        need two.

    Examples
    --------
    A drum that nothing touches moves against its eccentric, and no force is found:

    >>> phase = 2.0 * np.pi * np.arange(2 * 128) / 128
    >>> free = 1.6e-3 * (2.0 * np.pi * 28.0) ** 2 * np.sin(phase)
    >>> drum = Drum(mass_kg=3200.0, static_load_n=0.0, radius_m=0.75, width_m=2.1)
    >>> motion = DrumMotion(free, drum, amplitude_m=1.6e-3, frequency_hz=28.0)
    >>> bool(np.abs(motion.soil_force).max() < 1e-6), round(float(np.ptp(motion.height)), 9)
    (True, 0.0032)
    """

    vertical: NDArray[np.floating]
    drum: Drum
    amplitude_m: Number
    frequency_hz: Number
    phase_rad: float = 0.0
    samples_per_revolution: int = SAMPLES_PER_REVOLUTION

    def __post_init__(self) -> None:
        samples = self.vertical.shape[-1]
        if samples == 0 or samples % (2 * self.samples_per_revolution):
            raise ValueError(
                f"{samples} samples are no even number of revolutions of "
                f"{self.samples_per_revolution} samples"
            )

    @property
    def revolutions(self) -> int:
        """Revolutions of the window."""
        return int(self.vertical.shape[-1]) // self.samples_per_revolution

    @cached_property
    def omega(self) -> NDArray[np.float64]:
        """Angular frequency of the eccentric, rad/s, shape (...)."""
        return 2.0 * math.pi * np.asarray(self.frequency_hz, dtype=np.float64)

    @cached_property
    def force_amplitude(self) -> NDArray[np.float64]:
        """F = m_d A ω² times the vertical share, N, shape (...)."""
        moment = self.drum.mass_kg * np.asarray(self.amplitude_m, dtype=np.float64)
        return np.asarray(moment * self.omega**2 * self.drum.vertical_share, dtype=np.float64)

    @cached_property
    def fundamental(self) -> NDArray[np.complex128]:
        """C_1, m/s², shape (...): the fundamental of the acceleration is Re C_1 exp(iφ)."""
        out = np.empty(math.prod(self._shape), dtype=np.complex128)
        kernels.fundamentals(
            self._motions, *eccentric(self.phase_rad, self.samples_per_revolution), out
        )
        return out.reshape(self._shape)

    @cached_property
    def soil_force(self) -> NDArray[np.float64]:
        """F_s on the drum, N, up positive, shape (..., samples)."""
        drum, shape = self.drum, self._shape
        sine, _ = eccentric(self.phase_rad, self.samples_per_revolution)
        out = np.empty_like(self._motions)
        kernels.soil_forces(
            self._motions,
            one_each(drum.mass_kg, shape),
            one_each(drum.static_load_n, shape),
            one_each(self.force_amplitude, shape),
            sine,
            out,
        )
        return out.reshape(self.vertical.shape)

    @cached_property
    def height(self) -> NDArray[np.float64]:
        """Height of the drum over its mean, m, up positive, shape (..., samples)."""
        samples = self.vertical.shape[-1]
        spectrum = np.fft.rfft(self._motions)
        spectrum *= _twice_integrated(samples, self.revolutions)
        height = np.fft.irfft(spectrum, samples)
        height /= one_each(self.omega**2, self._shape)[:, np.newaxis]
        return height.reshape(self.vertical.shape)

    @property
    def _shape(self) -> tuple[int, ...]:
        return self.vertical.shape[:-1]

    @cached_property
    def _motions(self) -> NDArray[np.float64]:
        """The motions as the kernels take them, in rows."""
        vertical = np.ascontiguousarray(self.vertical, dtype=np.float64)
        return vertical.reshape(-1, vertical.shape[-1])


def one_each(value: npt.ArrayLike, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return a number, or one for each motion of some shape, as the kernels take them: one for each, in a row."""
    out = np.empty(shape)
    out[...] = value
    return out.reshape(-1)


@lru_cache(maxsize=8)
def eccentric(
    phase_rad: float, samples_per_revolution: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return sine and cosine of the eccentric's phase at the samples of a revolution."""
    step = 2.0 * math.pi / samples_per_revolution
    phase = phase_rad + step * np.arange(samples_per_revolution)
    return np.sin(phase), np.cos(phase)


@lru_cache(maxsize=8)
def _twice_integrated(samples: int, revolutions: int) -> NDArray[np.float64]:
    """Return what integrating twice makes of each order in a window: −1/order², 0 for the mean."""
    orders = np.arange(samples // 2 + 1) / revolutions
    factors = np.zeros(len(orders))
    factors[1:] = -1.0 / orders[1:] ** 2
    return factors
