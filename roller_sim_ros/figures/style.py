# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How the figures look, and what several of them paint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch
from numpy.typing import NDArray

from roller_sim_ros.analysis.figure import MODE_COLOURS
from roller_sim_ros.analysis.panels import BLUE, GREY, LIGHT, ORANGE, STYLE
from roller_sim_ros.meters import Mode

__all__ = ["BLUE", "GREEN", "GREY", "LIGHT", "ORANGE", "PAPER"]

GREEN = "#3f8f5b"

PAPER: dict[Any, Any] = {
    **STYLE,
    "axes.spines.top": True,
    "axes.spines.right": True,
    "xtick.top": True,
    "ytick.right": True,
    "lines.linewidth": 1.1,
    "svg.hashsalt": "roller_sim_ros",
    "hatch.linewidth": 0.5,
}
"""A frame all around with ticks inside, as in a paper."""

Array = NDArray[np.float64]

REGIONS: tuple[tuple[str, str], ...] = (
    ("continuous contact", MODE_COLOURS[Mode.CONTINUOUS_CONTACT]),
    ("partial uplift (period 1)", MODE_COLOURS[Mode.PARTIAL_UPLIFT]),
    ("double jump (2)", MODE_COLOURS[Mode.DOUBLE_JUMP]),
    ("quad jump (4)", MODE_COLOURS[Mode.QUAD_JUMP]),
    ("period 8", "#9a4a7c"),
    ("chaotic (none)", MODE_COLOURS[Mode.CHAOTIC]),
)
"""Names and colours of the regions of mode, by their number."""


def regions(mode: NDArray[Any], period: NDArray[Any]) -> NDArray[np.int64]:
    """Return the number of the region for each point, from the mode and the period of a sweep."""
    found = np.full(np.shape(mode), len(REGIONS) - 1)
    found[mode == Mode.CONTINUOUS_CONTACT] = 0
    for number, revolutions in ((1, 1), (2, 2), (3, 4), (4, 8)):
        found[(mode != Mode.CONTINUOUS_CONTACT) & (period == revolutions)] = number
    return found


def paint_regions(axes: Axes, x: Array, y: Array, number: NDArray[np.int64]) -> None:
    """Fill the regions; `number` has the shape (len(x), len(y))."""
    axes.pcolormesh(
        x,
        y,
        number.T,
        cmap=ListedColormap([colour for _, colour in REGIONS]),
        norm=BoundaryNorm(np.arange(len(REGIONS) + 1) - 0.5, len(REGIONS)),
        shading="nearest",
        rasterized=True,
    )


def region_patches(number: NDArray[np.int64]) -> list[Patch]:
    """Return a legend's entry for each region that occurs."""
    return [
        Patch(facecolor=colour, label=label)
        for place, (label, colour) in enumerate(REGIONS)
        if (number == place).any()
    ]


def paint_plane_axes(axes: Axes, plane: xarray.Dataset) -> tuple[Array, Array]:
    """Label the plane of Figures 16, 18 and 20 and return its frequencies in Hz and amplitudes in mm."""
    frequency = plane.frequency_hz.values
    amplitude = plane.amplitude_m.values * 1e3
    axes.set_xlim(frequency[0], frequency[-1])
    axes.set_ylim(amplitude[0], amplitude[-1])
    axes.set_xticks(np.arange(15.0, 41.0, 5.0))
    axes.set_yticks(np.arange(0.5, 2.6, 0.5))
    axes.set_xlabel("excitation frequency $f$, Hz")
    axes.set_ylabel("nominal amplitude $A$, mm")
    return frequency, amplitude


def paint_boundaries(
    axes: Axes, frequency: Array, amplitude: Array, number: NDArray[np.int64]
) -> None:
    """Draw where contact is first lost (dotted) and where the motion stops repeating every revolution."""
    for level, style in ((0.5, ":"), (1.5, "-")):
        if (number < level).any() and (number > level).any():
            axes.contour(
                frequency, amplitude, number.T, levels=[level], colors="black",
                linewidths=0.8, linestyles=style,
            )  # fmt: skip


def panel_titles(panels: Sequence[Axes], titles: Sequence[str]) -> None:
    """Title panels, each with its letter."""
    for letter, axes, title in zip("abcdefghij", panels, titles, strict=False):
        axes.set_title(f"({letter}) {title}")
