# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Progress of what takes long, on the standard error."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable


def add_progress_flag(parser: argparse.ArgumentParser) -> None:
    """Add ``--progress``: show it also where nobody may look."""
    parser.add_argument(
        "--progress",
        action="store_true",
        help="show progress on the standard error also when that is no terminal",
    )


def progress(what: str, *, always: bool) -> Callable[[float], None]:
    """Return what shows a share from 0 to 1, at most once per percent; it stays silent where nobody looks.

    Parameters
    ----------
    what : str
        What is going on, as in ``reading``.
    always : bool
        Show it, one line per percent, also when the standard error is no terminal.
    """
    terminal = sys.stderr.isatty()
    shown = 0

    def show(share: float) -> None:
        nonlocal shown
        percent = int(100.0 * share)
        if percent == shown or not (terminal or always):
            return
        shown = percent
        if terminal:
            end = "\r\x1b[K" if percent >= 100 else ""
            print(f"\r{what} {percent} %", end=end, file=sys.stderr, flush=True)
        else:
            print(f"{what} {percent} %", file=sys.stderr, flush=True)

    return show
