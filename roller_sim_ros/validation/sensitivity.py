# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Which statements hold with which k, Q and ω0: choices of the paper that it does not publish."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

from roller_sim_ros.parameters import Configuration, HalfSpace
from roller_sim_ros.validation.registry import STATEMENTS
from roller_sim_ros.validation.statement import Finding
from roller_sim_ros.validation.study import Study

AREA_FACTORS = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0)
QUALITY_FACTORS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.8)
FREQUENCY_FACTORS = (1.5, 2.0, 2.5, 2.75, 3.0, 3.5, 4.5)

LOOKED_AT = tuple(statement for statement in STATEMENTS if statement.sensitivity)
"""The statements that are looked at."""

_RESOLUTION = 21
_REVOLUTIONS = 300


@dataclass(frozen=True)
class Setting:
    """A choice, and what comes out with it.

    Attributes
    ----------
    half_space : HalfSpace
        Model, k, Q and ω0.
    findings : tuple of Finding
        One for each of `LOOKED_AT`.
    """

    half_space: HalfSpace
    findings: tuple[Finding, ...]


def choices(resolution: int = 101) -> Iterator[HalfSpace]:
    """Yield the half spaces that are looked at: k alone for exact; k with Q and k with ω0 for two-pole.

    Parameters
    ----------
    resolution : int
        Below 51, every other value.
    """
    default = HalfSpace()
    step = 1 if resolution > 50 else 3
    seen = set()
    for area_factor in AREA_FACTORS[::step]:
        yield replace(default, model="exact", area_factor=area_factor)
        pairs = [(quality, default.frequency_factor) for quality in QUALITY_FACTORS[::step]]
        pairs += [(default.quality_factor, factor) for factor in FREQUENCY_FACTORS[::step]]
        for quality, factor in pairs:
            chosen = replace(
                default,
                model="two-pole",
                area_factor=area_factor,
                quality_factor=quality,
                frequency_factor=factor,
            )
            if chosen not in seen:
                seen.add(chosen)
                yield chosen


def settings(study: Study) -> list[Setting]:
    """Return what comes out with each choice."""
    workers = study.workers or len(os.sched_getaffinity(0))
    with ThreadPoolExecutor(workers) as threads:
        return list(threads.map(lambda chosen: _setting(study, chosen), choices(study.resolution)))


def _setting(study: Study, chosen: HalfSpace) -> Setting:
    base: Configuration = replace(study.base, half_space=chosen)
    of = Study(base, min(study.resolution, _RESOLUTION), _REVOLUTIONS, workers=1)
    return Setting(chosen, tuple(statement.check(of) for statement in LOOKED_AT))
