# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Figure 19: CMV against G at two amplitudes."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roller_sim_ros.figures.drawing import Drawing, half_space_text, machine_text, stacked
from roller_sim_ros.figures.style import BLUE, ORANGE, regions
from roller_sim_ros.validation.study import HIGH_M, LOW_M, Study, cmv_curves


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    modulus, values = cmv_curves(study)
    number = regions(values["mode"], values["period"])

    def paint(figure: Figure) -> None:
        axes = figure.subplots()
        for row, (amplitude, colour) in enumerate(((LOW_M, BLUE), (HIGH_M, ORANGE))):
            cmv = values["cmv"][row]
            for jumps in (False, True):
                chosen = (number[row] > 1) == jumps
                if not chosen.any():
                    continue
                # A line ends where the mode changes.
                shown = np.where(chosen, cmv, np.nan)
                what = ", period 2 and more" if jumps else ""
                axes.plot(
                    modulus / 1e6, shown, "-" if not jumps else "o-", color=colour, markersize=2.2,
                    linewidth=1.1 if not jumps else 0.6, label=f"A = {amplitude * 1e3:g} mm{what}",
                )  # fmt: skip
        axes.set_xlim(0.0, 125.0)
        axes.set_ylim(0.0, 120.0)
        axes.set_xlabel("shear modulus $G$, MPa")
        axes.set_ylabel("CMV")
        axes.legend(loc="upper left")

    parts = {
        f"{amplitude * 1e3:g}": {
            "G_MPa": modulus / 1e6,
            "cmv": values["cmv"][row],
            "rmv": values["rmv"][row],
            "period_revolutions": values["period"][row],
        }
        for row, amplitude in enumerate((LOW_M, HIGH_M))
    }
    return Drawing(
        caption=f"f = {study.base.exciter.frequency_hz:g} Hz, p going with G as in Figure 14, each point from "
        f"rest over {study.revolutions} revolutions. The paper does not name its lower amplitude. "
        f"{half_space_text(study.base)}; {machine_text(study.base)}.",
        table=stacked("amplitude_mm", parts),
        paint=paint,
        size_inches=(5.4, 3.9),
    )
