# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The figures of a report, as SVG to stand in a page."""

from __future__ import annotations

import re
from collections.abc import Callable
from io import StringIO
from itertools import count, pairwise

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from roller_sim_ros.analysis.figure import MODE_COLOURS
from roller_sim_ros.analysis.panels import (
    BLUE,
    GREY,
    LIGHT,
    ORANGE,
    STYLE,
    draw_acceleration,
    draw_force,
    draw_spectrum,
    say_nothing,
)
from roller_sim_ros.meters import Mode
from roller_sim_ros.parameters import GRAVITY_M_S2, SAMPLES_PER_REVOLUTION
from roller_sim_ros.report.displacement import twice_integrated, without_sinking
from roller_sim_ros.report.run_record import RunRecord
from roller_sim_ros.report.windows import Window

POINTS = 1600
"""Points of a line: more than a page has pixels."""

SHOWN = 8 * SAMPLES_PER_REVOLUTION
"""Samples of a window that are drawn over time and as loops."""

RED = "#b3362b"

NO_TRUTH = "the trace holds no truth here"

_NUMBERS = count()

Draw = Callable[[Figure], None]


def svg(draw: Draw, width_in: float, height_in: float) -> str:
    """Return a figure as an ``<svg>`` element, without what belongs to a file of its own."""
    with mpl.rc_context({**STYLE, "svg.fonttype": "none", "font.family": "sans-serif"}):
        figure = Figure(figsize=(width_in, height_in), layout="constrained")
        FigureCanvasSVG(figure)
        draw(figure)
        text = StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None})
    found = text.getvalue()
    found = found[found.index("<svg") :]
    # Names in one page must not meet those of another figure.
    prefix = f"f{next(_NUMBERS)}-"
    found = re.sub(r'\bid="', f'id="{prefix}', found)
    return re.sub(r'(url\(#|href="#)', rf"\g<1>{prefix}", found)


def over_time(record: RunRecord) -> str:
    """Draw modes, meter values, acceleration and excitation over time."""

    def draw(figure: Figure) -> None:
        panels = figure.subplots(4, 1, sharex=True, height_ratios=[0.5, 1.3, 1.3, 0.9])
        _draw_modes(panels[0], record)
        _draw_meters(panels[1], record)
        _draw_envelope(panels[2], record)
        _draw_excitation(panels[3], record)
        panels[-1].set_xlabel("time, s")
        panels[-1].set_xlim(0.0, record.duration_s)

    return svg(draw, 9.0, 6.6)


def over_chainage(record: RunRecord) -> str:
    """Draw CMV over chainage, a line for each pass, and the ground; empty where the roller does not travel."""
    site = record.site
    if not site or float(np.ptp(site["chainage"])) < 1.0:
        return ""

    def draw(figure: Figure) -> None:
        cmv, ground = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1.0])
        passes = np.unique(site["pass_number"])
        # The last pass is the darkest; the palest are not to be seen on white.
        shades = mpl.colormaps["viridis_r"](np.linspace(1.0, 0.25, len(passes))[::-1])
        for number, shade in zip(passes, shades, strict=True):
            of_pass = site["pass_number"] == number
            chainage, values = site["chainage"][of_pass], site["cmv"][of_pass]
            cmv.plot(*_thinned(chainage, values), color=shade, label=f"pass {number}")
            modulus = site["shear_modulus"][of_pass] * 1e-6
            ground.plot(*_thinned(chainage, modulus), color=shade)
        cmv.set_ylabel("true CMV")
        ground.set_ylabel("true G, MPa")
        ground.set_xlabel("chainage, m")
        if len(passes) <= 12:
            cmv.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

    return svg(draw, 9.0, 4.2)


def of_window(window: Window) -> list[str]:
    """Draw acceleration, spectrum, force loop and orbit of a window, each by itself."""
    height, sinking_m = None, 0.0
    if window.truth:
        height, sinking_m = without_sinking(window.truth["drum_height"])
    less = f", less the sinking of {sinking_m * 1e3:.2g} mm a revolution"
    less = less if sinking_m > 1e-5 else ""

    def acceleration(axes: Axes) -> None:
        turns = np.arange(SHOWN) / SAMPLES_PER_REVOLUTION
        state = window.truth.get("contact_state")
        draw_acceleration(
            axes,
            turns,
            window.vertical[-SHOWN:],
            None if state is None else state[-SHOWN:].astype(np.uint8),
        )
        axes.set_title("Vertical acceleration" + ("" if state is None else " (shaded: in the air)"))
        axes.set_xlabel("revolutions of the eccentric")

    def spectrum(axes: Axes) -> None:
        draw_spectrum(axes, window.vertical, SAMPLES_PER_REVOLUTION)
        axes.set_title("Spectrum in orders; dots: what the meters use")

    def force(axes: Axes) -> None:
        axes.set_title(f"Soil force{less or ' against displacement'}")
        if height is None:
            say_nothing(axes, NO_TRUTH)
        else:
            draw_force(axes, height[-SHOWN:], window.truth["soil_force"][-SHOWN:])

    def orbit(axes: Axes) -> None:
        axes.set_title(f"Orbit of the axle{less}")
        if height is None:
            say_nothing(axes, NO_TRUTH)
        else:
            _draw_orbit(axes, window, height)

    return [_panel(draw) for draw in (acceleration, spectrum, force, orbit)]


def _panel(draw: Callable[[Axes], None]) -> str:
    return svg(lambda figure: draw(figure.subplots()), 4.5, 2.75)


