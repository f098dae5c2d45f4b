# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which statements of the paper hold with which k, Q and ω0."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from roller_sim_ros.figures.drawing import Drawing
from roller_sim_ros.parameters import HalfSpace
from roller_sim_ros.validation.sensitivity import LOOKED_AT, Setting, settings
from roller_sim_ros.validation.statement import Verdict
from roller_sim_ros.validation.study import Study

_COLOURS = {Verdict.HOLDS: "#2f78b7", Verdict.PARTLY: "#b5d3ea", Verdict.FAILS: "#e9a27e"}
_ORDER = list(_COLOURS)
_COLUMNS = 5

_TITLES = {
    "stable_on_soft": "(35, 0.8): period 1 with lift-off",
    "double_jump": "(80, 0.5): double jump",
    "peak_of_double_jump": "its peak is 6.9 (2 %; partly: 10 %)",
    "doubling": "double, quad jump, chaos with A",
    "instability_at_resonance": "unstable at 15–18 Hz (10 % of it; partly: less)",
    "resonance_falls": "resonance falls with amplitude",
    "three_to_six": "F/F_stat 3 to 6 where stable (partly: to 5 … 7)",
    "low_rises": "CMV rises at 0.8 mm",
    "high_jumps": "CMV falls with double jump at 1.6 mm",
    "high_stays_below": "and then stays below that at 0.8 mm",
}

Value = Callable[[HalfSpace], float]


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    found = settings(study)

    def paint(figure: Figure) -> None:
        blocks = -(-len(LOOKED_AT) // _COLUMNS)
        panels = figure.subplots(3 * blocks, _COLUMNS, height_ratios=[1.2, 6, 7] * blocks)
        for number, statement in enumerate(LOOKED_AT):
            block, column = divmod(number, _COLUMNS)
            rows = panels[3 * block : 3 * block + 3, column]
            _paint_statement(list(rows), found, number, labelled=column == 0)
            rows[0].set_title(textwrap.fill(_TITLES[statement.key], 24), fontsize=7)
        handles = [
            Patch(facecolor=colour, label=verdict.value) for verdict, colour in _COLOURS.items()
        ]
        figure.legend(handles=handles, loc="outside upper center", ncols=3)

    rows = [
        (setting.half_space, statement.key, finding)
        for setting in found
        for statement, finding in zip(LOOKED_AT, setting.findings, strict=True)
    ]
    default = HalfSpace()
    return Drawing(
        caption="For each statement, from above: exact over k; two-pole over k and Q; two-pole over k and "
        f"ω₀√(BL)/v_s. Circles: the defaults, k = {default.area_factor:g}, Q = {default.quality_factor:g}, "
        f"{default.frequency_factor:g}. From coarser maps than those of docs/validation.md. Statements are named by "
        "(G in MPa, p in mm) and amplitude.",
        table={
            "half_space": np.array([half_space.model for half_space, _, _ in rows]),
            "k": np.array([half_space.area_factor for half_space, _, _ in rows]),
            "Q": _of_two_pole([half_space.quality_factor for half_space, _, _ in rows], rows),
            "omega0_factor": _of_two_pole(
                [half_space.frequency_factor for half_space, _, _ in rows], rows
            ),
            "statement": np.array([key for _, key, _ in rows]),
            "verdict": np.array([finding.verdict.value for _, _, finding in rows]),
            "finding": np.array([finding.text for _, _, finding in rows]),
        },
        paint=paint,
        size_inches=(7.4, 7.6),
    )


def _of_two_pole(
    values: Sequence[float], rows: Sequence[tuple[HalfSpace, str, object]]
) -> NDArray[np.float64]:
    exact = np.array([half_space.model == "exact" for half_space, _, _ in rows])
    return np.where(exact, np.nan, values)


def _paint_statement(
    panels: list[Axes], found: list[Setting], number: int, *, labelled: bool
) -> None:
    default = HalfSpace()
    parts: tuple[tuple[str, str, Value, Value], ...] = (
        ("exact", "", lambda _: 0.0, lambda _: 0.0),
        ("two-pole", "Q", lambda one: one.quality_factor, lambda one: one.frequency_factor),
        (
            "two-pole",
            "ω₀√(BL)/v_s",
            lambda one: one.frequency_factor,
            lambda one: one.quality_factor,
        ),
    )
    for axes, (model, label, of, other) in zip(panels, parts, strict=True):
        shown = [
            setting
            for setting in found
            if setting.half_space.model == model
            and other(setting.half_space) in (0.0, other(default))
        ]
        across = sorted({setting.half_space.area_factor for setting in shown})
        up = sorted({of(setting.half_space) for setting in shown})
        verdicts = np.full((len(up), len(across)), np.nan)
        for setting in shown:
            place = up.index(of(setting.half_space)), across.index(setting.half_space.area_factor)
            verdicts[place] = _ORDER.index(setting.findings[number].verdict)
        axes.pcolormesh(
            verdicts, cmap=ListedColormap(list(_COLOURS.values())),
            norm=BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3), edgecolors="white", linewidth=0.5,
        )  # fmt: skip
        if default.area_factor in across and of(default) in up:
            axes.plot(
                across.index(default.area_factor) + 0.5, up.index(of(default)) + 0.5, "o",
                color="black", markersize=3, markerfacecolor="none", markeredgewidth=0.8,
            )  # fmt: skip
        axes.set_xticks([])
        axes.set_yticks([])
        if labelled:
            axes.set_ylabel(label or "exact", rotation=90 if label else 0, ha="center" if label else "right",
                            va="bottom" if label else "center")  # fmt: skip
            if label:
                axes.set_yticks(
                    np.arange(len(up)) + 0.5, [f"{value:g}" for value in up], fontsize=5.5
                )
        if axes is panels[-1]:
            axes.set_xticks(
                np.arange(len(across)) + 0.5,
                [f"{value:g}" for value in across],
                fontsize=5.5,
                rotation=90,
            )
            axes.set_xlabel("k")
        axes.tick_params(length=0)
