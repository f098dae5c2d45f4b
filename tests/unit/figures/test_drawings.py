# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What figures are painted from: no empty panel, labelled axes, and the helpers behind them."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.axes import Axes

from roller_sim_ros.figures import sensitivity as figure
from roller_sim_ros.figures.drawing import stacked
from roller_sim_ros.figures.force_displacement import one_period
from roller_sim_ros.figures.misleading import read_modulus
from roller_sim_ros.figures.output import painted
from roller_sim_ros.figures.registry import FIGURES, Entry
from roller_sim_ros.figures.style import REGIONS, regions
from roller_sim_ros.meters import Mode
from roller_sim_ros.validation import sensitivity
from roller_sim_ros.validation.study import STIFF, Study, motion

QUICK = Study.of("two-pole", resolution=7, revolutions=60)


def has_data(axes: Axes) -> bool:
    return any(len(line.get_xdata()) > 1 for line in axes.lines) or bool(axes.collections)


@pytest.mark.parametrize(
    "entry", [entry for entry in FIGURES if entry.default], ids=lambda entry: entry.name
)
def test_no_panel_is_empty_and_the_axes_are_labelled(entry: Entry) -> None:
    found = painted(entry.drawing(QUICK), "caption")
    assert found.axes
    assert all(has_data(axes) for axes in found.axes)
    # Panels in a row or a column share a label.
    assert any(axes.get_xlabel() for axes in found.axes)
    assert any(axes.get_ylabel() for axes in found.axes)


def test_the_sensitivity_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sensitivity, "AREA_FACTORS", (4.0,))
    monkeypatch.setattr(sensitivity, "QUALITY_FACTORS", (0.4,))
    monkeypatch.setattr(sensitivity, "FREQUENCY_FACTORS", (2.75,))
    drawing = figure.drawing(QUICK)
    assert len(drawing.table["verdict"]) == 2 * len(sensitivity.LOOKED_AT)
    assert set(figure._TITLES) == {statement.key for statement in sensitivity.LOOKED_AT}
    assert all(has_data(axes) for axes in painted(drawing, "caption").axes)


def test_choices_hold_the_defaults_and_none_twice() -> None:
    chosen = list(sensitivity.choices())
    assert len(set(chosen)) == len(chosen)
    for model in ("exact", "two-pole"):
        default = Study.of(model).base.half_space
        assert default in chosen
    assert len(list(sensitivity.choices(resolution=7))) < len(chosen) / 3


def test_regions_of_mode() -> None:
    mode = np.array([1, 2, 3, 4, 5, 5])
    period = np.array([1, 1, 2, 4, 8, 0])
    assert regions(mode, period).tolist() == list(range(len(REGIONS)))
    # Chaos of a drum that keeps contact is continuous contact, as the mode has it.
    assert regions(np.array([Mode.CONTINUOUS_CONTACT]), np.array([0])).tolist() == [0]


def test_readings_are_read_off_a_calibration() -> None:
    moduli = np.array([10.0, 20.0, 40.0])
    calibration = np.array([1.0, 2.0, 3.0])
    read = read_modulus(np.array([0.0, 1.5, 3.0, 9.0]), calibration, moduli)
    assert read.tolist() == [10.0, 15.0, 40.0, 40.0]
    # A curve that falls somewhere calibrates nothing.
    assert np.isnan(read_modulus(np.ones(2), calibration[::-1], moduli)).all()


def test_tables_are_stacked_with_a_name() -> None:
    table = stacked("ground", {"soft": {"x": np.arange(2)}, "stiff": {"x": np.arange(3)}})
    assert table["ground"].tolist() == ["soft"] * 2 + ["stiff"] * 3
    assert table["x"].tolist() == [0, 1, 0, 1, 2]


def test_a_loop_begins_where_the_drum_lands_and_takes_one_period() -> None:
    tail = motion(QUICK.on(STIFF))
    force, height = one_period(tail)
    assert len(force) == len(height) == 2 * tail.samples_per_revolution + 1
    assert force[0] == 0.0 < force[1]
    assert force[-1] == pytest.approx(0.0, abs=0.01 * force.max())
