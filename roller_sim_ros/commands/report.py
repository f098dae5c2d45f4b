"""``roller-sim report``: a trace as one page to look at."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.errors import RollerSimError

DESCRIPTION = """\
Write a report on a trace: one HTML file that needs nothing else, with the run's facts, modes, CMV and RMV over time
and along the lane, for each mode that lasted acceleration, spectrum, force loop and orbit, gaps, faults, changes, and
the verdict on a meter if one is named. Print it from the browser for a PDF.

TRACE is an MCAP file or a rosbag2 folder of MCAP files.
"""

EPILOG = """\
examples:
  roller-sim report trace.mcap -o report.html
  roller-sim report trace.mcap -o report.html --meter /my_meter/cmv
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
        If the trace cannot be read, or the report not be written.
    """
    arguments = _parser().parse_args(argv)
    # What takes long to import comes after --help.
    from roller_sim_ros.report.page import page
    from roller_sim_ros.report.run_record import read_run
    from roller_sim_ros.report.windows import read_windows

    if not arguments.output.parent.is_dir():
        raise RollerSimError(f"{arguments.output}: cannot be written: there is no such folder")
    show = progress("reading", always=arguments.progress)
    record = read_run(arguments.trace, arguments.topic, lambda share: show(0.8 * share))
    windows = read_windows(record, lambda share: show(0.8 + 0.2 * share))
    verdict = None
    if arguments.meter is not None:
        from roller_sim_ros.score.report import as_object
        from roller_sim_ros.score.score import Options, score

        verdict = as_object(score(arguments.trace, Options(topic=arguments.meter)))
    try:
        arguments.output.write_text(page(record, windows, verdict), encoding="utf-8")
    except OSError as error:
        raise RollerSimError(
            f"{arguments.output}: cannot be written: {error.strerror or error}"
        ) from None
    print(f"wrote {arguments.output}: {record.duration_s:.1f} s, {record.samples} samples")
    if record.damage:
        raise RollerSimError(record.damage)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("report", DESCRIPTION, EPILOG)
    parser.add_argument("trace", metavar="TRACE", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        type=Path,
        default=Path("report.html"),
        help="what to write (default: %(default)s)",
    )
    parser.add_argument(
        "--topic",
        metavar="NAME",
        help="topic with the drum's acceleration (default: the only one)",
    )
    parser.add_argument(
        "--meter",
        metavar="TOPIC",
        help="a meter under test, whose verdict is shown as roller-sim score has it",
    )
    add_progress_flag(parser)
    return parser
