# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a statement of the paper is, and what is found about it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from roller_sim_ros.validation.study import Study


class Verdict(Enum):
    """Whether a statement comes out."""

    HOLDS = "holds"
    PARTLY = "partly"
    FAILS = "does not"


@dataclass(frozen=True)
class Finding:
    """What came out.

    Attributes
    ----------
    verdict : Verdict
        Whether it is what the paper says.
    text : str
        The numbers, in a few words.
    """

    verdict: Verdict
    text: str

    @classmethod
    def of(cls, holds: bool, text: str, *, otherwise: Verdict = Verdict.FAILS) -> Finding:
        """Return a finding that holds, or is otherwise."""
        return cls(Verdict.HOLDS if holds else otherwise, text)


@dataclass(frozen=True)
class Statement:
    """A sentence of the paper that can be checked.

    Attributes
    ----------
    key : str
        Short name.
    where : str
        Section or figure of the paper.
    says : str
        What it says, in short.
    check : callable
        Computes what comes out.
    command : str
        What shows it, arguments of ``roller-sim``; empty where only the check does.
    half_space : bool
        Whether another half space can give something else.
    sensitivity : bool
        Whether it is among those of the sensitivity figure.
    """

    key: str
    where: str
    says: str
    check: Callable[[Study], Finding]
    command: str = ""
    half_space: bool = True
    sensitivity: bool = False


def percent(value: float, digits: int = 2) -> str:
    """Return a share as a reader wants it."""
    return f"{100.0 * value:.{digits}g} %".replace("-", "−")
