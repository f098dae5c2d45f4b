# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim replay``: whether a trace can be computed again bit by bit, and where not."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import progress

if TYPE_CHECKING:
    from roller_sim_ros.offline.difference import Difference
    from roller_sim_ros.offline.replay import Replay, ReplayedRun

DESCRIPTION = """\
Compute the runs of a trace again from what came into them (parameters, scenario, seed, commands, changes, faults,
releases, refusals: the topic inputs) and compare every message of the roller with the one recorded, byte by byte.
Says "identical", or which value differs first. What the recorder lost, or a damaged trace no longer holds, is left
out and counted.
"""

EPILOG = """\
examples:
  roller-sim replay trace.mcap
  roller-sim replay --hashes trace.mcap

With --hashes it also prints the SHA-256 of each recorded stream. These are the same for the same scenario and seed,
whoever drove it and however it was cut into messages; docs/replay.md says what goes into them.

The exit code is 0 when all is identical, 1 when not or when the trace cannot be replayed.
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
        0: identical; 1: not.

    Raises
    ------
    RollerSimError
        If the trace cannot be read or replayed.
    """
    arguments = _parser().parse_args(argv)
    # What takes long to import comes after --help.
    from roller_sim_ros.offline.replay import replay

    show = progress("replaying", always=False)
    found = replay(arguments.trace, arguments.namespace, show, hashes=arguments.hashes)
    print("\n".join(_lines(found)))
    return 0 if found.difference is None else 1


def _lines(found: Replay) -> list[str]:
    lines = ["identical" if found.difference is None else "not identical"]
    for number, run in enumerate(found.runs, 1):
        name = f"run {number}: " if len(found.runs) > 1 else ""
        lines.append(name + _summary(run))
        if run.difference is not None:
            lines.append(f"{name}first differs: {_told(run.difference)}")
        lines += [f"  {digest}  {topic}" for topic, digest in run.hashes.items()]
    if found.damage_text:
        lines.append(found.damage_text)
    return lines


def _summary(run: ReplayedRun) -> str:
    begins = f" from sample {run.first_sample} on" if run.first_sample else ""
    text = (
        f"{run.samples} samples{begins}, {run.duration_s:.3f} s; {sum(run.messages.values())} messages "
        f"of {len(run.messages)} topics are the same"
    )
    if run.lost:
        text += f", {run.lost} are not in the trace"
    if run.lost_inputs:
        text += f"; of what came in, {run.lost_inputs} are not in it: a difference may come of that"
    return text


def _told(difference: Difference) -> str:
    field = f" {difference.field}" if difference.field else ""
    return (
        f"{difference.topic}, sample {difference.sample} (block of {difference.time_s:.6f} s){field}: "
        f"recorded {difference.recorded}, replayed {difference.replayed}"
    )


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("replay", DESCRIPTION, EPILOG)
    parser.add_argument("trace", type=Path, help="MCAP file or folder of a bag, whole or not")
    parser.add_argument(
        "--namespace", default="", help="of the roller, where the trace has several of them"
    )
    parser.add_argument(
        "--hashes", action="store_true", help="print the SHA-256 of each recorded stream, too"
    )
    return parser
