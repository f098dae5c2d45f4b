# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim export``: a trace in the formats of other tools."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.numbers import positive
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.errors import RollerSimError

DESCRIPTION = """\
Write a trace, or a table of it, as a file of another format; the ending of FILE says which: .csv, .parquet, .mat,
.wav or .geojson. Times are in s since the first sample, units are in the columns' names.

Tables: samples (what the accelerometer delivered), truth (the motion itself, soil force and displacements), meters
(a row a revolution), map (meter values in cells of the ground, where the trace holds positions).
"""

EPILOG = """\
examples:
  roller-sim export trace.mcap samples.parquet
  roller-sim export trace.mcap drum.wav
  roller-sim export trace.mcap cmv.geojson --cell-m 2
  roller-sim export trace.mcap truth.mat --table truth

Of a damaged trace what can be read is written; the exit code is then 1.
"""


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
        If the trace cannot be read to its end, or the file not be written.
    """
    arguments = _parser().parse_args(argv)
    # What takes long to import comes after --help.
    from roller_sim_ros.export import FORMATS, TABLES, Request

    path: Path = arguments.file
    form = FORMATS.get(path.suffix)
    if form is None:
        endings = ", ".join(FORMATS)
        raise RollerSimError(f"{path}: the ending {path.suffix!r} is unknown; there are {endings}")
    name = arguments.table or form.tables[0]
    if name not in form.tables:
        raise RollerSimError(
            f"{path}: {path.suffix} cannot hold the table {name}; it can {', '.join(form.tables)}"
        )
    show = progress("reading", always=arguments.progress)
    table = TABLES[name](Request(arguments.bag, arguments.topic, arguments.cell_m, show))
    # Beside the file, so that a failure leaves what was there before.
    part = path.with_name(f".{path.name}.part")
    try:
        form.write(table, part)
        part.replace(path)
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
    finally:
        part.unlink(missing_ok=True)
    print(f"wrote {path}: {name}, {form.doc}")
    if table.damage():
        raise RollerSimError(table.damage())
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("export", DESCRIPTION, EPILOG)
    parser.add_argument("bag", metavar="BAG", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument("file", metavar="FILE", type=Path, help="what to write")
    parser.add_argument(
        "--table",
        choices=("samples", "truth", "meters", "map"),
        help="what of the trace (default: samples; .csv: meters; .geojson: map)",
    )
    parser.add_argument(
        "--topic", metavar="NAME", help="topic of the table's messages (default: the only one)"
    )
    parser.add_argument(
        "--cell-m",
        metavar="M",
        type=positive,
        default=1.0,
        help="side of the map's cells, m (default: %(default)s)",
    )
    add_progress_flag(parser)
    return parser
