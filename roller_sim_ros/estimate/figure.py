# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plot of an estimate: the modelled acceleration on the measured one, and the ground over time."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from roller_sim_ros.analysis.panels import BLUE, GREY, ORANGE, drawn_figure, say_nothing
from roller_sim_ros.estimate.trace import TraceEstimate, WindowOfTrace
from roller_sim_ros.parameters import GRAVITY_M_S2


def write_figure(estimate: TraceEstimate, path: Path) -> None:
    """Draw the last window that stands, else the last one with values; the file's ending chooses the format.

    Raises
    ------
    RollerSimError
        If the file cannot be written or the format is none that there is.
    """
    shown = _shown(estimate.windows)
    with drawn_figure(path) as figure:
        panels = figure.subplot_mosaic([["acceleration"] * 2, ["modulus", "plastic"]])
        axes = panels["acceleration"]
        axes.set_title("(a) Vertical drum acceleration over one period, without its mean")
        if shown is None:
            say_nothing(axes, "no window has an estimate")
        else:
            found = shown.estimate
            turns = np.arange(len(found.measured)) / len(found.measured) * found.period
            axes.plot(turns, found.measured / GRAVITY_M_S2, color=GREY, label="measured")
            axes.plot(
                turns,
                found.modelled / GRAVITY_M_S2,
                color=BLUE,
                linestyle="--",
                label=f"modelled: G {found.shear_modulus_pa / 1e6:.4g} MPa, "
                f"p {found.plastic_parameter_m * 1e3:.3g} mm",
            )
            left = (found.modelled - found.measured) / GRAVITY_M_S2
            axes.plot(turns, left, color=ORANGE, label="modelled less measured")
            axes.set_xlabel(
                f"revolutions of the eccentric, from {shown.start_s:.2f} s; {found.status.label}"
            )
            axes.set_ylabel("g")
            axes.legend(loc="upper right")
        for name, title, scale, value, spread in (
            ("modulus", "(b) G, MPa", 1e-6, "shear_modulus_pa", "shear_modulus_spread_pa"),
            ("plastic", "(c) p, mm", 1e3, "plastic_parameter_m", "plastic_spread_m"),
        ):
            axes = panels[name]
            axes.set_title(f"{title}, ± its spread; grey: does not stand")
            top = 0.0
            for stands, colour in ((False, GREY), (True, BLUE)):
                windows = [
                    item
                    for item in estimate.windows
                    if item.estimate.status.stands is stands
                    and np.isfinite(getattr(item.estimate, spread))
                ]
                top = max([top, *(scale * getattr(item.estimate, value) for item in windows)])
                axes.errorbar(
                    [item.start_s for item in windows],
                    [scale * getattr(item.estimate, value) for item in windows],
                    [scale * getattr(item.estimate, spread) for item in windows],
                    fmt="o",
                    markersize=2.5,
                    linewidth=0.8,
                    color=colour,
                )
            axes.set_xlabel("time, s")
            axes.set_ylim(0.0, 1.25 * top or 1.0)


def _shown(windows: list[WindowOfTrace]) -> WindowOfTrace | None:
    with_values = [item for item in windows if len(item.estimate.modelled)]
    standing = [item for item in with_values if item.estimate.status.stands]
    chosen = standing or with_values
    return chosen[-1] if chosen else None
