# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Presets are found by name."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TypeVar

from roller_sim_ros.parameters import ParameterError

Preset = TypeVar("Preset")


def find(kind: str, name: str, presets: Mapping[str, Preset]) -> Preset:
    """Return the preset of a name.

    Parameters
    ----------
    kind : str
        What it is a preset of, for the message.
    name : str
        Its name.
    presets : mapping
        Those that there are.

    Raises
    ------
    ParameterError
        If there is none of that name; the message offers the nearest and lists all.
    """
    if name in presets:
        return presets[name]
    near = get_close_matches(name, presets, n=1, cutoff=0.5)
    hint = f"; did you mean {near[0]}?" if near else ""
    raise ParameterError(
        kind, name, f"there is no such preset{hint}; there are {', '.join(presets)}"
    )
