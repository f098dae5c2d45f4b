# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground along the lane as nobody has driven over it yet, cell by cell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.parameters import Machine, ParameterError, Soil, lookup
from roller_sim_ros.parameters.soil import COVARIATION_EXPONENT

Array = NDArray[np.float64]


@dataclass
class Profile:
    """The ground in cells of equal length; features write into its arrays, all of shape (cells,).

    Attributes
    ----------
    cell_m : float
        Length of a cell.
    machine : Machine
        Under which the plastic parameters hold.
    shear_modulus_pa, plastic_parameter_m, density_kg_m3, poisson_ratio : ndarray
        The model's soil in each cell.
    compactability : ndarray
        Share of the way to the compaction law's limits that the cell can go at all, 0 to 1.
    """

    cell_m: float
    machine: Machine
    shear_modulus_pa: Array
    plastic_parameter_m: Array
    density_kg_m3: Array
    poisson_ratio: Array
    compactability: Array

    @classmethod
    def uniform(cls, soil: Soil, machine: Machine, cells: int, cell_m: float) -> Profile:
        """Return a lane of one soil."""
        return cls(
            cell_m=cell_m,
            machine=machine,
            shear_modulus_pa=np.full(cells, soil.shear_modulus_pa),
            plastic_parameter_m=np.full(cells, soil.plastic_parameter_m),
            density_kg_m3=np.full(cells, soil.density_kg_m3),
            poisson_ratio=np.full(cells, soil.poisson_ratio),
            compactability=np.ones(cells),
        )

    @property
    def centres_m(self) -> Array:
        """Chainage of the middle of each cell."""
        centres: Array = (
            np.arange(len(self.shear_modulus_pa), dtype=np.float64) + 0.5
        ) * self.cell_m
        return centres

    def between(self, from_m: float, to_m: float | None) -> NDArray[np.bool_]:
        """Return which cells have their middle between two chainages; None: the lane's end."""
        centres = self.centres_m
        inside = centres >= from_m
        return inside if to_m is None else inside & (centres < to_m)

    def stiffen(self, ratio: Array, plastic_ratio: Array | None = None) -> None:
        """Multiply G by a ratio in each cell, and p by its own or by the one that goes with that of G.

        The latter is the power law through the two points of the paper's Figure 14, ratio^−0.5686: this
        project's assumption.
        """
        self.shear_modulus_pa = self.shear_modulus_pa * ratio
        plastic = ratio**COVARIATION_EXPONENT if plastic_ratio is None else plastic_ratio
        self.plastic_parameter_m = self.plastic_parameter_m * plastic

    def check(self) -> None:
        """Check every cell against the bounds of the model's soil.

        Raises
        ------
        ParameterError
            If a cell has a value that the model does not take; the message says where.
        """
        for name in ("shear_modulus_pa", "plastic_parameter_m", "density_kg_m3", "poisson_ratio"):
            values = getattr(self, name)
            quantity, _ = lookup(f"soil.{name}")
            low, high = quantity.minimum, quantity.maximum
            assert low is not None
            assert high is not None
            wrong = np.flatnonzero(~((values >= low) & (values <= high)))
            if len(wrong):
                at_m = float(self.centres_m[wrong[0]])
                raise ParameterError(
                    f"soil.{name}",
                    float(values[wrong[0]]),
                    f"must be {quantity.bounds_text()}; it is what the features make of the ground at "
                    f"chainage {at_m:.2f} m",
                )
