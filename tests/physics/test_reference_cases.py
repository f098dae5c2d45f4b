# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Settled motion against values of an independent code (tests/reference/cases.json)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from roller_sim_ros.parameters import HalfSpace
from tests.physics.rollers import Point, settled

CASES: list[dict[str, Any]] = json.loads(
    (Path(__file__).parent.parent / "reference" / "cases.json").read_text()
)["cases"]


def _name(case: dict[str, Any]) -> str:
    return (
        f"{case['half_space']}-G{case['shear_modulus_mpa']}-f{case['frequency_hz']}"
        f"-A{case['amplitude_mm']}-k{case['area_factor']}"
    )


@pytest.mark.parametrize("case", CASES, ids=_name)
def test_settled_motion_is_the_reference(case: dict[str, Any]) -> None:
    point = Point(
        case["frequency_hz"],
        case["amplitude_mm"] * 1e-3,
        case["shear_modulus_mpa"] * 1e6,
        case["plastic_mm"] * 1e-3,
    )
    half_space = HalfSpace(model=case["half_space"], area_factor=case["area_factor"])
    run = settled(point, half_space, revolutions=case["revolutions"])
    summary = run.summary()
    tolerance = 0.01 if case["half_space"] == "exact" else 0.02
    assert summary.period == case["period"]
    for name in ("force_ratio_max", "cmv", "acceleration_max_g", "acceleration_min_g"):
        assert getattr(summary, name) == pytest.approx(case[name], rel=tolerance), name
    assert summary.rmv == pytest.approx(case["rmv"], rel=tolerance, abs=0.5)
    # A share of samples, at half the reference's resolution or less: a sample more or less at each end of a flight.
    assert summary.air_fraction == pytest.approx(case["air_fraction"], abs=2.0 / 128.0)
    assert run.ground.unsettled_steps == 0
