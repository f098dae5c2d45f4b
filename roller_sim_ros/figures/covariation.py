# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 14: how p goes with G, as assumed, and what soil mechanics makes of grounds by name."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, machine_text, stacked
from roller_sim_ros.figures.style import BLUE, GREY, ORANGE
from roller_sim_ros.parameters import covarying_plastic_parameter
from roller_sim_ros.validation.ground import granular_presets
from roller_sim_ros.validation.study import SOFT, STIFF, Study

_HIGHEST_MM = 2.5


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    modulus = np.linspace(10e6, 130e6, 241)
    plastic = np.array([covarying_plastic_parameter(float(value)) for value in modulus])
    presets = granular_presets(study.base.machine)

    beyond = "".join(
        f"; {name}, {found[0] / 1e6:.0f} MPa and {found[1] * 1e3:.1f} mm, lies beyond"
        for name, found in presets.items()
        if found[1] * 1e3 > _HIGHEST_MM
    )

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        axes.plot(
            modulus / 1e6, plastic * 1e3, color=BLUE, label="assumed: the power law through the two"
        )
        points = np.array([SOFT, STIFF])
        axes.plot(
            points[:, 0] / 1e6, points[:, 1] * 1e3, "o", color=BLUE, label="the paper's two grounds"
        )
        of_presets = np.array(list(presets.values()))
        axes.plot(
            of_presets[:, 0] / 1e6, of_presets[:, 1] * 1e3, "^", color=ORANGE,
            label="gravels by soil mechanics, eqs (1) to (4)",
        )  # fmt: skip
        for name, (preset_modulus, preset_plastic) in presets.items():
            if preset_plastic * 1e3 > _HIGHEST_MM:
                continue
            axes.annotate(
                name, (preset_modulus / 1e6, preset_plastic * 1e3), (6, 4),
                textcoords="offset points", fontsize=6.5, color=GREY,
            )  # fmt: skip
        axes.set_xlim(0.0, 130.0)
        axes.set_ylim(0.0, _HIGHEST_MM)
        axes.set_xlabel("shear modulus $G$, MPa")
        axes.set_ylabel("plastic parameter $p$, mm")
        axes.legend(loc="upper right")

    table = stacked(
        "what",
        {
            "assumed": {"G_MPa": modulus / 1e6, "p_mm": plastic * 1e3},
            **{
                name: {"G_MPa": np.array([found[0] / 1e6]), "p_mm": np.array([found[1] * 1e3])}
                for name, found in presets.items()
            },
        },
    )
    return Drawing(
        caption="The paper's curve is lost; its text gives (35 MPa, 0.8 mm) and (80 MPa, 0.5 mm): "
        "p = 0.8 mm (G/35 MPa)^−0.5686. Triangles: gravels by name under the same roller, not fitted to it "
        f"({machine_text(study.base)}){beyond}.",
        table=table,
        paint=paint,
        size_inches=(5.0, 3.7),
    )
