# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim report``: a trace as one page to look at."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.commands.termination import ends_like_ctrl_c
from roller_sim_ros.errors import RollerSimError

DESCRIPTION = """\
Write a report on a trace: one HTML file that needs nothing else, with the run's facts, modes, CMV and RMV over time
and along the lane, for each mode that lasted acceleration, spectrum, force loop and orbit, gaps, faults, changes, and
the verdict on a meter if one is named. With --pdf the same is printed, by the Chromium or Chrome that is installed.

TRACE is an MCAP file or a rosbag2 folder of MCAP files.
"""

EPILOG = """\
examples:
  roller-sim report trace.mcap -o report.html
  roller-sim report trace.mcap -o report.html --meter /my_meter/cmv
  roller-sim report trace.mcap -o report.html --pdf           # and report.pdf
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
        If the trace cannot be read, or the report not be written or printed.
    """
    arguments = _parser().parse_args(argv)
    with ends_like_ctrl_c():
        return _report(arguments)


def _report(arguments: argparse.Namespace) -> int:
    # What takes long to import comes after --help.
    from roller_sim_ros.report.files import write
    from roller_sim_ros.report.page import page
    from roller_sim_ros.report.pdf import find_browser, write_pdf
    from roller_sim_ros.report.run_record import read_run
    from roller_sim_ros.report.windows import read_windows

    output: Path = arguments.output
    pdf: Path | None = output.with_suffix(".pdf") if arguments.pdf is True else arguments.pdf
    _check(output, pdf)
    browser = None if pdf is None else find_browser()
    show = progress("reading", always=arguments.progress)
    record = read_run(arguments.trace, arguments.topic, lambda share: show(0.8 * share))
    windows = read_windows(record, lambda share: show(0.8 + 0.2 * share))
    verdict = None
    if arguments.meter is not None:
        from roller_sim_ros.score.report import as_object
        from roller_sim_ros.score.score import Options, score

        verdict = as_object(score(arguments.trace, Options(topic=arguments.meter)))
    text = page(record, windows, verdict)
    write(text, output)
    print(f"wrote {output}: {record.duration_s:.1f} s, {record.samples} samples", flush=True)
    if pdf is not None and browser is not None:
        write_pdf(text, pdf, browser)
        print(f"wrote {pdf}")
    if record.damage:
        raise RollerSimError(record.damage)
    return 0


def _check(output: Path, pdf: Path | None) -> None:
    """Refuse what cannot be written before the trace is read, which may take long."""
    if output.suffix.lower() == ".pdf":
        raise RollerSimError(f"{output}: -o names the HTML page; name the PDF with --pdf {output}")
    if pdf == output:
        raise RollerSimError(f"{output}: named by both -o and --pdf; name another for one of them")
    for path in filter(None, (output, pdf)):
        if not path.parent.is_dir():
            raise RollerSimError(f"{path}: cannot be written: there is no such folder")
        if path.is_dir():
            raise RollerSimError(f"{path}: cannot be written: it is a folder")


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
        "--pdf",
        metavar="FILE",
        type=Path,
        nargs="?",
        const=True,
        help="print it as well (default: the name of the page with .pdf)",
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
