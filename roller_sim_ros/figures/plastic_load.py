# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 2: what the plastic layer bears under a cylinder, and the plastic parameter p."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, ground_text, machine_text
from roller_sim_ros.figures.style import BLUE, GREY, ORANGE
from roller_sim_ros.validation.ground import circle_over_parabola
from roller_sim_ros.validation.study import SOFT, Study

_DEEPEST = 1.4
"""Of the settlement drawn, over p."""


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    plastic_m = SOFT[1]
    machine = study.base.machine
    settlement = np.linspace(0.0, _DEEPEST, 141)
    line = settlement.copy()
    circle = line * circle_over_parabola(settlement * plastic_m, machine.drum_radius_m)
    cycle = np.where(settlement <= 1.0, settlement, np.nan)

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.plot(
            settlement, line, color=GREY, linestyle="--", label="failure load, eqs (1) and (2)"
        )
        axes.plot([0, 1], [0, 1], color=BLUE, linewidth=2.0, label="loading, eq. (13)")
        axes.plot(
            [1, 1], [1, 0], color=ORANGE, linewidth=2.0, label="unloading: the layer is rigid"
        )
        axes.plot([0, 1], [1, 1], ":", color="black", linewidth=0.8)
        for at, angle in (((0.55, 0.55), (0.6, 0.6)), ((1.0, 0.55), (1.0, 0.45))):
            axes.annotate("", angle, at, arrowprops={"arrowstyle": "-|>", "color": "black"})
        axes.annotate("$p$", (1.0, 0.0), (1.04, 0.06))
        axes.set_xlim(0.0, _DEEPEST)
        axes.set_ylim(0.0, _DEEPEST)
        axes.set_xlabel("settlement over $p$")
        axes.set_ylabel("load over the static load $F_{stat}$")
        axes.legend(loc="upper left")

    return Drawing(
        caption="The failure load goes with the width squared, and the width of a parabola with the root of its "
        "depth: their relation is linear, and p is the settlement under the static load. A circle in place of the "
        f"parabola bears {1e2 * (1.0 - circle[100] / line[100]):.2g} % less at p ({ground_text(SOFT)}; "
        f"{machine_text(study.base)}).",
        table={
            "settlement_over_p": settlement,
            "load_over_static": line,
            "load_over_static_circle": circle,
            "loading_load_over_static": cycle,
        },
        paint=paint,
        size_inches=(4.6, 3.8),
    )
