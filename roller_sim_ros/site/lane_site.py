# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A lane with its ground, its memory of the passes, and the roller on it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Machine, ParameterError, Soil
from roller_sim_ros.site.compaction import LAWS, CompactionLaw
from roller_sim_ros.site.declaration import Record, declare, kind_of
from roller_sim_ros.site.features import FEATURES, Feature, Stream
from roller_sim_ros.site.ground_values import GroundValues
from roller_sim_ros.site.profile import Profile
from roller_sim_ros.site.site import Position
from roller_sim_ros.site.streams import stream
from roller_sim_ros.site.travel import Leg, Plan, Travel

Array = NDArray[np.float64]
MOST_CELLS = 200_000
DIGITS = 9
"""Of the number of passes that a cell has had."""


@dataclass(frozen=True)
class Lane(Record):
    """The lane, from chainage 0 to its length."""

    length_m: float = declare("length of the lane", minimum=0.5, maximum=10000.0)
    cell_m: float = declare(
        "length of the cells in which the ground is kept; it is made to fit the lane",
        default=0.25,
        minimum=0.02,
        maximum=100.0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.length_m / self.cell_m > MOST_CELLS:
            raise ParameterError(
                "cell_m",
                self.cell_m,
                f"must be at least {self.length_m / MOST_CELLS:g}: there are at most {MOST_CELLS} cells",
            )

    @property
    def cells(self) -> int:
        """Number of cells."""
        return max(1, round(self.length_m / self.cell_m))


@dataclass(frozen=True)
class GroundPlan(GroundValues):
    """The ground along the lane, and what passes do to it."""

    features: tuple[Feature, ...] = declare(
        "what differs along the lane; each acts on what those before it left",
        default=(),
        registry=FEATURES,
    )
    compaction: CompactionLaw | None = declare(
        "how passes stiffen the ground; left out: not at all", default=None, registry=LAWS
    )


class LaneSite:
    """The roller drives forth and back on ground that follows its position and remembers its passes.

    What a pass does to a cell shows once the drum has left it, or at the turning point.

    Parameters
    ----------
    lane : Lane
        The lane.
    ground : GroundPlan
        The ground on it.
    plan : Plan
        What is driven.
    machine : Machine
        For the plastic parameter of grounds by name.
    otherwise : Soil
        What holds where `ground` says nothing.
    seed : int
        Of all random numbers.
    duration_s : float, optional
        Time after which the plan ends.

    Attributes
    ----------
    profile : Profile
        The ground before the first pass.

    Raises
    ------
    ParameterError
        If the ground is somewhere beyond what the model takes, or the plan does not fit the lane.
    """

    def __init__(
        self,
        lane: Lane,
        ground: GroundPlan,
        plan: Plan,
        *,
        machine: Machine,
        otherwise: Soil,
        seed: int,
        duration_s: float | None = None,
    ) -> None:
        if plan.start_m is not None and plan.start_m > lane.length_m:
            raise ParameterError(
                "travel.start_m",
                plan.start_m,
                f"must be on the lane, which is {lane.length_m:g} m long",
            )
        self._cells = lane.cells
        self._cell_m = lane.length_m / lane.cells
        self._law = ground.compaction
        self.profile = profile_of(ground, self._cells, self._cell_m, machine, otherwise, seed)
        self._limits = (self.profile.shear_modulus_pa, self.profile.plastic_parameter_m)
        if self._law is not None:
            self._limits = self._law.limits(self.profile)
        self._travel = Travel(plan, lane.length_m, duration_s)
        self._passes = np.zeros(self._cells)
        self._fresh = np.zeros(self._cells)
        self._cell = self._cell_at(self.position.chainage_m)
        self._soil: Soil | None = None
        self._soil_cell = -1

    @property
    def position(self) -> Position:
        """Where the roller is now."""
        return self._travel.position

    @property
    def decides(self) -> Collection[str]:
        """The soil's parameters, all given by the lane."""
        return tuple(f"soil.{name}" for name in vars(Soil()))

    @property
    def cells_m(self) -> Array:
        """Chainage of the middle of each cell."""
        return self.profile.centres_m

    @property
    def passes(self) -> Array:
        """Passes that each cell has had, counted in passes of the law's reference."""
        return np.array(self._passes)

    def ground(self) -> tuple[Array, Array]:
        """Return G, Pa, and p, m, of each cell as the passes so far have left them."""
        return self._compacted(slice(None))

    def move(self, duration_s: float, force_ratio: float) -> None:
        """Travel on, and leave behind what a pass does to the ground."""
        for leg in self._travel.move(duration_s):
            cell = self._cell_at(leg.to_m)
            if self._law is not None:
                self._lay(self._law, leg, force_ratio, cell)
            self._cell = cell

    def drive(self, speed_m_s: float | None) -> None:
        """Travel at a speed until told otherwise; None: as planned."""
        self._travel.drive(speed_m_s)

    def soil(self, configured: Soil) -> Soil:
        """Return the ground under the drum."""
        del configured
        if self._soil is not None and self._soil_cell == self._cell:
            return self._soil
        cell = slice(self._cell, self._cell + 1)
        modulus, plastic = self._compacted(cell)
        values = (
            float(modulus[0]),
            float(plastic[0]),
            float(self.profile.density_kg_m3[self._cell]),
            float(self.profile.poisson_ratio[self._cell]),
        )
        if self._soil is None or tuple(vars(self._soil).values()) != values:
            self._soil = Soil(*values)
        self._soil_cell = self._cell
        return self._soil

    def state(self) -> dict[str, Any]:
        """Return all that changes while the roller drives, as arrays and plain scalars."""
        return {
            **self._travel.state(),
            "cell": self._cell,
            "passes": self._passes.copy(),
            "fresh_passes": self._fresh.copy(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from a state that `state` returned on a site made from the same declarations.

        Raises
        ------
        RollerSimError
            If it is that of another lane.
        """
        passes = np.asarray(state["passes"], dtype=np.float64)
        if passes.shape != self._passes.shape:
            raise RollerSimError(
                f"the state is of a lane of {len(passes)} cells; this one has {self._cells}"
            )
        self._travel.restore(state)
        self._cell = int(state["cell"])
        self._soil_cell = -1
        self._passes = passes.copy()
        self._fresh = np.asarray(state["fresh_passes"], dtype=np.float64).copy()

    def _compacted(self, cells: slice) -> tuple[Array, Array]:
        first = self.profile.shear_modulus_pa[cells], self.profile.plastic_parameter_m[cells]
        if self._law is None:
            return first
        share = self._law.remaining(self._passes[cells])
        modulus, plastic = (
            limit[cells] + share * (start - limit[cells])
            for start, limit in zip(first, self._limits, strict=True)
        )
        return modulus, plastic

    def _cell_at(self, chainage_m: float) -> int:
        cell, last = int(chainage_m / self._cell_m), self._cells - 1
        if 0 <= cell <= last:
            return cell
        return 0 if cell < 0 else last

    def _lay(self, law: CompactionLaw, leg: Leg, force_ratio: float, to_cell: int) -> None:
        """Let a leg, which ends in a cell, compact the cells it goes over."""
        from_m, to_m, duration_s, ends_pass = leg
        low, high = (from_m, to_m) if from_m < to_m else (to_m, from_m)
        speed = (high - low) / duration_s if duration_s > 0.0 else 0.0
        laid = law.effort(speed, force_ratio) * duration_s / self._cell_m
        from_cell = self._cell_at(from_m)
        first, last = (from_cell, to_cell) if from_cell < to_cell else (to_cell, from_cell)
        if first == last:
            self._fresh[first] += laid
        else:
            edges = self._cell_m * np.arange(first, last + 2)
            edges[0], edges[-1] = low, high
            self._fresh[first : last + 1] += laid * np.diff(edges) / (high - low)
        if ends_pass or not first == last == self._cell:
            stays = -1 if ends_pass else to_cell
            self._leave(min(first, self._cell), max(last, self._cell), stays)

    def _leave(self, first: int, last: int, stays: int) -> None:
        """Let cells remember that the drum has left, all but the one where it stays."""
        for cell in range(first, last + 1):
            if cell != stays:
                # Rounded, so that cells that were driven over alike are alike to the last bit.
                self._passes[cell] = round(self._passes[cell] + self._fresh[cell], DIGITS)
                self._fresh[cell] = 0.0
                if cell == self._soil_cell:
                    self._soil_cell = -1


def profile_of(
    ground: GroundPlan, cells: int, cell_m: float, machine: Machine, otherwise: Soil, seed: int
) -> Profile:
    """Return the ground before the first pass.

    Raises
    ------
    ParameterError
        If it is somewhere beyond what the model takes.
    """
    profile = Profile.uniform(ground.soil(machine, otherwise), machine, cells, cell_m)
    count: dict[str, int] = {}
    for feature in ground.features:
        kind = kind_of(feature, FEATURES)
        count[kind] = count.get(kind, -1) + 1
        feature.apply(profile, _numbers(seed, f"site/{kind}/{count[kind]}"))
    profile.check()
    return profile


def _numbers(seed: int, purpose: str) -> Stream:
    def numbers(own_seed: int | None) -> Generator:
        return stream(seed if own_seed is None else own_seed, purpose)

    return numbers
