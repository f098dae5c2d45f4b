# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Circular loads (Figure 7) and the energy that a load radiates."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import jv

from roller_sim_ros.half_space import (
    HalfSpaceError,
    circular_compliance,
    radiated_energy,
    sung_functions,
)
from roller_sim_ros.half_space.circular import DISPLACEMENTS, LOADS

POISSON_RATIOS = (0.0, 0.25, 0.35, 0.49)


def wavenumber_integral(wave, poisson_ratio, transform):
    """1/(2 pi) int F(k) transform(k) k dk of Lamb's half space for a complex (damped) wave number."""
    a2 = (1.0 - 2.0 * poisson_ratio) / (2.0 - 2.0 * poisson_ratio)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    total = 0.0
    cuts = [0.0, 4.0, *np.arange(54.0, 2055.0, 100.0)]
    for low, high in itertools.pairwise(cuts):
        k = low + 0.5 * (high - low) * (nodes + 1.0)
        p, s = np.sqrt(k**2 - a2 * wave**2 + 0j), np.sqrt(k**2 - wave**2 + 0j)
        rayleigh = (2.0 * k**2 - wave**2) ** 2 - 4.0 * k**2 * p * s
        kernel = -(wave**2) * p * k / rayleigh
        total += np.sum(0.5 * (high - low) * weights * kernel * transform(k))
    return total / (2.0 * math.pi)


@pytest.mark.parametrize("poisson_ratio", POISSON_RATIOS)
@pytest.mark.parametrize(
    ("load", "displacement", "transform"),
    [
        ("parabolic", "centre", lambda k: 8.0 * jv(2, k) / k**2),
        ("uniform", "average", lambda k: (2.0 * jv(1, k) / k) ** 2),
        ("parabolic", "average", lambda k: (8.0 * jv(2, k) / k**2) ** 2),
    ],
)
def test_circular_loads_are_lambs_wavenumber_integral(load, displacement, transform, poisson_ratio):
    # Hankel transforms of the stress; damped, so that the Rayleigh pole lies off the path.
    wave = 1.3 / np.sqrt(1.0 + 0.2j)
    expected = wavenumber_integral(wave, poisson_ratio, transform)
    found = complex(sung_functions(wave, poisson_ratio, load, displacement))
    assert found == pytest.approx(expected, rel=3e-5)  # the integral is cut off at k = 2054


@pytest.mark.parametrize("poisson_ratio", POISSON_RATIOS)
def test_static_limits(poisson_ratio):
    free = 1.0 - poisson_ratio
    centre = {"uniform": free / math.pi, "parabolic": 4 * free / (3 * math.pi), "rigid": free / 4}
    for load, expected in centre.items():
        assert complex(sung_functions(0.0, poisson_ratio, load)) == pytest.approx(expected)
    # A rigid disc settles everywhere alike; the mean under the uniform load is 8 (1 - nu)/(3 pi^2).
    average = {"uniform": 8 * free / (3 * math.pi**2), "rigid": free / 4}
    for load, expected in average.items():
        found = complex(sung_functions(0.0, poisson_ratio, load, "average"))
        assert found == pytest.approx(expected, rel=1e-9)


def test_effective_radii_named_by_the_paper():
    # 'The effective radius for the rigid plate would be 1.273 r0 and for the parabolic load 0.75 r0'
    uniform, parabolic, rigid = (complex(sung_functions(0.0, 0.25, load)).real for load in LOADS)
    assert uniform / rigid == pytest.approx(1.273, abs=5e-4)
    assert uniform / parabolic == pytest.approx(0.75, abs=1e-9)


def test_all_three_radiate_alike_at_low_frequency():
    # Im f = -a0 times the point load's total: the wave is longer than the load.
    total = radiated_energy(0.25).total / (2.0 * math.pi)
    for load in LOADS:
        for displacement in DISPLACEMENTS:
            found = complex(sung_functions(1e-4, 0.25, load, displacement)).imag
            assert found == pytest.approx(-1e-4 * total, rel=1e-6)


