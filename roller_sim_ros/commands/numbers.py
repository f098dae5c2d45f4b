# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Numbers of the command line that are checked while it is parsed: types for argparse."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable


def whole(least: int) -> Callable[[str], int]:
    """Return what reads a whole number and refuses one below `least`."""

    def integer(text: str) -> int:
        number = int(text)
        if number < least:
            raise argparse.ArgumentTypeError(f"{number} is less than {least}")
        return number

    return integer


def positive(text: str) -> float:
    """Read a number above 0."""
    number = float(text)
    if not (number > 0.0 and math.isfinite(number)):
        raise argparse.ArgumentTypeError(f"{text} is not a positive number")
    return number


def not_negative(text: str) -> float:
    """Read a number of at least 0."""
    number = float(text)
    if not (number >= 0.0 and math.isfinite(number)):
        raise argparse.ArgumentTypeError(f"{text} is not a number of at least 0")
    return number
