# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 10: vertical against horizontal drum acceleration."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import (
    Drawing,
    ground_text,
    half_space_text,
    machine_text,
    stacked,
)
from roller_sim_ros.figures.style import BLUE, GREY, panel_titles
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.validation.study import SOFT, STIFF, Study, motion

_REVOLUTIONS = 4


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    parts = {}
    for ground in (SOFT, STIFF):
        configuration = study.on(ground)
        tail = motion(configuration)
        samples = tail.samples_per_revolution
        phase = 2.0 * math.pi * np.arange(_REVOLUTIONS * samples) / samples
        exciter = configuration.exciter
        # Eq. (12): the horizontal motion is the exciter's alone.
        sideways = exciter.amplitude_m * (2.0 * math.pi * exciter.frequency_hz) ** 2 * np.cos(phase)
        parts[ground_text(ground)] = {
            "horizontal_g": sideways / GRAVITY_M_S2,
            "vertical_g": tail.vertical[-len(phase) :] / GRAVITY_M_S2,
        }

    def paint(figure: Figure) -> None:
        panels = figure.subplots(1, 2, sharey=True)
        for axes, curves in zip(panels, parts.values(), strict=True):
            axes.plot(curves["horizontal_g"], curves["vertical_g"], color=BLUE)
            axes.axhline(0.0, color=GREY, linewidth=0.4)
            axes.axvline(0.0, color=GREY, linewidth=0.4)
            axes.set_aspect("equal")
            axes.set_xlim(-8.5, 8.5)
            axes.set_ylim(-8.5, 14.5)
            axes.set_xlabel("horizontal acceleration, g")
        panels[0].set_ylabel("vertical acceleration, g")
        panel_titles(panels, list(parts))

    exciter = study.base.exciter
    return Drawing(
        caption=f"f = {exciter.frequency_hz:g} Hz, A = {exciter.amplitude_m * 1e3:g} mm, {_REVOLUTIONS} revolutions "
        f"in settled motion; time is the parameter. {half_space_text(study.base)}; {machine_text(study.base)}.",
        table=stacked("ground", parts),
        paint=paint,
        size_inches=(5.4, 4.6),
    )
