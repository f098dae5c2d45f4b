# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where each meter value misleads: over G and amplitude, p going with G."""

from __future__ import annotations

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from roller_sim_ros.figures.drawing import Drawing, half_space_text, machine_text
from roller_sim_ros.figures.style import (
    Array,
    paint_boundaries,
    paint_regions,
    panel_titles,
    region_patches,
    regions,
)
from roller_sim_ros.meters.registry import DRUM_METERS, METERS
from roller_sim_ros.validation.study import LOW_M, MODULI_PA, Study, spaced, stiffness_map

METER_VALUES = tuple(meter for meter in (*METERS, *DRUM_METERS) if meter.name != "rmv")
"""Those that are taken for the ground's stiffness."""

_AMPLITUDES_M = (0.2e-3, 2.5e-3)
_FARTHEST = 2.0
"""Doublings of G that the colours reach."""
_COLOURS = Normalize(-_FARTHEST, _FARTHEST)


def read_modulus(values: Array, calibration: Array, moduli: Array) -> Array:
    """Return the G that readings stand for on a calibration curve; at its ends where they lie beyond.

    Parameters
    ----------
    values : ndarray
        Readings.
    calibration : ndarray, shape (moduli,)
        What the meter reads at the amplitude of the calibration; NaN comes back if it does not rise with G.
    moduli : ndarray, shape (moduli,)
        G, in any unit; the result has the same.
    """
    if not np.all(np.diff(calibration) > 0.0):
        return np.full(np.shape(values), np.nan)
    return np.interp(values, calibration, moduli)


def drawing(study: Study) -> Drawing:
    """Return the drawing."""
    count = max(6, (study.resolution + 1) // 2)
    moduli, amplitudes = spaced(MODULI_PA, count), spaced(_AMPLITUDES_M, count)
    both = (tuple(map(float, moduli)), (LOW_M, *map(float, amplitudes)))
    rows = stiffness_map(study, *both)
    found = {name: array[1:] for name, array in rows.items()}
    number = regions(found["mode"], found["period"])
    read = {
        meter.name: read_modulus(found[meter.name], rows[meter.name][0], moduli)
        for meter in METER_VALUES
    }
    falls = {
        meter.name: np.gradient(found[meter.name], moduli, axis=1) < 0.0 for meter in METER_VALUES
    }

    def paint(figure: Figure) -> None:
        panels = figure.subplots(2, 3, sharex=True, sharey=True)
        x, y = moduli / 1e6, amplitudes * 1e3
        paint_regions(panels[0, 0], x, y, number.T)
        for axes, meter in zip(panels.flat[1:], METER_VALUES, strict=True):
            axes.pcolormesh(
                x, y, np.log2(read[meter.name] / moduli), cmap="RdBu", shading="nearest",
                norm=_COLOURS, rasterized=True,
            )  # fmt: skip
            axes.contourf(
                x,
                y,
                falls[meter.name].astype(float),
                levels=[0.5, 1.5],
                colors="none",
                hatches=["////"],
            )
            paint_boundaries(axes, x, y, number.T)
            axes.axhline(LOW_M * 1e3, color="black", linestyle="--", linewidth=0.6)
        for axes in panels[1]:
            axes.set_xlabel("shear modulus $G$, MPa")
        for axes in panels[:, 0]:
            axes.set_ylabel("nominal amplitude $A$, mm")
        panel_titles(list(panels.flat), ["mode", *(meter.label for meter in METER_VALUES)])
        bar = figure.colorbar(
            ScalarMappable(_COLOURS, "RdBu"),
            ax=panels,
            label="G as read over true G",
            ticks=[-2, -1, 0, 1, 2],
            aspect=40,
        )
        bar.ax.set_yticklabels(["≤ ¼", "½", "1", "2", "≥ 4"])
        figure.legend(
            handles=[
                *region_patches(number),
                Patch(
                    facecolor="none",
                    edgecolor="black",
                    hatch="////",
                    label="falls although G rises",
                ),
                Line2D([], [], color="black", linewidth=0.8, label="period 2 and more above"),
                Line2D(
                    [], [], color="black", linewidth=0.8, linestyle=":", label="no lift-off below"
                ),
                Line2D([], [], color="black", linewidth=0.6, linestyle="--", label="calibration"),
            ],
            loc="outside upper center",
            ncols=4,
        )

    amplitude, modulus = np.meshgrid(amplitudes * 1e3, moduli / 1e6, indexing="ij")
    table = {
        "amplitude_mm": amplitude.ravel(),
        "G_MPa": modulus.ravel(),
        "period_revolutions": found["period"].ravel(),
    }
    for meter in METER_VALUES:
        unit = f"_{meter.unit.replace('/', '_per_')}" if meter.unit else ""
        table[f"{meter.name}{unit}"] = found[meter.name].ravel()
        table[f"{meter.name}_G_read_MPa"] = read[meter.name].ravel() / 1e6
    return Drawing(
        caption=f"f = {study.base.exciter.frequency_hz:g} Hz, p going with G as in Figure 14, each point from "
        f"rest over {study.revolutions} revolutions. Colour: the G that a reading stands for when the meter was "
        f"calibrated at A = {LOW_M * 1e3:g} mm, over the true one; blue: the ground seems stiffer than it is, red: "
        f"softer; beyond the calibration, {MODULI_PA[0] / 1e6:g} to {MODULI_PA[1] / 1e6:g} MPa, its ends. "
        f"{half_space_text(study.base)}; {machine_text(study.base)}.",
        table=table,
        paint=paint,
        size_inches=(7.4, 5.4),
    )
