# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The lane: ground that follows the position, remembers passes, and can be saved and restored."""

from __future__ import annotations

import math

import numpy as np
import pytest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Machine, ParameterError, Soil
from roller_sim_ros.site import CompactionLaw, GroundPlan, Lane, LaneSite, Plan
from roller_sim_ros.site.compaction import Exponential, Hyperbolic
from roller_sim_ros.site.features import HardObject, RandomField, Section, SoftSpot

STEP_S = 1 / 28.0
LIMIT = {"limit_shear_modulus_mpa": 60.0, "limit_plastic_mm": 0.5}


def lane(
    law: CompactionLaw | None = None,
    *features: object,
    length_m: float = 10.0,
    cell_m: float = 0.25,
    seed: int = 1,
    **plan: object,
) -> LaneSite:
    ground = GroundPlan(
        shear_modulus_mpa=20.0,
        plastic_mm=1.0,
        features=features,  # type: ignore[arg-type]
        compaction=law,
    )
    return LaneSite(
        Lane(length_m=length_m, cell_m=cell_m),
        ground,
        Plan(**plan),  # type: ignore[arg-type]
        machine=Machine(),
        otherwise=Soil(),
        seed=seed,
    )


def drive(site: LaneSite, force_ratio: float = 2.9, passes: int | None = None) -> None:
    """Drive to the end of the plan, or until some passes are done."""
    for _ in range(100_000):
        site.move(STEP_S, force_ratio)
        position = site.position
        if position.finished or (passes is not None and position.pass_number > passes):
            return


def test_the_ground_is_that_under_the_drum() -> None:
    site = lane(None, Section(from_m=5.0, shear_modulus_mpa=80.0, plastic_mm=0.5))
    while site.position.chainage_m < 4.9:
        assert site.soil(Soil()) == Soil(20e6, 1e-3)
        site.move(STEP_S, 2.9)
    while site.position.chainage_m < 5.0:
        site.move(STEP_S, 2.9)
    assert site.soil(Soil()) == Soil(80e6, 0.5e-3)


def test_soil_is_the_same_object_while_nothing_changes() -> None:
    site = lane(Exponential(**LIMIT), passes=3)
    found = set()
    before = site.soil(Soil())
    for _ in range(800):
        site.move(STEP_S, 2.9)
        soil = site.soil(Soil())
        # Cells that were driven over alike are alike to the last bit, although their sums were not.
        assert (soil is before) == (soil == before)
        before = soil
        found.add(soil)
    assert len(found) == 3


@pytest.mark.parametrize(
    ("law", "remaining"),
    [
        (Exponential(passes=2.5, **LIMIT), lambda n: math.exp(-n / 2.5)),
        (Hyperbolic(passes=2.0, **LIMIT), lambda n: 1.0 / (1.0 + n / 2.0)),
    ],
)
def test_passes_take_the_ground_towards_the_limits(law: CompactionLaw, remaining) -> None:
    site = lane(law, passes=8)
    for done in range(1, 9):
        drive(site, passes=done)
        modulus, plastic = site.ground()
        assert site.passes == pytest.approx(done, abs=1e-6)
        assert modulus == pytest.approx(60e6 - 40e6 * remaining(done), rel=1e-6)
        assert plastic == pytest.approx(0.5e-3 + 0.5e-3 * remaining(done), rel=1e-6)
    assert modulus.max() < 60e6


def test_a_pass_finds_what_earlier_ones_left_and_not_its_own() -> None:
    site = lane(Exponential(passes=2.5, **LIMIT), passes=2)
    for _ in range(100):
        site.move(STEP_S, 2.9)
    assert site.soil(Soil()).shear_modulus_pa == 20e6
    modulus, _ = site.ground()
    cell = int(site.position.chainage_m / 0.25)
    assert (modulus[:cell] > 30e6).all()
    assert (modulus[cell:] == 20e6).all()


@pytest.mark.parametrize(
    ("speed", "law", "counts"),
    [
        (2.0, Exponential(**LIMIT), 0.5),
        (0.5, Exponential(**LIMIT), 2.0),
        (2.0, Exponential(speed_exponent=0.0, **LIMIT), 1.0),
        (2.0, Exponential(speed_exponent=0.5, reference_speed_m_s=0.5, **LIMIT), 0.5),
    ],
)
def test_slow_passes_count_more(speed: float, law: CompactionLaw, counts: float) -> None:
    site = lane(law, speed_m_s=speed)
    drive(site)
    assert site.passes == pytest.approx(counts, rel=1e-6)


@pytest.mark.parametrize(
    ("force_ratio", "counts"), [(0.0, 0.2), (0.5, 0.6), (1.0, 1.0), (2.9, 1.0)]
)
def test_without_vibration_a_pass_counts_little(force_ratio: float, counts: float) -> None:
    site = lane(Exponential(**LIMIT))
    drive(site, force_ratio)
    assert site.passes == pytest.approx(counts, rel=1e-6)


