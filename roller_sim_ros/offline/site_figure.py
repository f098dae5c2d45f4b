# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The map of a run as a figure: true G, p, CMV and mode by chainage and pass."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from roller_sim_ros.analysis.figure import MODE_COLOURS
from roller_sim_ros.analysis.panels import GREY, drawn_figure
from roller_sim_ros.meters import Mode
from roller_sim_ros.scenario import Scenario, SiteMap

Array = NDArray[np.float64]

MOST_LINES = 3
"""Passes that are drawn as lines; more of them as maps."""
COLUMNS = 240
"""Places along the lane of a map."""
GROUND, METER = "YlGnBu", "magma_r"

_CMAP = ListedColormap([MODE_COLOURS[mode] for mode in Mode])
_NORM = BoundaryNorm(np.arange(len(Mode) + 1) - 0.5, len(Mode))
# On changing ground a motion may not repeat for no other reason than that.
_LABELS = {Mode.CHAOTIC: "chaotic or changing"}


def write_figure(scenario: Scenario, site_map: SiteMap, path: Path) -> None:
    """Draw the map; the file's ending chooses the format (png, pdf, svg).

    Raises
    ------
    RollerSimError
        If the file cannot be written or the format is none that there is.
    """
    with drawn_figure(path) as figure:
        passes = [int(number) for number in np.unique(site_map.pass_number)]
        stands = scenario.travel.speed_m_s == 0.0 and np.ptp(site_map.chainage_m) == 0.0
        at, middle, along = _abscissa(site_map, stands=stands)
        panels = figure.subplot_mosaic([["first", "second"], ["CMV", "mode"]], sharex=True)
        figure.suptitle(_subtitle(scenario, site_map), fontsize=8.0, color=GREY)
        if stands:
            # The ground is one place: what changes is what the exciter does.
            pair = (
                ("(a) Amplitude of the exciter, mm", at, site_map.amplitude_m * 1e3),
                ("(b) True F_max/F_stat", middle, site_map.force_ratio_max),
            )
        else:
            pair = (
                ("(a) True shear modulus G, MPa", at, site_map.shear_modulus_pa * 1e-6),
                ("(b) True plastic parameter p, mm", at, site_map.plastic_parameter_m * 1e3),
            )
        quantities = (
            ("first", *pair[0], GROUND),
            ("second", *pair[1], GROUND),
            ("CMV", "(c) True CMV, at the middle of its window", middle, site_map.cmv, METER),
        )
        for name, title, where, values, colours in quantities:
            panels[name].set_title(title)
            if len(passes) <= MOST_LINES:
                _draw_lines(panels[name], site_map, where, values, passes)
            else:
                _draw_map(figure, panels[name], site_map, where, values, passes, colours)
        if len(passes) <= MOST_LINES:
            panels["mode"].set_title("(d) True RMV, and operating mode as a band")
            _draw_lines(panels["mode"], site_map, middle, site_map.rmv, passes)
            if len(passes) > 1:
                panels["first"].legend(loc="lower right", ncols=len(passes), handlelength=1.2)
            modes = _draw_mode_bands(panels["mode"], site_map, middle, passes)
        else:
            panels["mode"].set_title("(d) Operating mode")
            modes = _draw_mode_map(panels["mode"], site_map, middle, passes)
        figure.legend(
            handles=[
                Patch(color=MODE_COLOURS[mode], label=_LABELS.get(mode, mode.label))
                for mode in modes
            ],
            loc="outside lower center",
            ncols=len(modes),
            handlelength=1.2,
        )
        for name in ("CMV", "mode"):
            panels[name].set_xlabel(along)
        edges = (float(at.min()), float(at.max())) if len(at) else (0.0, 1.0)
        if edges[0] < edges[1]:
            panels["first"].set_xlim(edges)


def _abscissa(site_map: SiteMap, *, stands: bool) -> tuple[Array, Array, str]:
    """Return what the ground and what the meters are drawn over, and its label."""
    if not stands:
        return site_map.chainage_m, site_map.window_middle_m, "chainage, m"
    back = np.maximum(np.arange(len(site_map)) - site_map.window_revolutions // 2, 0)
    return site_map.time_s, site_map.time_s[back], "time, s"


def _subtitle(scenario: Scenario, site_map: SiteMap) -> str:
    frequencies, amplitudes = site_map.frequency_hz, site_map.amplitude_m * 1e3
    parts = [
        scenario.title or Path(scenario.path).stem,
        f"{_span(frequencies[frequencies > 0.0], 'Hz')}, {_span(amplitudes, 'mm')}",
        f"{scenario.travel.speed_m_s:g} m/s" if scenario.travel.speed_m_s else "on the spot",
        f"seed {scenario.seed}",
    ]
    return "; ".join(part for part in parts if part)


def _span(values: Array, unit: str) -> str:
    if len(values) == 0:
        return f"0 {unit}"
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g} {unit}" if high - low < 1e-6 else f"{low:.3g}–{high:.3g} {unit}"


