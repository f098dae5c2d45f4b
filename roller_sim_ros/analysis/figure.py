# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plot of a bag: acceleration, spectrum in orders, force against displacement, CMV over time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from numpy.typing import NDArray

from roller_sim_ros.analysis.excerpt import Excerpt
from roller_sim_ros.analysis.panels import (
    BLUE,
    ORANGE,
    draw_acceleration,
    draw_force,
    draw_spectrum,
    drawn_figure,
    say_nothing,
)
from roller_sim_ros.analysis.result import Analysis
from roller_sim_ros.meters import Mode
from roller_sim_ros.parameters import GRAVITY_M_S2

SHOWN_REVOLUTIONS = 8
NOTHING = "no settled revolutions"
BAND_COLUMNS = 1000
"""Values of the mode that the band shows; a long trace has more than it has pixels."""

MODE_COLOURS = {
    Mode.UNKNOWN: "#e6e6e6",
    Mode.CONTINUOUS_CONTACT: "#a6cf98",
    Mode.PARTIAL_UPLIFT: "#4f9d69",
    Mode.DOUBLE_JUMP: "#f2b84b",
    Mode.QUAD_JUMP: "#e07b39",
    Mode.CHAOTIC: "#b3362b",
}


def write_figure(analysis: Analysis, path: Path) -> None:
    """Draw an analysis; the file's ending chooses the format (png, pdf, svg).

    Raises
    ------
    RollerSimError
        If the file cannot be written or the format is none that there is.
    """
    with drawn_figure(path) as figure:
        panels = figure.subplots(2, 2)
        _draw_acceleration(panels[0, 0], analysis)
        _draw_spectrum(panels[0, 1], analysis.excerpt)
        if analysis.excerpt is not None and analysis.excerpt.soil_force is not None:
            _draw_force(panels[1, 0], analysis.excerpt)
        else:
            _draw_fundamental(panels[1, 0], analysis)
        _draw_history(panels[1, 1], analysis)


def _draw_acceleration(axes: Axes, analysis: Analysis) -> None:
    axes.set_title("(a) Vertical drum acceleration")
    excerpt = analysis.excerpt
    if excerpt is None:
        say_nothing(axes, NOTHING)
        return
    count = min(excerpt.revolutions, SHOWN_REVOLUTIONS) * excerpt.samples_per_revolution
    turns = np.arange(count) / excerpt.samples_per_revolution
    offset = GRAVITY_M_S2 if analysis.specific_force else 0.0
    state = None if excerpt.contact_state is None else excerpt.contact_state[-count:]
    draw_acceleration(axes, turns, excerpt.vertical[-count:] - offset, state)
    if state is not None:
        axes.set_title("(a) Vertical drum acceleration (shaded: in the air)")
    axes.set_xlabel(f"revolutions of the eccentric ({excerpt.excitation_hz:.4g} Hz)")


def _draw_spectrum(axes: Axes, excerpt: Excerpt | None) -> None:
    axes.set_title("(b) Spectrum in orders of the excitation")
    if excerpt is None:
        say_nothing(axes, NOTHING)
    else:
        draw_spectrum(axes, excerpt.vertical, excerpt.samples_per_revolution)


def _draw_force(axes: Axes, excerpt: Excerpt) -> None:
    axes.set_title("(c) Soil force against drum displacement")
    if excerpt.soil_force is None or excerpt.drum_height is None:
        return
    count = min(excerpt.revolutions, SHOWN_REVOLUTIONS) * excerpt.samples_per_revolution
    draw_force(axes, excerpt.drum_height[-count:], excerpt.soil_force[-count:])


def _draw_fundamental(axes: Axes, analysis: Analysis) -> None:
    axes.set_title("(c) Amplitude at the excitation frequency")
    history = analysis.history
    axes.plot(history.floats("time_s"), history.floats("fundamental_amplitude_m_s2"), color=BLUE)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("time, s")
    axes.set_ylabel("A₁, m/s²")


def _draw_history(axes: Axes, analysis: Analysis) -> None:
    axes.set_title("(d) Meter values and mode over time")
    history = analysis.history
    time_s = history.floats("time_s")
    cmv, rmv = history.floats("cmv"), history.floats("rmv")
    axes.plot(time_s, rmv, color=ORANGE, label="RMV")
    axes.plot(time_s, cmv, color=BLUE, label="CMV")
    recorded = history.floats("recorded_cmv")
    known = np.isfinite(recorded)
    if known.any():
        every = max(1, np.count_nonzero(known) // 25)
        axes.plot(
            time_s[known][::every],
            recorded[known][::every],
            "o",
            color=BLUE,
            markersize=2.5,
            markerfacecolor="white",
            markeredgewidth=0.6,
            label="CMV recorded",
        )
    values = np.concatenate([cmv[np.isfinite(cmv)], rmv[np.isfinite(rmv)], [1.0]])
    axes.set_ylim(-0.14 * float(values.max()), 1.5 * float(values.max()))
    axes.set_xlabel("time, s")
    axes.set_ylabel("meter value")
    placed: dict[str, Any] = {
        "loc": "upper left",
        "ncols": 3,
        "borderaxespad": 0.0,
        "handlelength": 1.4,
    }
    axes.add_artist(axes.legend(bbox_to_anchor=(0.02, 1.0), **placed))
    bands = _draw_modes(axes, time_s, history.integers("mode"))
    axes.legend(handles=bands, bbox_to_anchor=(0.02, 0.92), **placed)


def _draw_modes(axes: Axes, time_s: NDArray[np.float64], modes: NDArray[np.int64]) -> list[Patch]:
    """Draw the mode as a coloured band along the time axis; return an entry of the legend for each."""
    shown = np.linspace(0, len(modes) - 1, min(len(modes), BAND_COLUMNS)).astype(np.int64)
    time_s, modes = time_s[shown], modes[shown]
    changes = np.flatnonzero(np.diff(modes)) + 1
    starts = np.concatenate([[0], changes]) if len(modes) else changes
    ends = np.concatenate([changes, [len(modes) - 1]])
    named: dict[Mode, Patch] = {}
    for start, end in zip(starts, ends, strict=False):
        mode = Mode(int(modes[start]))
        band = axes.axvspan(
            float(time_s[start]),
            float(time_s[end]),
            0.0,
            0.06,
            color=MODE_COLOURS[mode],
            linewidth=0,
            label=mode.label,
        )
        named.setdefault(mode, band)
    return [named[mode] for mode in sorted(named)]
