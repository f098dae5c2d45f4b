# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What each feature makes of the ground."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.parameters import Machine, ParameterError, Soil
from roller_sim_ros.parameters.soil import COVARIATION_EXPONENT
from roller_sim_ros.site import FEATURES, GroundPlan, GroundValues, Lane, LaneSite, Plan
from roller_sim_ros.site.features import (
    Feature,
    Gradient,
    HardObject,
    RandomField,
    Section,
    SoftSpot,
    Stream,
)
from roller_sim_ros.site.lane_site import profile_of
from roller_sim_ros.site.profile import Profile
from roller_sim_ros.soil_mechanics import MACHINES, SOILS


def profile(
    *features: Feature, cells: int = 80, cell_m: float = 0.25, seed: int = 1, mpa: float = 40.0
) -> Profile:
    ground = GroundPlan(shear_modulus_mpa=mpa, plastic_mm=0.75, features=features)
    return profile_of(ground, cells, cell_m, Machine(), Soil(), seed)


def at(found: Profile, chainage_m: float) -> tuple[float, float]:
    """Return G in MPa and p in mm of the cell at a chainage."""
    cell = int(chainage_m / found.cell_m)
    return found.shear_modulus_pa[cell] / 1e6, found.plastic_parameter_m[cell] * 1e3


def test_ground_by_name_is_the_preset_s_under_the_machine() -> None:
    machine = MACHINES["cs-563e"].machine
    assert GroundValues(preset="paper-soft").soil(machine, Soil()) == SOILS["paper-soft"].soil(
        machine
    )
    changed = GroundValues(preset="paper-soft", shear_modulus_mpa=50.0).soil(Machine(), Soil())
    assert (changed.shear_modulus_pa, changed.plastic_parameter_m) == (50e6, 0.8e-3)


def test_where_only_g_is_given_p_covaries_and_is_scaled_to_the_machine() -> None:
    values = GroundValues(shear_modulus_mpa=80.0)
    plastic = values.soil(Machine(), Soil()).plastic_parameter_m
    assert plastic == pytest.approx(0.8e-3 * (80 / 35) ** -0.5686)
    half = Machine(frame_mass_kg=1200.0, drum_mass_kg=1600.0)
    assert values.soil(half, Soil()).plastic_parameter_m == pytest.approx(plastic / 2)
    given = GroundValues(
        shear_modulus_mpa=80.0, plastic_mm=0.65, density_kg_m3=1900.0, poisson_ratio=0.3
    )
    assert given.soil(half, Soil()) == Soil(80e6, 0.65e-3, 1900.0, 0.3)


def test_a_section_has_sharp_ends() -> None:
    found = profile(Section(from_m=5.0, to_m=10.0, shear_modulus_mpa=70.0, plastic_mm=0.5))
    assert at(found, 4.9) == at(found, 10.1) == pytest.approx((40.0, 0.75))
    assert at(found, 5.1) == at(found, 9.9) == pytest.approx((70.0, 0.5))
    assert np.count_nonzero(found.shear_modulus_pa == 70e6) == 20


def test_a_section_changes_only_what_it_says() -> None:
    found = profile(Section(from_m=10.0, density_kg_m3=1800.0))
    assert at(found, 19.9) == pytest.approx((40.0, 0.75))
    assert found.density_kg_m3[-1] == 1800.0
    assert found.density_kg_m3[0] == 2000.0


def test_a_gradient_is_linear_in_g_and_holds_beyond() -> None:
    found = profile(Gradient(from_m=4.0, to_m=12.0, shear_modulus_mpa=80.0))
    centres = found.centres_m
    inside = (centres > 4.0) & (centres < 12.0)
    expected = 40.0 + 40.0 * (centres[inside] - 4.0) / 8.0
    np.testing.assert_allclose(found.shear_modulus_pa[inside] / 1e6, expected)
    assert at(found, 3.9)[0] == 40.0
    assert at(found, 12.1)[0] == at(found, 19.9)[0] == pytest.approx(80.0)
    assert at(found, 19.9)[1] == pytest.approx(0.75 * 2.0**COVARIATION_EXPONENT)


def test_a_gradient_of_p_alone_leaves_g() -> None:
    found = profile(Gradient(plastic_mm=0.3))
    assert set(found.shear_modulus_pa) == {40e6}
    assert found.plastic_parameter_m[-1] == pytest.approx(0.3e-3)
    assert found.plastic_parameter_m[0] == pytest.approx(0.75e-3, rel=0.01)


def test_a_random_field_has_the_declared_moments_and_correlation() -> None:
    cells, cell_m, length_m, variation = 60_000, 0.25, 1.5, 0.2
    field = RandomField(coefficient_of_variation=variation, correlation_length_m=length_m)
    found = profile(field, cells=cells, cell_m=cell_m, mpa=50.0)
    logs = np.log(found.shear_modulus_pa / 50e6)
    sigma = math.sqrt(math.log1p(variation**2))
    # 2 L / cell of the cells count as one independent value; bounds of 5 sigma of mean and variance.
    independent = cells * cell_m / (2.0 * length_m)
    assert abs(logs.mean() + sigma**2 / 2) < 5.0 * sigma / math.sqrt(independent)
    assert (
        abs(logs.std() / sigma - 1.0) < 5.0 / math.sqrt(2.0 * independent) + 0.005
    )  # cut at 3 sigma
    centred = logs - logs.mean()
    for lag in (2, 6, 12):
        correlation = np.mean(centred[lag:] * centred[:-lag]) / np.mean(centred**2)
        assert correlation == pytest.approx(
            math.exp(-lag * cell_m / length_m), abs=5.0 / math.sqrt(independent)
        )
    assert np.abs(logs + sigma**2 / 2).max() <= 3.0 * sigma + 1e-12
    np.testing.assert_allclose(
        found.plastic_parameter_m / 0.75e-3, (found.shear_modulus_pa / 50e6) ** COVARIATION_EXPONENT
    )


