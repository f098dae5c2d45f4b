# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a figure is before it is a file: a caption, data, and how to paint it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roller_sim_ros.parameters import Configuration
from roller_sim_ros.validation.study import Ground


@dataclass(frozen=True)
class Drawing:
    """One figure.

    Attributes
    ----------
    caption : str
        What it shows, and with which parameters.
    table : dict
        {heading with unit: ndarray, shape (rows,)}: its data, one row a point; one thing a column.
    paint : callable
        Paints the panels into an empty figure.
    size_inches : tuple of float
        Width and height.
    """

    caption: str
    table: Mapping[str, NDArray[Any]]
    paint: Callable[[Figure], None]
    size_inches: tuple[float, float] = (6.2, 4.4)


def stacked(label: str, parts: Mapping[str, Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """Return one table of several with the same headings, told apart by a first column.

    Parameters
    ----------
    label : str
        Heading of that column.
    parts : dict
        {what stands in it: table}.
    """
    lengths = [len(next(iter(part.values()))) for part in parts.values()]
    table: dict[str, NDArray[Any]] = {label: np.repeat(list(parts), lengths)}
    for heading in next(iter(parts.values())):
        table[heading] = np.concatenate([part[heading] for part in parts.values()])
    return table


def ground_text(ground: Ground) -> str:
    """Return a ground as captions name it."""
    return f"G = {ground[0] / 1e6:.3g} MPa, p = {ground[1] * 1e3:.3g} mm"


def machine_text(configuration: Configuration) -> str:
    """Return the machine as captions name it."""
    machine = configuration.machine
    return (
        f"drum {machine.drum_mass_kg:g} kg, frame {machine.frame_mass_kg:g} kg, "
        f"diameter {2.0 * machine.drum_radius_m:g} m, width {machine.drum_width_m:g} m"
    )


def half_space_text(configuration: Configuration) -> str:
    """Return the half space as captions name it."""
    chosen, soil = configuration.half_space, configuration.soil
    names = {
        "exact": "exact",
        "two-pole": f"two-pole (Q = {chosen.quality_factor:g}, ω₀√(BL)/v_s = "
        f"{chosen.frequency_factor:g})",
        "rational": f"rational of order {chosen.order}",
    }
    return (
        f"Half space {names[chosen.model]}; k = {chosen.area_factor:g}, "
        f"ρ = {soil.density_kg_m3:g} kg/m³, ν = {soil.poisson_ratio:g}"
    )
