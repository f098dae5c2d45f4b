# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Panels that the plots of a bag and of a run have in common, as in a paper's figure."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.registry import ORDERS, evaluate
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.session.block import AIR

HIGHEST_ORDER = 6.0

BLUE, ORANGE, GREY, LIGHT = "#1f5a94", "#c8591a", "#6b6b6b", "#dfe6ee"
STYLE: dict[Any, Any] = {
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.titlelocation": "left",
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 0.9,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 7.0,
}


@contextmanager
def drawn_figure(path: Path) -> Iterator[Figure]:
    """Yield an empty figure and save it; the file's ending chooses the format (png, pdf, svg).

    Raises
    ------
    RollerSimError
        If the file cannot be written or the format is none that there is.
    """
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(7.2, 5.2), dpi=200, layout="constrained")
        FigureCanvasAgg(figure)
        yield figure
        try:
            figure.savefig(path)
        except OSError as error:
            raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
        except ValueError as error:
            raise RollerSimError(f"{path}: cannot be drawn: {error}") from None


def draw_acceleration(
    axes: Axes,
    at: NDArray[np.floating],
    vertical: NDArray[np.floating],
    contact_state: NDArray[np.uint8] | None,
) -> None:
    """Draw the vertical coordinate acceleration, m/s², over the given abscissa, flights shaded."""
    axes.plot(at, vertical / GRAVITY_M_S2, color=BLUE)
    if contact_state is not None:
        axes.fill_between(
            at,
            0,
            1,
            where=list(contact_state == AIR),
            transform=axes.get_xaxis_transform(),
            color=LIGHT,
            linewidth=0,
            zorder=0,
        )
    axes.axhline(0.0, color=GREY, linewidth=0.4)
    axes.set_xlim(at[0], at[-1] + (at[-1] - at[-2]))
    axes.set_ylabel("acceleration, g, up positive")


def draw_spectrum(axes: Axes, vertical: NDArray[np.floating], samples_per_revolution: int) -> None:
    """Draw the amplitudes of the vertical acceleration, m/s², of an even number of whole revolutions."""
    harmonics = order_amplitudes(vertical, ORDERS, samples_per_revolution)
    if harmonics.amplitude(1.0) == 0.0:
        say_nothing(axes, "no vibration")
        return
    revolutions = len(vertical) // samples_per_revolution
    amplitudes = 2.0 * np.abs(np.fft.rfft(vertical)) / len(vertical)
    orders = np.arange(len(amplitudes)) / revolutions
    shown = (orders > 0.0) & (orders <= HIGHEST_ORDER)
    floor = max(float(amplitudes[shown].max()) * 1e-4, 1e-9)
    axes.vlines(orders[shown], floor, np.maximum(amplitudes[shown], floor), BLUE, linewidth=0.9)
    for order in ORDERS:
        height = harmonics.amplitude(order)
        if height > 2.0 * floor:
            axes.plot([order], [height], "o", color=ORANGE, markersize=3)
    values = ", ".join(f"{name.upper()} {value:.1f}" for name, value in evaluate(harmonics).items())
    axes.text(0.98, 0.96, values, transform=axes.transAxes, ha="right", va="top")
    axes.set_yscale("log")
    axes.set_ylim(floor, float(amplitudes[shown].max()) * 3.0)
    axes.set_xlim(0, HIGHEST_ORDER + 0.25)
    axes.set_xlabel(f"order (DFT of {revolutions} revolutions)")
    axes.set_ylabel("amplitude, m/s²")


def draw_force(
    axes: Axes, drum_height: NDArray[np.floating], soil_force: NDArray[np.floating]
) -> None:
    """Draw the soil force, N, against the drum's displacement, from its height in m."""
    blows = np.flatnonzero((soil_force[:-1] == 0.0) & (soil_force[1:] > 0.0))
    origin = drum_height[blows[0]] if len(blows) else drum_height.mean()
    axes.plot((origin - drum_height) * 1e3, soil_force * 1e-3, color=BLUE)
    # A little below zero, so that the flight shows beside the axis.
    axes.set_ylim(bottom=-0.03 * float(soil_force.max()) * 1e-3)
    zero = "the first contact" if len(blows) else "the mean"
    axes.set_xlabel(f"displacement, mm, down positive; 0 at {zero}")
    axes.set_ylabel("soil force, kN")


def say_nothing(axes: Axes, why: str) -> None:
    """Leave a panel empty and say why."""
    axes.text(0.5, 0.5, why, transform=axes.transAxes, ha="center", va="center", color=GREY)
    axes.set_xticks([])
    axes.set_yticks([])