def _draw_orbit(axes: Axes, window: Window, height: NDArray[np.float64]) -> None:
    if window.excitation_hz <= 0.0:
        say_nothing(axes, "the eccentric stands")
        return
    rate_hz = SAMPLES_PER_REVOLUTION * window.excitation_hz
    horizontal = twice_integrated(window.truth["horizontal"], rate_hz)
    axes.plot(horizontal[-SHOWN:] * 1e3, (height[-SHOWN:] - height.mean()) * 1e3, color=BLUE)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("forward, mm")
    axes.set_ylabel("up, mm")


def _draw_modes(axes: Axes, record: RunRecord) -> None:
    axes.set_yticks([0.0, 1.0], ["true", "meter"])
    axes.set_ylim(-0.5, 1.5)
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)
    seen: set[Mode] = set()
    for row, columns in ((0.0, record.site), (1.0, record.meter)):
        if columns:
            seen |= _draw_band(axes, row, columns["time_s"], columns["mode"])
    axes.legend(
        handles=[Patch(color=MODE_COLOURS[mode], label=mode.label) for mode in sorted(seen)],
        ncols=6,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
    )


def _draw_band(
    axes: Axes, row: float, time_s: NDArray[np.float64], modes: NDArray[np.uint8]
) -> set[Mode]:
    shown = np.linspace(0, len(modes) - 1, min(len(modes), POINTS)).astype(np.int64)
    time_s, modes = time_s[shown], modes[shown]
    edges = np.concatenate([[0], np.flatnonzero(np.diff(modes)) + 1, [len(modes) - 1]])
    for start, end in pairwise(edges):
        width = float(time_s[end] - time_s[start])
        mode = Mode(int(modes[start]))
        axes.broken_barh(
            [(float(time_s[start]), width)], (row - 0.4, 0.8), color=MODE_COLOURS[mode]
        )
    return {Mode(int(mode)) for mode in np.unique(modes)}


def _draw_meters(axes: Axes, record: RunRecord) -> None:
    axes.set_ylabel("meter value")
    if not record.meter:
        say_nothing(axes, "the trace holds no meter values")
        return
    time_s = record.meter["time_s"]
    axes.plot(*_thinned(time_s, record.meter["rmv"]), color=ORANGE, label="RMV")
    axes.plot(*_thinned(time_s, record.meter["cmv"]), color=BLUE, label="CMV")
    if record.site:
        found = _thinned(record.site["time_s"], record.site["cmv"])
        axes.plot(*found, color=GREY, linestyle=":", label="true CMV")
    axes.set_ylim(bottom=0.0, top=1.2 * axes.get_ylim()[1])
    axes.legend(loc="upper right", ncols=3)


def _draw_envelope(axes: Axes, record: RunRecord) -> None:
    time_s, low, high = (record.envelope[name] for name in ("time_s", "low", "high"))
    # At least two revolutions each: of a double jump, one is unlike the next.
    bins = max(1, min(POINTS, record.samples // (2 * SAMPLES_PER_REVOLUTION), len(time_s)))
    edges = np.linspace(0, len(time_s), bins + 1).astype(np.int64)[:-1]
    axes.fill_between(
        time_s[edges],
        np.fmin.reduceat(low, edges) / GRAVITY_M_S2,
        np.fmax.reduceat(high, edges) / GRAVITY_M_S2,
        color=BLUE,
        linewidth=0,
    )
    if record.gaps:
        # At the top, or they would cover what is around them; no two at one place.
        place = np.array([gap.time_s for gap in record.gaps]) / record.duration_s
        place = np.unique(np.round(place * POINTS)) / POINTS * record.duration_s
        line = axes.get_xaxis_transform()
        axes.plot(place, np.ones(len(place)), "|", color=RED, label="gap", transform=line)
        axes.legend(loc="upper right", bbox_to_anchor=(1.0, 0.97))
        axes.margins(y=0.15)
    axes.axhline(0.0, color=LIGHT, linewidth=0.5)
    axes.set_ylabel("acceleration, g,\nleast to greatest")


def _draw_excitation(axes: Axes, record: RunRecord) -> None:
    time_s = record.envelope["time_s"]
    found = _thinned(time_s, record.envelope["excitation_frequency"])
    axes.plot(*found, color=BLUE)
    axes.set_ylabel("excitation, Hz", color=BLUE)
    axes.set_ylim(bottom=0.0, top=1.1 * max(1.0, float(np.nanmax(found[1]))))
    if record.exciter:
        beside = axes.twinx()
        beside.spines["right"].set_visible(True)
        values = record.exciter["amplitude"] * 1e3
        beside.plot(*_thinned(record.exciter["time_s"], values), color=ORANGE)
        beside.set_ylabel("amplitude, mm", color=ORANGE)
        # Not the part of the height that the frequency has, or one line would hide the other.
        beside.set_ylim(bottom=0.0, top=1.4 * max(0.1, float(np.nanmax(values))))


def _thinned(
    x: NDArray[np.floating], y: NDArray[np.floating]
) -> tuple[NDArray[np.floating], NDArray[np.floating]]:
    """Return a line with few points that keeps the least and the greatest of each stretch."""
    if len(x) <= POINTS:
        return x, y
    edges = np.linspace(0, len(x), POINTS // 2 + 1).astype(np.int64)[:-1]
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)
    return np.repeat(x[edges], 2), np.stack([low, high], axis=1).ravel()
