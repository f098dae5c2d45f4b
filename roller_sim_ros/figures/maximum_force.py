# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 18: greatest soil force over the static one, over frequency and amplitude."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, ground_text, half_space_text, machine_text
from roller_sim_ros.figures.style import paint_boundaries, paint_plane_axes, regions
from roller_sim_ros.validation.study import STIFF, Study, flattened, plane

_LEVELS = np.arange(1.0, 8.01, 0.5)


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    found = plane(study)
    number = regions(found["mode"].values, found.period.values)
    ratio = found.force_ratio_mean.values

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        frequency, amplitude = paint_plane_axes(axes, found)
        filled = axes.contourf(frequency, amplitude, ratio.T, _LEVELS, cmap="YlGnBu", extend="max")
        stable = np.ma.masked_where(number > 1, ratio)
        lines = axes.contour(
            frequency, amplitude, stable.T, _LEVELS[2::2], colors="0.25", linewidths=0.5
        )
        axes.clabel(lines, fmt="%g", fontsize=7)
        paint_boundaries(axes, frequency, amplitude, number)
        figure.colorbar(filled, ax=axes, ticks=np.arange(1, 9), label="$F_{s\\,max} / F_{stat}$")

    return Drawing(
        caption=f"{ground_text(STIFF)}; mean over the blows. Solid: beyond it the motion does not repeat every "
        "revolution (Figure 16); dotted: below it the drum never leaves the ground. "
        f"{half_space_text(study.base)}; {machine_text(study.base)}.",
        table=flattened(
            found, {"force_ratio_mean": "force_ratio_mean", "force_ratio_max": "force_ratio_max"}
        ),
        paint=paint,
        size_inches=(5.8, 4.4),
    )
