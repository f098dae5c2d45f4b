# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Every figure; a new one is one file and one line here."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from roller_sim_ros.errors import RollerSimError

if TYPE_CHECKING:
    from roller_sim_ros.figures.drawing import Drawing
    from roller_sim_ros.validation.study import Study


@dataclass(frozen=True)
class Entry:
    """A figure.

    Attributes
    ----------
    name : str
        As on the command line: the paper's number, or a word.
    module : str
        File that draws it.
    title : str
        What it shows.
    half_space : bool
        Whether it is another one with another half space.
    default : bool
        Whether it is drawn when no name is given.
    """

    name: str
    module: str
    title: str
    half_space: bool = True
    default: bool = True

    def stem(self, half_space: str) -> str:
        """Return the name of its files without ending."""
        name = f"figure_{int(self.name):02d}" if self.name.isdigit() else self.name
        return f"{name}_{half_space.replace('-', '_')}" if self.half_space else name

    def caption_title(self) -> str:
        """Return what its caption begins with."""
        return f"Figure {self.name}. {self.title}." if self.name.isdigit() else f"{self.title}."

    def drawing(self, study: Study) -> Drawing:
        """Compute it. What it needs is imported only now: the names alone load quickly."""
        module = import_module(f"roller_sim_ros.figures.{self.module}")
        drawing: Drawing = module.drawing(study)
        return drawing


FIGURES: tuple[Entry, ...] = (
    Entry("2", "plastic_load", "Plastic load against displacement of a cylinder", half_space=False),
    Entry("5", "displacement", "Dimensionless displacement function", half_space=False),
    Entry("6", "shape", "Displacement of a rectangle in relation to a square", half_space=False),
    Entry("7", "circular", "Compliance functions of a circular plate", half_space=False),
    Entry("8", "rectangular", "Compliance functions of a rectangular area", half_space=False),
    Entry("10", "biaxial", "Simulated drum acceleration in horizontal and vertical direction"),
    Entry("14", "covariation", "Assumed co-variation of G and p", half_space=False),
    Entry("15", "acceleration", "Simulated vertical drum acceleration"),
    Entry("16", "stability", "Vibration stability"),
    Entry("17", "force_displacement", "Drum displacement against soil force"),
    Entry("18", "maximum_force", "Maximum soil force in relation to the static force"),
    Entry("19", "cmv_stiffness", "CMV against G for two amplitudes"),
    Entry("20", "cmv_plane", "Variation of CMV with frequency and amplitude"),
    Entry("misleading", "misleading", "Where each meter value misleads"),
    Entry(
        "sensitivity",
        "sensitivity",
        "Which statements hold with which k, Q and ω₀",
        half_space=False,
        default=False,
    ),
)
"""In the order in which they are drawn."""


def chosen(names: list[str]) -> list[Entry]:
    """Return the figures of these names, or those that are drawn by default when there is no name.

    Raises
    ------
    RollerSimError
        If there is no such figure.
    """
    known = {entry.name: entry for entry in FIGURES}
    for name in names:
        if name not in known:
            raise RollerSimError(f"no figure {name!r}; there are {', '.join(known)}")
    return [entry for entry in FIGURES if (entry.name in names if names else entry.default)]
