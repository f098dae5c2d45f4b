# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m benchmarks [NAME …] [--write]`."""

from __future__ import annotations

import argparse
import sys

from benchmarks.errors import BenchmarkError
from benchmarks.machine import facts, load
from benchmarks.options import Options
from benchmarks.registry import BENCHMARKS, measure
from benchmarks.report import PATH, section
from roller_sim_ros.errors import RollerSimError
from tools.sections import write_section

QUICK_S = 8.0
"""Length of what is measured in real time when it is only tried out; the exciter has run up by then."""


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description="Measure what the package costs, beside something that does the same in the same run.",
        epilog="benchmarks:\n"
        + "\n".join(f"  {name:10} {says}" for name, says in BENCHMARKS.items()),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="which ones; all by default")
    parser.add_argument(
        "--write", action="store_true", help=f"put the tables into {PATH.parent.name}/{PATH.name}"
    )
    parser.add_argument(
        "--seconds",
        type=float,
        default=Options.seconds,
        help="node: length of a lateness measurement in s, at each frequency (default %(default)g)",
    )
    parser.add_argument(
        "--minutes",
        type=float,
        default=Options.minutes,
        help="node: how long lost samples are counted, in min (default %(default)g)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="try out in a minute whether all works; rough figures"
    )
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in BENCHMARKS]
    if unknown:
        parser.error(f"no benchmark {unknown[0]!r}: there are {', '.join(BENCHMARKS)}")
    if arguments.quick and arguments.write:
        parser.error("--quick: figures that rough are not to be written")
    options = Options(arguments.seconds, arguments.minutes)
    if arguments.quick:
        options = Options(seconds=QUICK_S, minutes=QUICK_S / 60.0, quick=True)
    machine = facts()
    failed = False
    for name in BENCHMARKS:
        if arguments.names and name not in arguments.names:
            continue
        before = load()
        try:
            text = section(measure(name, options), machine, before)
        except (BenchmarkError, RollerSimError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            failed = True
            continue
        print(text, flush=True)
        if arguments.write:
            write_section(PATH, name, text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
