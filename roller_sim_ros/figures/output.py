# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Drawings as files: PNG, SVG and the data as CSV."""

from __future__ import annotations

import csv
import math
import textwrap
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.figures.drawing import Drawing
from roller_sim_ros.figures.style import GREY, PAPER

_CHARACTERS_PER_INCH = 19.5
"""Of the caption, at its size."""

_DPI = 200
_PAGE_DPI = 100


def write(drawing: Drawing, title: str, folder: Path, stem: str) -> list[Path]:
    """Write a drawing as PNG, SVG and CSV.

    Parameters
    ----------
    drawing : Drawing
        What is written.
    title : str
        Begins the caption.
    folder : pathlib.Path
        Where; made when it is not there.
    stem : str
        Name of the files without ending.

    Returns
    -------
    list of pathlib.Path
        The files.

    Raises
    ------
    RollerSimError
        If a file cannot be written.
    """
    make_folder(folder)
    caption = f"{title} {drawing.caption}"
    figure = painted(drawing, caption)
    paths = []
    for ending in ("png", "svg"):
        about: dict[str, Any] = {"Description": caption}
        if ending == "svg":
            about["Date"] = None  # the same figure has the same bytes
        path = folder / f"{stem}.{ending}"
        with mpl.rc_context(PAPER):
            _save(path, partial(figure.savefig, format=ending, metadata=about))
        paths.append(path)
    path = folder / f"{stem}.csv"
    _save(path, partial(_write_table, drawing))
    return [*paths, path]


def write_picture(drawing: Drawing, title: str, path: Path) -> None:
    """Write a drawing as one small PNG, for a page.

    Raises
    ------
    RollerSimError
        If it cannot be written.
    """
    figure = painted(drawing, f"{title} {drawing.caption}")
    with mpl.rc_context(PAPER):
        _save(path, partial(figure.savefig, format="png", dpi=_PAGE_DPI))


def make_folder(folder: Path) -> None:
    """Make a folder if it is not there.

    Raises
    ------
    RollerSimError
        If it cannot be made or written into.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".roller-sim"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise RollerSimError(
            f"{folder}: cannot be written into: {error.strerror or error}; give another --out"
        ) from None


def painted(drawing: Drawing, caption: str) -> Figure:
    """Return the figure with its caption below the panels."""
    with mpl.rc_context(PAPER):
        figure = Figure(
            figsize=drawing.size_inches, dpi=_DPI, layout=ConstrainedLayoutEngine(h_pad=0.07)
        )
        FigureCanvasAgg(figure)
        drawing.paint(figure)
        width = int(drawing.size_inches[0] * _CHARACTERS_PER_INCH)
        text = textwrap.fill(caption, width, break_long_words=False)
        figure.supxlabel(text, x=0.01, ha="left", fontsize=6.5, color=GREY)
        return figure


def _save(path: Path, save: Callable[[Path], object]) -> None:
    """Write a file beside its place and move it there, so that it is always whole."""
    part = path.with_name(f".{path.name}.part")
    try:
        save(part)
        part.replace(path)
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)


def _write_table(drawing: Drawing, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(drawing.table)
        for row in zip(*drawing.table.values(), strict=True):
            writer.writerow([_text(value) for value in row])


def _text(value: Any) -> str:
    """Return a value with as many digits as anyone reads; empty where there is none."""
    if isinstance(value, (float, np.floating)):
        return "" if math.isnan(value) else f"{value:.8g}"
    return str(value)