@given(st.floats(0.01, 30.0), st.floats(0.0, 0.49), st.sampled_from(LOADS))
@settings(deadline=None, max_examples=40)
def test_energy_is_radiated_at_all_frequencies(a0, poisson_ratio, load):
    # The average weighted by the stress is conjugate to the load: power = omega |F|^2 (-Im H)/2.
    assert complex(sung_functions(a0, poisson_ratio, load, "average")).imag < 0.0


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.25, 0.4])
def test_high_frequency_limit_is_the_plane_compression_wave(poisson_ratio):
    # H -> 1/(i omega rho v_p area) for the uniform load, 4/3 of it (the mean square stress) for the parabolic.
    shear, density, radius = 50e6, 2000.0, 0.3
    v_p = math.sqrt(shear / density * (2 - 2 * poisson_ratio) / (1 - 2 * poisson_ratio))
    omega = 150.0 * math.sqrt(shear / density) / radius
    limit = 1.0 / (1j * omega * density * v_p * math.pi * radius**2)
    for load, share in (("uniform", 1.0), ("parabolic", 4.0 / 3.0)):
        h = circular_compliance(omega, shear, density, poisson_ratio, radius, load, "average")
        assert complex(h) == pytest.approx(share * limit, rel=0.01)


def test_rayleigh_wave_carries_two_thirds():
    # Miller and Pursey (1955), nu = 1/4: 67.4, 25.8 and 6.9 %.
    energy = radiated_energy(0.25)
    assert energy.rayleigh == pytest.approx(0.674, abs=5e-4)
    assert energy.shear == pytest.approx(0.258, abs=6e-4)
    assert energy.compression == pytest.approx(0.069, abs=5e-4)


@given(st.floats(0.0, 0.49))
@settings(deadline=None, max_examples=30)
def test_shares_sum_to_the_power_of_the_point_load(poisson_ratio):
    energy = radiated_energy(poisson_ratio)
    assert energy.rayleigh + energy.shear + energy.compression == pytest.approx(1.0)
    slow = complex(sung_functions(1e-5, poisson_ratio, "parabolic", "average"))
    assert energy.total == pytest.approx(-slow.imag / 1e-5 * 2.0 * math.pi, rel=1e-7)


def test_units_shape_and_damping():
    soil = (50e6, 2000.0, 0.25, 0.3, "uniform")
    omega = np.array([[0.0, 100.0], [200.0, -200.0]])
    h = circular_compliance(omega, *soil, hysteretic_damping=0.05)
    assert h.shape == omega.shape
    assert h[0, 0] == pytest.approx(0.75 / (math.pi * 50e6 * 0.3), rel=1e-12)
    assert h[1, 1] == np.conj(h[1, 0])
    unit_time = 0.3 * math.sqrt(2000.0 / 50e6)
    undamped = complex(sung_functions(100.0 * unit_time, 0.25, "uniform")) / (50e6 * 0.3)
    assert complex(circular_compliance(100.0, *soil)) == pytest.approx(undamped, rel=1e-12)
    assert abs(h[0, 1]) < abs(undamped)
    assert h[0, 1].imag / h[0, 1].real < undamped.imag / undamped.real


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((1.0, 0.25, "flexible"), "flexible"),
        ((1.0, 0.25, "uniform", "edge"), "edge"),
        ((1.0, 0.6, "uniform"), "poisson_ratio"),
    ],
)
def test_bad_arguments_are_named(arguments, named):
    with pytest.raises(HalfSpaceError, match=named):
        sung_functions(*arguments)


def test_radius_must_be_positive():
    with pytest.raises(HalfSpaceError, match=r"radius_m = 0\.0"):
        circular_compliance(1.0, 50e6, 2000.0, 0.25, 0.0, "uniform")