def _draw_lines(
    axes: Axes, site_map: SiteMap, where: Array, values: Array, passes: Sequence[int]
) -> None:
    shades = mpl.colormaps["Blues"](np.linspace(1.0, 0.45, len(passes)))
    for number, shade in zip(passes, shades, strict=True):
        inside = site_map.pass_number == number
        axes.plot(where[inside], values[inside], color=shade, label=f"pass {number}")
    known = values[np.isfinite(values)]
    if len(known):
        axes.set_ylim(0.0, 1.15 * float(known.max()))


def _draw_map(
    figure: Figure,
    axes: Axes,
    site_map: SiteMap,
    where: Array,
    values: Array,
    passes: Sequence[int],
    colours: str,
) -> None:
    edges = _edges(where)
    rows = [
        _means(where[inside], values[inside], edges)
        for inside in (site_map.pass_number == number for number in passes)
    ]
    mesh = axes.pcolormesh(
        edges, _pass_edges(passes), np.array(rows), cmap=colours, rasterized=True
    )
    figure.colorbar(mesh, ax=axes, pad=0.02, aspect=24).outline.set_linewidth(0.4)
    _pass_axis(axes, passes)


def _draw_mode_map(
    axes: Axes, site_map: SiteMap, where: Array, passes: Sequence[int]
) -> list[Mode]:
    """Draw the modes as coloured places; return those that there are."""
    edges = _edges(where)
    rows = np.array([_modes_of(site_map, where, number, edges) for number in passes])
    axes.pcolormesh(edges, _pass_edges(passes), rows, cmap=_CMAP, norm=_NORM, rasterized=True)
    _pass_axis(axes, passes)
    return [mode for mode in Mode if np.any(rows == mode)]


def _draw_mode_bands(
    axes: Axes, site_map: SiteMap, where: Array, passes: Sequence[int]
) -> list[Mode]:
    """Draw the modes as a band for each pass along the upper edge; return those that there are."""
    edges = _edges(where)
    rows = np.array([_modes_of(site_map, where, number, edges) for number in passes])
    high = axes.get_ylim()[1]
    heights = high * (1.02 + 0.07 * np.arange(len(passes) + 1))
    axes.pcolormesh(edges, heights, rows, cmap=_CMAP, norm=_NORM, rasterized=True)
    axes.set_ylim(0.0, heights[-1])
    return [mode for mode in Mode if np.any(rows == mode)]


def _modes_of(site_map: SiteMap, where: Array, number: int, edges: Array) -> NDArray[np.int64]:
    inside = site_map.pass_number == number
    return _most_frequent(where[inside], site_map.mode[inside], edges)


def _edges(where: Array) -> Array:
    low, high = float(where.min()), float(where.max())
    return np.linspace(low, max(high, low + 1e-9), COLUMNS + 1)


def _pass_edges(passes: Sequence[int]) -> Array:
    return np.append(np.array(passes, dtype=np.float64) - 0.5, passes[-1] + 0.5)


def _pass_axis(axes: Axes, passes: Sequence[int]) -> None:
    axes.set_ylabel("pass")
    every = max(1, len(passes) // 10)
    axes.set_yticks(list(passes)[::every])


def _means(where: Array, values: Array, edges: Array) -> Array:
    """Return the mean of the known values in each place; what lies between two revolutions is interpolated."""
    known = np.isfinite(values)
    if not known.any():
        return np.full(len(edges) - 1, np.nan)
    places = np.clip(np.digitize(where[known], edges) - 1, 0, len(edges) - 2)
    count = np.bincount(places, minlength=len(edges) - 1)
    total = np.bincount(places, values[known], minlength=len(edges) - 1)
    middles = 0.5 * (edges[1:] + edges[:-1])
    filled = count > 0
    means: Array = np.interp(middles, middles[filled], total[filled] / count[filled])
    return means


def _most_frequent(where: Array, modes: NDArray[np.int64], edges: Array) -> NDArray[np.int64]:
    """Return the mode of most revolutions in each place; of the nearest place where there was none."""
    places = np.clip(np.digitize(where, edges) - 1, 0, len(edges) - 2)
    votes = np.zeros((len(edges) - 1, len(Mode)), dtype=np.int64)
    np.add.at(votes, (places, modes), 1)
    voted = np.flatnonzero(votes.any(axis=1))
    nearest = np.abs(np.arange(len(votes))[:, None] - voted[None, :]).argmin(axis=1)
    found: NDArray[np.int64] = votes.argmax(axis=1)[voted[nearest]]
    return found
