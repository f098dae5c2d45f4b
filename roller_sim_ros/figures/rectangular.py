# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 8: compliance functions of a rectangular area, and their 2-pole and 4-pole approximations."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roller_sim_ros.figures.drawing import Drawing, stacked
from roller_sim_ros.figures.style import BLUE, GREY, ORANGE, panel_titles
from roller_sim_ros.half_space import normalised_compliance, rational_half_space
from roller_sim_ros.validation.half_spaces import POISSON_RATIO, fitted_two_pole, two_pole
from roller_sim_ros.validation.study import STIFF, Study, aspect_ratio

_HIGHEST_A0 = 2.0


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    chosen = study.base.half_space
    quality, factor = fitted_two_pole(1.0)
    a0 = np.linspace(0.0, _HIGHEST_A0, 201)
    strip = aspect_ratio(study.on(STIFF))
    used = two_pole(a0, chosen.quality_factor, chosen.frequency_factor)
    parts = {}
    for alpha in (1.0, strip):
        fit = rational_half_space(alpha, POISSON_RATIO, 4, _HIGHEST_A0)
        parts[f"{alpha:.4g}"] = {
            "exact": normalised_compliance(a0, alpha, POISSON_RATIO),
            "4_pole": fit.compliance(a0),
            "2_pole_fitted_to_the_square": two_pole(a0, quality, factor),
            "2_pole_as_used": used,
        }

    def paint(figure: Figure) -> None:
        panels = figure.subplots(1, 2, sharey=True)
        for axes, curves in zip(panels, parts.values(), strict=True):
            points = slice(None, None, 10)
            for part, sign, marker in (("real", 1.0, "o"), ("imag", -1.0, "s")):
                name = "$f_1$" if part == "real" else "$-f_2$"

                def of(
                    values: NDArray[np.complex128], part: str = part, sign: float = sign
                ) -> object:
                    return sign * getattr(values, part)

                axes.plot(
                    a0[points], of(curves["exact"][points]), marker, color="black", markersize=3,
                    markerfacecolor="white", label=f"{name}, exact",
                )  # fmt: skip
                style = "-" if part == "real" else "--"
                axes.plot(a0, of(curves["4_pole"]), style, color=BLUE, label=f"{name}, 4-pole")
                fitted = curves["2_pole_fitted_to_the_square"]
                axes.plot(
                    a0, of(fitted), style, color=ORANGE, label=f"{name}, 2-pole, Q = {quality:.2f}"
                )
                axes.plot(
                    a0,
                    of(used),
                    style,
                    color=GREY,
                    label=f"{name}, 2-pole, Q = {chosen.quality_factor:g}",
                )
            axes.axhline(0.0, color=GREY, linewidth=0.4)
            axes.set_xlim(0.0, _HIGHEST_A0)
            axes.set_xlabel("$a_0 = \\omega\\sqrt{BL} / v_s$")
        panels[0].set_ylim(-0.25, 1.25)
        panels[0].set_ylabel("compliance $H / H_0$")
        panel_titles(panels, ["square", f"strip, L/B = {strip:.3g}"])
        figure.legend(
            *panels[0].get_legend_handles_labels(),
            loc="outside upper center",
            ncols=4,
            columnspacing=1.2,
        )

    table = stacked(
        "alpha",
        {
            alpha: {"a0": a0}
            | {f"{part}_{name}": (values.real if part == "f1" else -values.imag)
               for name, values in curves.items() for part in ("f1", "minus_f2")}
            for alpha, curves in parts.items()
        },
    )  # fmt: skip
    return Drawing(
        caption="Stress parabolic along the short axis, constant along the long one, displacement of the centre, "
        f"ν = {POISSON_RATIO:g}. Points: exact, in place of the tables of Elorduy et al., which the paper had. 2-pole: "
        f"fitted to the square (Q = {quality:.2f}, ω₀√(BL)/v_s = {factor:.2f}) and as the model uses it "
        f"(Q = {chosen.quality_factor:g}, {chosen.frequency_factor:g}), where the paper takes the strip for a square "
        "of its area. (b) the strip on the ground of Figure 16.",
        table=table,
        paint=paint,
        size_inches=(6.8, 3.8),
    )