def test_random_fields_follow_their_seeds_and_nothing_else() -> None:
    field = RandomField(coefficient_of_variation=0.2, correlation_length_m=2.0)
    alone = profile(field)
    assert np.array_equal(alone.shear_modulus_pa, profile(field).shear_modulus_pa)
    assert not np.array_equal(alone.shear_modulus_pa, profile(field, seed=2).shear_modulus_pa)
    # Another feature, also another field after it, does not change the first one's numbers.
    second = RandomField(coefficient_of_variation=0.1, correlation_length_m=2.0)
    both = profile(field, second)
    other = both.shear_modulus_pa / alone.shear_modulus_pa
    assert not np.allclose(other, 1.0)
    swapped = profile(SoftSpot(at_m=15.0, length_m=2.0), field)
    assert np.allclose(swapped.shear_modulus_pa[:50], alone.shear_modulus_pa[:50], rtol=1e-12)
    own = RandomField(coefficient_of_variation=0.2, correlation_length_m=2.0, seed=9)
    assert np.array_equal(profile(own).shear_modulus_pa, profile(own, seed=5).shear_modulus_pa)


def test_a_random_field_stays_within_its_stretch() -> None:
    found = profile(
        RandomField(coefficient_of_variation=0.2, correlation_length_m=2.0, from_m=5.0, to_m=9.0)
    )
    outside = (found.centres_m < 5.0) | (found.centres_m > 9.0)
    assert (found.shear_modulus_pa[outside] == 40e6).all()
    assert np.ptp(found.shear_modulus_pa[~outside]) > 1e6


@pytest.mark.parametrize(
    ("spot", "ratio", "compactability"),
    [
        (SoftSpot(at_m=10.125, length_m=3.0, stiffness_ratio=0.4), 0.4, 0.3),
        (HardObject(at_m=10.125, length_m=3.0, stiffness_ratio=5.0), 5.0, 0.0),
    ],
)
def test_spots_have_their_ratio_in_the_middle_and_fade_out(
    spot: Feature, ratio: float, compactability: float
) -> None:
    found = profile(spot)
    middle = 40
    modulus, plastic = at(found, 10.125)
    assert modulus == pytest.approx(40.0 * ratio)
    assert plastic == pytest.approx(0.75 * ratio**COVARIATION_EXPONENT)
    assert found.compactability[middle] == pytest.approx(compactability)
    # A quarter of the length beside the middle: half of the way in the logarithm.
    assert at(found, 10.125 + 0.75)[0] == pytest.approx(40.0 * math.sqrt(ratio))
    assert at(found, 8.5)[0] == at(found, 11.75)[0] == pytest.approx(40.0)
    assert found.compactability[0] == 1.0


def test_p_of_a_spot_can_be_given() -> None:
    found = profile(SoftSpot(at_m=10.125, length_m=3.0, plastic_ratio=3.0))
    assert at(found, 10.125)[1] == pytest.approx(2.25)


def test_features_act_on_what_those_before_them_left() -> None:
    section = Section(from_m=0.0, to_m=20.0, shear_modulus_mpa=20.0)
    spot = SoftSpot(at_m=10.125, length_m=3.0, stiffness_ratio=0.5)
    assert at(profile(section, spot), 10.125)[0] == pytest.approx(10.0)
    assert at(profile(spot, section), 10.125)[0] == pytest.approx(20.0)


def test_ground_beyond_the_model_is_refused_with_its_place() -> None:
    weak = SoftSpot(at_m=10.0, length_m=2.0, stiffness_ratio=0.02)
    with pytest.raises(
        ParameterError,
        match=r"soil.shear_modulus_pa = 669007.*must be 2e\+06 … 1e\+09 Pa.*chainage 9.62 m",
    ):
        profile(weak, mpa=10.0)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Section(from_m=5.0, to_m=5.0), "to_m"),
        (lambda: Gradient(from_m=5.0, to_m=4.0, shear_modulus_mpa=50.0), "to_m"),
        (lambda: Gradient(from_m=5.0), "shear_modulus_mpa"),
        (
            lambda: RandomField(
                coefficient_of_variation=0.1, correlation_length_m=1.0, from_m=3.0, to_m=2.0
            ),
            "to_m",
        ),
        (lambda: SoftSpot(at_m=1.0, length_m=2.0, stiffness_ratio=1.5), "stiffness_ratio"),
        (lambda: HardObject(at_m=1.0, length_m=2.0, stiffness_ratio=0.5), "stiffness_ratio"),
    ],
)
def test_features_that_cannot_be_are_refused(make, name: str) -> None:
    with pytest.raises(ParameterError) as caught:
        make()
    assert caught.value.name == name


def test_a_gradient_beyond_the_lane_does_nothing() -> None:
    assert set(profile(Gradient(from_m=50.0, shear_modulus_mpa=80.0)).shear_modulus_pa) == {40e6}


def test_a_new_feature_is_one_class_and_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    class Doubled(Feature):
        def apply(self, profile: Profile, stream: Stream) -> None:
            del stream
            profile.stiffen(np.full(len(profile.shear_modulus_pa), 2.0))

    monkeypatch.setitem(FEATURES, "doubled", Doubled)
    site = LaneSite(
        Lane(length_m=5.0),
        GroundPlan(shear_modulus_mpa=20.0, features=(Doubled(),)),
        Plan(),
        machine=Machine(),
        otherwise=Soil(),
        seed=0,
    )
    assert site.soil(Soil()).shear_modulus_pa == 40e6