def test_standing_counts_as_blows_or_not_at_all() -> None:
    for law, more in ((Exponential(**LIMIT), 4.0), (Exponential(speed_exponent=0.0, **LIMIT), 0.0)):
        site = lane(law, passes=2, turn_s=1.0)
        drive(site)
        # One second over 0.25 m is as long as four passes over it.
        assert site.passes[-1] - site.passes[0] == pytest.approx(more, abs=1e-6)


def test_ground_stiffer_than_the_limit_stays_as_it_is() -> None:
    site = lane(Exponential(**LIMIT), Section(from_m=5.0, shear_modulus_mpa=90.0, plastic_mm=0.3))
    drive(site)
    modulus, plastic = site.ground()
    assert modulus[-1] == 90e6
    assert plastic[-1] == 0.3e-3
    assert modulus[0] > 30e6


def test_limits_left_out_leave_the_ground_or_follow_g() -> None:
    neither = lane(Exponential(), passes=4)
    drive(neither)
    assert neither.soil(Soil()) == Soil(20e6, 1e-3)
    plastic_alone = lane(Exponential(limit_plastic_mm=0.5), passes=4)
    drive(plastic_alone)
    modulus, plastic = plastic_alone.ground()
    assert set(modulus) == {20e6}
    assert plastic.max() < 0.7e-3
    following = lane(Exponential(passes=0.1, limit_shear_modulus_mpa=80.0))
    drive(following)
    assert following.ground()[1] == pytest.approx(0.8e-3 * (80 / 35) ** -0.5686, rel=1e-3)


def test_soft_spots_hardly_compact_and_hard_objects_not_at_all() -> None:
    spots = (
        SoftSpot(at_m=3.125, length_m=2.0, stiffness_ratio=0.5),
        HardObject(at_m=7.125, length_m=2.0, stiffness_ratio=2.0),
    )
    site = lane(Exponential(passes=0.1, **LIMIT), *spots)
    drive(site)
    modulus, _ = site.ground()
    assert modulus[0] == pytest.approx(60e6, rel=1e-3)
    assert modulus[12] == pytest.approx(10e6 + 0.3 * 50e6, rel=1e-3)
    assert modulus[28] == pytest.approx(40e6, rel=1e-3)


@pytest.mark.parametrize(("speed", "cell_m"), [(5.0, 0.1), (0.05, 1.0), (1.0, 0.3)])
def test_every_cell_gets_its_share_however_long_the_steps(speed: float, cell_m: float) -> None:
    site = lane(Exponential(speed_exponent=0.0, **LIMIT), cell_m=cell_m, speed_m_s=speed, passes=2)
    drive(site)
    assert site.passes == pytest.approx(2.0, rel=1e-6)


def test_cells_fit_the_lane() -> None:
    assert lane(length_m=1.0, cell_m=0.3).cells_m == pytest.approx([1 / 6, 1 / 2, 5 / 6])
    assert len(lane(length_m=1.0, cell_m=9.0).cells_m) == 1


def test_restored_it_goes_on_to_the_last_bit() -> None:
    field = RandomField(coefficient_of_variation=0.2, correlation_length_m=1.0)

    def site() -> LaneSite:
        return lane(Exponential(**LIMIT), field, passes=4, turn_s=0.3)

    one, other = site(), site()
    for _ in range(400):
        one.move(STEP_S, 2.9)
    state = one.state()
    assert all(isinstance(it, int | float | bool | np.ndarray) for it in state.values())
    other.restore(state)
    one.drive(-2.0)
    other.drive(-2.0)
    for _ in range(600):
        assert one.soil(Soil()) == other.soil(Soil())
        one.move(STEP_S, 2.9)
        other.move(STEP_S, 2.9)
        assert one.position == other.position
    for a, b in zip(one.ground(), other.ground(), strict=True):
        assert np.array_equal(a, b)
    # What was saved is a copy.
    assert not np.array_equal(state["passes"], one.passes)


def test_a_state_of_another_lane_is_refused() -> None:
    with pytest.raises(RollerSimError, match="a lane of 40 cells; this one has 80"):
        lane(length_m=20.0).restore(lane().state())


def test_the_same_seed_makes_the_same_ground_and_another_one_another() -> None:
    field = RandomField(coefficient_of_variation=0.2, correlation_length_m=1.0)
    first, again, other = (lane(None, field, seed=seed).ground()[0] for seed in (3, 3, 4))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_the_lane_decides_all_of_the_soil() -> None:
    assert set(lane().decides) == {
        "soil.shear_modulus_pa",
        "soil.plastic_parameter_m",
        "soil.density_kg_m3",
        "soil.poisson_ratio",
    }


def test_what_does_not_fit_the_lane_is_refused() -> None:
    with pytest.raises(ParameterError, match="start_m = 11.0: must be on the lane, which is 10 m"):
        lane(start_m=11.0)
    with pytest.raises(ParameterError, match="there are at most 200000 cells"):
        Lane(length_m=10000.0, cell_m=0.02)
