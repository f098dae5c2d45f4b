# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What every feature of the ground is: a record that writes itself into the profile."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

from numpy.random import Generator

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.site.declaration import Record
from roller_sim_ros.site.profile import Profile

Stream = Callable[[int | None], Generator]
"""Random numbers of the feature's own: from its own seed, or None for the one that the scenario's gives it."""


@dataclass(frozen=True)
class Feature(Record):
    """Something about the ground along the lane; features act one after the other."""

    @abstractmethod
    def apply(self, profile: Profile, stream: Stream) -> None:
        """Write the feature into the profile."""


def require_order(from_m: float, to_m: float | None) -> None:
    """Refuse a stretch that ends before it begins.

    Raises
    ------
    ParameterError
        If it does.
    """
    if to_m is not None and to_m <= from_m:
        raise ParameterError("to_m", to_m, f"must be beyond from_m, {from_m:g} m")
