# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 20: CMV over frequency and amplitude."""

from __future__ import annotations

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, ground_text, half_space_text, machine_text
from roller_sim_ros.figures.style import paint_boundaries, paint_plane_axes, regions
from roller_sim_ros.validation.study import STIFF, Study, flattened, plane

_LEVELS = np.array([0, 10, 20, 30, 40, 50, 60, 70, 80, 100, 120, 150, 200])


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    found = plane(study)
    number = regions(found["mode"].values, found.period.values)
    cmv = found.cmv.values

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        frequency, amplitude = paint_plane_axes(axes, found)
        filled = axes.contourf(
            frequency, amplitude, cmv.T, _LEVELS, cmap="YlGnBu", extend="max",
            norm=BoundaryNorm(_LEVELS, 256, extend="max"),
        )  # fmt: skip
        stable = np.ma.masked_where(number > 1, cmv)
        lines = axes.contour(
            frequency,
            amplitude,
            stable.T,
            [20, 40, 60, 80, 120, 200],
            colors="0.25",
            linewidths=0.5,
        )
        axes.clabel(lines, fmt="%g", fontsize=7)
        paint_boundaries(axes, frequency, amplitude, number)
        figure.colorbar(filled, ax=axes, ticks=_LEVELS, label="CMV")

    return Drawing(
        caption=f"{ground_text(STIFF)}; constant ground. Solid: beyond it the motion does not repeat every revolution "
        "(Figure 16); dotted: below it the drum never leaves the ground. "
        f"{half_space_text(study.base)}; {machine_text(study.base)}.",
        table=flattened(found, {"cmv": "cmv", "rmv": "rmv"}),
        paint=paint,
        size_inches=(5.8, 4.4),
    )
