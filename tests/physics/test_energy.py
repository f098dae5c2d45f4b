# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Energy books: what the exciter and gravity put in is found again in plastic work and waves."""

from __future__ import annotations

import numpy as np
import pytest

from roller_sim_ros.drum_soil import LOADING
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.half_space import exact_compliance, two_pole_compliance
from roller_sim_ros.parameters import HalfSpace
from tests.physics.rollers import MACHINE, Point, Run, settled

REVOLUTIONS = 8
PER_REVOLUTION = 128


def _compliance(model: str, omega: np.ndarray, run: Run, point: Point) -> np.ndarray:
    strip = run.ground.strip
    soil = point.soil
    function = exact_compliance if model == "exact" else two_pole_compliance
    return np.asarray(
        function(
            omega,
            soil.shear_modulus_pa,
            soil.density_kg_m3,
            soil.poisson_ratio,
            strip.half_width_m,
            strip.half_length_m,
        )
    )


def _books(run: Run, point: Point, model: str) -> dict[str, float]:
    """Return the entries over the kept revolutions, J; what is put in is positive, what is found again negative."""
    out = run.samples
    end = run.ground.state
    force = np.append(out[at.OUT_FORCE], end[at.FORCE])
    depth = np.append(out[at.OUT_DEPTH], end[at.DEPTH])
    plastic = np.append(out[at.OUT_PLASTIC], end[at.PLASTIC])
    datum = np.append(out[at.OUT_DATUM], end[at.DATUM])
    phase = out[at.OUT_PHASE]
    count = out.shape[1]
    angle = 2.0 * np.pi / run.per_revolution * np.arange(count + 1)
    omega = 2.0 * np.pi * point.frequency_hz
    exciter_force = MACHINE.drum_mass_kg * point.amplitude_m * omega**2 * np.sin(angle)
    # Work on the falling depth: the exciter's force is positive up. Trapezoid with its correction (ωh)²/12.
    exciter = -np.sum(0.5 * (exciter_force[1:] + exciter_force[:-1]) * np.diff(depth))
    exciter *= 1.0 + (2.0 * np.pi / run.per_revolution) ** 2 / 12.0
    load = MACHINE.static_load_n
    gravity = load * ((depth[-1] - datum[-1]) - (depth[0] - datum[0]))
    height_datum = load * (datum[-1] - datum[0])
    before = run.state_before
    kinetic = 0.5 * MACHINE.drum_mass_kg * (end[at.VELOCITY] ** 2 - before[at.VELOCITY] ** 2)
    # Plastic depth grows in loading only; a renewal in contact moves depth from q to D, one in the air costs nothing.
    in_contact = (phase != at.AIR) & (np.append(phase[1:], end[at.PHASE]) != at.AIR)
    growth = np.where(in_contact, np.diff(plastic + datum), np.diff(plastic))
    growth = np.maximum(growth, 0.0)
    stiffness = load / point.plastic_parameter_m
    start_force = np.where(phase == LOADING, force[:-1], np.minimum(force[:-1], force[1:]))
    start_force = np.where(phase == at.AIR, 0.0, start_force)
    plastic_work = float(np.sum(start_force * growth + 0.5 * stiffness * growth**2))
    # Waves: the settled force as a Fourier series.
    lines = np.fft.rfft(force[:-1]) / count * 2.0
    omegas = omega / (count / run.per_revolution) * np.arange(1, 40 * count // run.per_revolution)
    amplitudes = np.abs(lines[1 : omegas.size + 1])
    duration = count / run.per_revolution / point.frequency_hz
    radiated = float(
        np.sum(0.5 * omegas * amplitudes**2 * -np.imag(_compliance(model, omegas, run, point)))
        * duration
    )
    return {
        "exciter": exciter,
        "gravity": gravity,
        "height datum": height_datum,
        "kinetic": -kinetic,
        "plastic": -plastic_work,
        "radiated": -radiated,
    }


@pytest.mark.parametrize("model", ["exact", "two-pole"])
@pytest.mark.parametrize(
    "point",
    [
        Point(28.0, 1.6e-3, 35e6, 0.8e-3),
        Point(28.0, 1.6e-3, 80e6, 0.5e-3),
        Point(28.0, 0.8e-3, 80e6, 0.5e-3),
        Point(36.0, 1.6e-3, 80e6, 0.5e-3),
        Point(22.0, 0.3e-3, 20e6, 1.1e-3),
        Point(33.0, 0.2e-3, 60e6, 0.6e-3),
    ],
    ids=lambda point: (
        f"f{point.frequency_hz:g}-A{point.amplitude_m * 1e3:g}-G{point.shear_modulus_pa / 1e6:g}"
    ),
)
def test_energy_books_close_over_a_settled_cycle(point: Point, model: str) -> None:
    run = settled(point, HalfSpace(model=model), revolutions=3000, kept=REVOLUTIONS)
    books = _books(run, point, model)
    put_in = books["exciter"] + books["height datum"]
    assert books["plastic"] < 0.0
    assert books["radiated"] < 0.0
    assert abs(sum(books.values())) < 0.005 * put_in, books


@pytest.mark.parametrize("model", ["exact", "two-pole"])
@pytest.mark.parametrize("frequency_hz", [15.0, 28.0, 40.0])
def test_a_bonded_harmonic_load_radiates_its_share(model: str, frequency_hz: float) -> None:
    # A drum that only just stirs stays in contact; the force it then makes is harmonic, and what flows into the half
    # space is the work of that force on the surface.
    point = Point(frequency_hz, 2e-5, 40e6, 0.7e-3)
    run = settled(point, HalfSpace(model=model), revolutions=2000, kept=REVOLUTIONS)
    force = run.samples[at.OUT_FORCE]
    surface = run.samples[at.OUT_SURFACE]
    assert run.summary().air_fraction == 0.0
    omega = 2.0 * np.pi * frequency_hz
    line = 2.0 * np.fft.rfft(force)[REVOLUTIONS] / force.size
    surface_line = 2.0 * np.fft.rfft(surface)[REVOLUTIONS] / force.size
    # Power into the half space at the excitation frequency: ½ Re(F (iω e)*).
    flowing = 0.5 * np.real(line * np.conj(1j * omega * surface_line))
    compliance = _compliance(model, np.array([omega]), run, point)[0]
    radiated = 0.5 * omega * abs(line) ** 2 * abs(np.imag(compliance))
    assert flowing == pytest.approx(radiated, rel=0.01)
