# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 7: Sung's compliance functions of circular loads, and their effective radii."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, stacked
from roller_sim_ros.figures.style import BLUE, GREEN, GREY, ORANGE, panel_titles
from roller_sim_ros.half_space import sung_functions
from roller_sim_ros.validation.half_spaces import EFFECTIVE_RADII, POISSON_RATIO
from roller_sim_ros.validation.study import Study

_COLOURS = {"parabolic": ORANGE, "uniform": BLUE, "rigid": GREEN}


def drawing(study: Study) -> Drawing:  # noqa: ARG001
    """Return the drawing."""
    a0 = np.linspace(0.0, 1.5, 151)
    functions = {load: sung_functions(a0, POISSON_RATIO, load) for load in _COLOURS}

    def paint(figure: Figure) -> None:
        panels = figure.subplots(1, 2, sharey=True)
        for load, values in functions.items():
            radius = EFFECTIVE_RADII[load]
            for axes, scale in ((panels[0], 1.0), (panels[1], radius)):
                axes.plot(
                    a0 * scale, values.real * scale, color=_COLOURS[load], label=f"{load}, $f_1$"
                )
                axes.plot(
                    a0 * scale,
                    -values.imag * scale,
                    "--",
                    color=_COLOURS[load],
                    label=f"{load}, $-f_2$",
                )
        panel_titles(panels, ["as they are", "with their effective radii"])
        panels[0].set_ylabel("compliance $G\\,r_0\\,H$")
        panels[0].set_xlabel("$a_0 = r_0\\,\\omega / v_s$")
        panels[1].set_xlabel("$a_0 = r_e\\,\\omega / v_s$; compliance over $r_0 / r_e$")
        panels[0].legend(ncols=3, loc="upper right", columnspacing=0.8, handlelength=1.6)
        for axes in panels:
            axes.axhline(0.0, color=GREY, linewidth=0.4)
            axes.set_xlim(0.0, 1.5)
        panels[0].set_ylim(-0.02, 0.46)

    table = stacked(
        "load",
        {
            load: {"a0": a0, "f1": values.real, "minus_f2": -values.imag}
            for load, values in functions.items()
        },
    )
    radii = ", ".join(f"{load} {radius:.4g} r₀" for load, radius in EFFECTIVE_RADII.items())
    return Drawing(
        caption=f"ν = {POISSON_RATIO:g}, displacement of the centre, exp(+iωt): f₂ is negative. Effective radii of "
        f"the loads: {radii}; with them the curves nearly collapse.",
        table=table,
        paint=paint,
        size_inches=(6.6, 3.3),
    )
