# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 15: vertical drum acceleration on the paper's two grounds."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.analysis.panels import draw_acceleration
from roller_sim_ros.figures.drawing import (
    Drawing,
    ground_text,
    half_space_text,
    machine_text,
    stacked,
)
from roller_sim_ros.figures.style import panel_titles
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.validation.study import SOFT, STIFF, Study, motion

_REVOLUTIONS = 6


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    motions, parts = [], {}
    for ground in (SOFT, STIFF):
        tail = motion(study.on(ground))
        count = _REVOLUTIONS * tail.samples_per_revolution
        step = 1.0 / (study.base.exciter.frequency_hz * tail.samples_per_revolution)
        shown = np.arange(count) * step, tail.vertical[-count:], tail.contact_state[-count:]
        motions.append(shown)
        parts[ground_text(ground)] = {
            "time_s": shown[0],
            "vertical_g": shown[1] / GRAVITY_M_S2,
            "contact_state": shown[2],
        }

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 1, sharex=True, sharey=True)
        for axes, shown in zip(panels, motions, strict=True):
            draw_acceleration(axes, *shown)
            axes.set_ylim(-9.0, 14.5)
            axes.set_ylabel("acceleration, g")
        panels[1].set_xlabel("time, s")
        panel_titles(panels, list(parts))

    exciter = study.base.exciter
    return Drawing(
        caption=f"f = {exciter.frequency_hz:g} Hz, A = {exciter.amplitude_m * 1e3:g} mm; up is positive, shaded: the "
        f"drum is in the air. {half_space_text(study.base)}; {machine_text(study.base)}.",
        table=stacked("ground", parts),
        paint=paint,
        size_inches=(5.8, 4.6),
    )
