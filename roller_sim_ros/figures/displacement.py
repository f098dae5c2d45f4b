# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 5: dimensionless static displacement D of the loaded rectangle's centre, eqs (5) and (6)."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing
from roller_sim_ros.figures.style import BLUE, ORANGE
from roller_sim_ros.validation.half_spaces import displacement
from roller_sim_ros.validation.study import Study


def drawing(study: Study) -> Drawing:  # noqa: ARG001
    """Return the drawing."""
    ratio = np.geomspace(1.0, 100.0, 201)
    exact = displacement(ratio, "exact")
    paper = displacement(ratio, "paper")

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.loglog(ratio, exact, color=BLUE, label="exact integral")
        axes.loglog(
            ratio[::10],
            paper[::10],
            "o",
            color=ORANGE,
            markersize=3,
            label="I(α) ≈ 0.66 ln(7.9 α), eq. (6)",
        )
        axes.set_xlim(1.0, 100.0)
        axes.set_ylim(0.01, 1.0)
        axes.grid(which="both", color="0.9", linewidth=0.4)
        axes.set_xlabel("length over width of the loaded area, α = L/B")
        axes.set_ylabel("D = δ G B / (Q (1 − ν))")
        axes.legend(loc="upper right")

    return Drawing(
        caption="D is the static displacement of the centre; the stress is parabolic across the area and constant "
        "along it.",
        table={"alpha": ratio, "D": exact, "D_of_equation_6": paper},
        paint=paint,
        size_inches=(4.6, 3.6),
    )
