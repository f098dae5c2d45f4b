# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim figures``: the paper's figures, redrawn."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.figures.registry import FIGURES, Entry, chosen
from roller_sim_ros.parameters import PARAMETERS

DESCRIPTION = """\
Redraw figures of the paper, and others of its kind, from the model: each as PNG and SVG, with its data as CSV beside
them. A figure that another half space changes is drawn with each half space asked for.
"""

EPILOG = """\
figures:
{figures}

(*: only when it is named)

examples:
  roller-sim figures
  roller-sim figures 16 18 20 --half-space exact --out maps
  roller-sim figures 16 --resolution 201
"""

DRAWN = ("exact", "two-pole")
"""Half spaces that are drawn when none is named."""


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0.

    Raises
    ------
    RollerSimError
        If there is no such figure, or a file cannot be written.
    """
    arguments = _parser().parse_args(argv)
    entries = chosen(arguments.names)
    # What takes long to import comes after --help and after everything that can be refused.
    from roller_sim_ros.figures.output import make_folder, write
    from roller_sim_ros.validation.study import Study

    make_folder(arguments.out)
    half_spaces = list(dict.fromkeys(arguments.half_space or DRAWN))
    began = time.monotonic()
    for entry in entries:
        for half_space in half_spaces if entry.half_space else half_spaces[:1]:
            study = Study.of(half_space, resolution=arguments.resolution, workers=arguments.workers)
            paths = write(
                entry.drawing(study), entry.caption_title(), arguments.out, entry.stem(half_space)
            )
            print(f"{paths[0]}, {', '.join(path.suffix[1:] for path in paths[1:])}", flush=True)
    print(f"{time.monotonic() - began:.1f} s")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser(
        "figures", DESCRIPTION, EPILOG.format(figures="\n".join(map(_line, FIGURES)))
    )
    parser.add_argument(
        "names", metavar="NAME", nargs="*", help="figures to draw (default: all without a *)"
    )
    parser.add_argument(
        "--out",
        metavar="FOLDER",
        type=Path,
        default=Path("figures"),
        help="where they go; files of the same name are replaced (default: figures)",
    )
    parser.add_argument(
        "--half-space",
        choices=PARAMETERS["half_space.model"][0].choices,
        action="append",
        help=f"with which half space; can be given several times (default: {' and '.join(DRAWN)})",
    )
    parser.add_argument(
        "--resolution",
        metavar="N",
        type=_resolution,
        default=101,
        help="points along each axis of a map, at least 6 (default: 101)",
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=_workers,
        help="threads (default: one for each core)",
    )
    return parser


def _line(entry: Entry) -> str:
    return f"  {entry.name + ('' if entry.default else ' *'):<13} {entry.title}"


def _resolution(text: str) -> int:
    return _at_least(text, 6)


def _workers(text: str) -> int:
    return _at_least(text, 1)


def _at_least(text: str, least: int) -> int:
    number = int(text)
    if number < least:
        raise argparse.ArgumentTypeError(f"{number} is less than {least}")
    return number
