# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 17: drum displacement against soil force, as from a plate load test."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import (
    Drawing,
    ground_text,
    half_space_text,
    machine_text,
    stacked,
)
from roller_sim_ros.figures.style import BLUE, Array, panel_titles
from roller_sim_ros.meters.period import period
from roller_sim_ros.offline.run import Tail
from roller_sim_ros.validation.study import EXAMPLES_PA, Study, covarying, motion

_SHOWN_WITHOUT_PERIOD = 4
"""Revolutions."""


def one_period(tail: Tail) -> tuple[Array, Array]:
    """Return soil force, N, and height, m, over one period, from a least force to the next."""
    samples = tail.samples_per_revolution
    count = (period(tail.vertical, samples) or _SHOWN_WITHOUT_PERIOD) * samples
    first = int(np.argmin(tail.soil_force[:count]))
    landings = np.flatnonzero((tail.soil_force[:-1] == 0.0) & (tail.soil_force[1:] > 0.0))
    if len(landings):
        first = int(landings[0])
    chosen = slice(first, first + count + 1)
    return tail.soil_force[chosen], tail.drum_height[chosen]


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    parts = {}
    static_load_n = study.base.machine.static_load_n
    for modulus in EXAMPLES_PA:
        ground = covarying(modulus)
        tail = motion(study.on(ground))
        force, height = one_period(tail)
        parts[ground_text(ground)] = {
            "soil_force_kN": force / 1e3,
            "displacement_mm": (height[0] - height) * 1e3,
        }

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 2, sharex=True)
        for axes, curves in zip(panels.flat, parts.values(), strict=True):
            axes.plot(curves["soil_force_kN"], curves["displacement_mm"], color=BLUE)
            axes.axvline(static_load_n / 1e3, color="black", linestyle=":", linewidth=0.9)
            # The flight is a line on the axis: room beside it.
            axes.set_xlim(-8.0, 400.0)
            axes.invert_yaxis()
            ratio = curves["soil_force_kN"].max() * 1e3 / static_load_n
            axes.text(
                0.97, 0.94, f"$F_{{max}}$ = {ratio:.1f} $F_{{stat}}$",
                transform=axes.transAxes, ha="right", va="top",
            )  # fmt: skip
        for axes in panels[1]:
            axes.set_xlabel("soil force, kN")
        for axes in panels[:, 0]:
            axes.set_ylabel("displacement, mm")
        panel_titles(list(panels.flat), list(parts))

    exciter = study.base.exciter
    return Drawing(
        caption=f"f = {exciter.frequency_hz:g} Hz, A = {exciter.amplitude_m * 1e3:g} mm, one "
        "period of the settled motion, p as in Figure 14; displacement down from where the contact begins. Dotted: the "
        f"static load, {static_load_n / 1e3:.1f} kN. {half_space_text(study.base)}; {machine_text(study.base)}.",
        table=stacked("ground", parts),
        paint=paint,
        size_inches=(6.2, 5.0),
    )
