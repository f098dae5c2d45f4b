# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 16: regions of mode over frequency and amplitude."""

from __future__ import annotations

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from roller_sim_ros.figures.drawing import Drawing, ground_text, half_space_text, machine_text
from roller_sim_ros.figures.style import (
    paint_plane_axes,
    paint_regions,
    region_patches,
    regions,
)
from roller_sim_ros.validation.planes import resonance
from roller_sim_ros.validation.study import STIFF, Study, flattened, plane


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    found = plane(study)
    number = regions(found["mode"].values, found.period.values)
    resonant = resonance(found)

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        frequency, amplitude = paint_plane_axes(axes, found)
        paint_regions(axes, frequency, amplitude, number)
        axes.plot(resonant, amplitude, color="black", linestyle=(0, (4, 2)), linewidth=1.0)
        line = Line2D([], [], color="black", linestyle=(0, (4, 2)), label="drum/soil resonance")
        figure.legend(
            handles=[*region_patches(number), line],
            loc="outside upper center",
            ncols=4,
            handlelength=1.4,
        )

    return Drawing(
        caption=f"{ground_text(STIFF)}; each point from rest over {study.revolutions} revolutions. Numbers: "
        "revolutions after which the motion repeats. Resonance: the drum lags 90° behind the eccentric. "
        f"{half_space_text(study.base)}; {machine_text(study.base)}.",
        table=flattened(
            found, {"period": "period_revolutions", "mode": "mode", "air_fraction": "air_fraction"}
        ),
        paint=paint,
        size_inches=(5.8, 4.6),
    )
