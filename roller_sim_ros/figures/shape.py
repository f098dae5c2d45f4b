# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 6: displacement of a rectangle against that of a square of the same area and load."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing
from roller_sim_ros.figures.style import BLUE, GREY
from roller_sim_ros.validation.half_spaces import over_square
from roller_sim_ros.validation.study import SOFT, STIFF, Study, aspect_ratio


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    ratio = np.linspace(1.0, 50.0, 197)
    relation = over_square(ratio)
    strips = {ground: aspect_ratio(study.on(ground)) for ground in (SOFT, STIFF)}

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.plot(ratio, relation, color=BLUE)
        for (modulus, _), alpha in strips.items():
            at = float(over_square(alpha))
            axes.plot([alpha], [at], "o", color=BLUE, markersize=4)
            axes.annotate(
                f"{modulus / 1e6:g} MPa",
                (alpha, at),
                (6, 6),
                textcoords="offset points",
                color=GREY,
            )
        axes.set_xlim(0.0, 50.0)
        axes.set_ylim(0.0, 1.05)
        axes.set_xlabel("length over width of the loaded area, α = L/B")
        axes.set_ylabel("displacement over that of the square")

    return Drawing(
        caption="At the centre, load and area held constant, the stress parabolic along the short axis. Points: "
        f"the strips under the roller on the grounds of Figure 15 with k = {study.base.half_space.area_factor:g}.",
        table={"alpha": ratio, "displacement_over_square": relation},
        paint=paint,
        size_inches=(4.6, 3.4),
    )
