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
from functools import cached_property

import numpy as np
import numpy.typing as npt
from numpy.typing import NDArray

from roller_sim_ros.exciter import DIRECTIONS
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

    @property
    def omega(self) -> NDArray[np.float64]:
        """Angular frequency of the eccentric, rad/s, shape (...)."""
        return 2.0 * math.pi * np.asarray(self.frequency_hz, dtype=np.float64)

    @property
    def force_amplitude(self) -> NDArray[np.float64]:
        """F = m_d A ω² times the vertical share, N, shape (...)."""
        moment = self.drum.mass_kg * np.asarray(self.amplitude_m, dtype=np.float64)
        return np.asarray(moment * self.omega**2 * self.drum.vertical_share, dtype=np.float64)

    @property
    def phase(self) -> NDArray[np.float64]:
        """Phase of the eccentric at the samples of the first revolution, and of each, rad."""
        step = 2.0 * math.pi / self.samples_per_revolution
        return np.asarray(self.phase_rad + step * np.arange(self.samples_per_revolution))

    @cached_property
    def fundamental(self) -> NDArray[np.complex128]:
        """C_1, m/s², shape (...): the fundamental of the acceleration is Re C_1 exp(iφ)."""
        mean_revolution = self._by_revolutions(self.vertical).mean(axis=-2, dtype=np.float64)
        turns = np.exp(-1j * self.phase) * (2.0 / self.samples_per_revolution)
        # Not a matrix product: BLAS would start threads for it, and round differently with the number of motions.
        return np.asarray((mean_revolution * turns).sum(axis=-1))

    @cached_property
    def soil_force(self) -> NDArray[np.float64]:
        """F_s on the drum, N, up positive, shape (..., samples)."""
        vertical = np.asarray(self.vertical, dtype=np.float64)
        inertia = _column(self.drum.mass_kg) * (vertical - vertical.mean(axis=-1, keepdims=True))
        rest = _column(self.drum.static_load_n) - _column(self.force_amplitude) * np.sin(self.phase)
        force = self._by_revolutions(inertia) + rest[..., np.newaxis, :]
        return np.asarray(force.reshape(inertia.shape), dtype=np.float64)

    @cached_property
    def height(self) -> NDArray[np.float64]:
        """Height of the drum over its mean, m, up positive, shape (..., samples)."""
        spectrum = np.fft.rfft(np.asarray(self.vertical, dtype=np.float64))
        spectrum[..., 0] = 0.0
        orders = np.arange(1, spectrum.shape[-1]) / self.revolutions
        spectrum[..., 1:] /= -((_column(self.omega) * orders) ** 2)
        return np.asarray(np.fft.irfft(spectrum, self.vertical.shape[-1]))

    def _by_revolutions(self, values: NDArray[np.floating]) -> NDArray[np.floating]:
        """Return the samples in one row for each revolution."""
        return values.reshape(*values.shape[:-1], -1, self.samples_per_revolution)


def _column(value: npt.ArrayLike) -> NDArray[np.float64]:
    """Return a number for each motion as one for each of its samples."""
    return np.asarray(value, dtype=np.float64)[..., np.newaxis]
