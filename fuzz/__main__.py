# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m fuzz [--items N] [--dds N] [--coverage-guided SECONDS] [--write]`."""

from __future__ import annotations

import argparse
import faulthandler
import re
import subprocess
import sys
import time
import warnings
from importlib.util import find_spec
from pathlib import Path

from hypothesis.errors import HypothesisWarning

from fuzz.coverage_guided import READINGS
from fuzz.run import Result, run
from fuzz.targets import targets
from tools.markdown_table import table
from tools.sections import write_section

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "robustness.md"
HANG_S = 900.0
"""No batch may take so long: the process ends and tells where it was."""


def main() -> int:
    """Feed all targets, or some; return 1 when there was a finding."""
    arguments = _arguments()
    warnings.simplefilter("ignore", HypothesisWarning)
    chosen = targets()
    weight = sum(chosen[name].share for name in arguments.names)
    results: dict[str, Result] = {}
    says = {name: target.says for name, target in chosen.items()}

    def tell(result: Result) -> None:
        faulthandler.dump_traceback_later(HANG_S, exit=True)
        print(f"{name:16} {result.items:7} items, {result.accepted:6} accepted", flush=True)

    for name in arguments.names:
        count = round(arguments.items * chosen[name].share / weight)
        results[name] = run(chosen[name], count, arguments.seed, tell)
    if arguments.dds:
        from fuzz.dds import hostile_client, target

        name = "over DDS"
        with hostile_client() as client:
            hostile = target(client)
            says[name] = hostile.says
            results[name] = run(hostile, arguments.dds, arguments.seed, tell, shrink=False)
    faulthandler.cancel_dump_traceback_later()
    guided = ""
    if arguments.coverage_guided:
        guided = "\n".join(_guided(name, arguments.coverage_guided) for name in READINGS)
    text = f"{_table(results, says)}\n\n{guided}".rstrip()
    print(text)
    if arguments.write:
        write_section(PAGE, "fuzz", text)
    return 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m fuzz",
        description="Feed hostile items; the first one that is neither accepted nor refused with a reason is "
        "shrunk, printed and ends the run.",
    )
    parser.add_argument(
        "names", nargs="*", default=list(targets()), help="targets; all by default", metavar="NAME"
    )
    parser.add_argument("--items", type=int, default=100_000, help="of all (default %(default)d)")
    parser.add_argument(
        "--dds",
        type=int,
        default=0,
        metavar="N",
        help="items to a real node over DDS, beside those",
    )
    parser.add_argument("--seed", type=int, default=1, help="the same one feeds the same items")
    parser.add_argument(
        "--coverage-guided",
        type=int,
        default=0,
        metavar="SECONDS",
        help="let atheris (requirements/fuzz.txt) feed the reading of scenarios and of bags for so long, each",
    )
    parser.add_argument("--write", action="store_true", help="put the results into docs")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in targets():
            parser.error(f"no target {name!r}: there are {', '.join(targets())}")
    if arguments.coverage_guided and find_spec("atheris") is None:
        parser.error("--coverage-guided needs atheris: pip install -r requirements/fuzz.txt")
    return arguments


def _table(results: dict[str, Result], says: dict[str, str]) -> str:
    rows = [
        (
            says[name],
            f"{it.items}",
            f"{it.accepted}",
            f"{it.items - it.accepted}",
            f"{it.slowest_s:.2f} s",
            f"{it.seconds:.0f} s",
        )
        for name, it in results.items()
    ]
    total = sum(it.items for it in results.values())
    seconds = sum(it.seconds for it in results.values())
    rows.append(("**all**", f"**{total}**", "", "", "", f"{seconds:.0f} s"))
    return table(("what", "items", "accepted", "refused", "slowest sequence", "time"), rows)


def _guided(name: str, seconds: int) -> str:
    """Let atheris feed a reading, and return what it says."""
    (ROOT / "build").mkdir(exist_ok=True)
    begin = time.monotonic()
    done = subprocess.run(
        [sys.executable, "-m", "fuzz.coverage_guided", name, str(seconds)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=10 * seconds + 300,
        check=False,
    )
    if done.returncode != 0:
        sys.exit(f"{name}: atheris has a finding\n{done.stderr[-4000:]}")
    counts = dict(re.findall(r"stat::(\w+):\s+(\d+)", done.stderr))
    coverage = re.findall(r"cov: (\d+)", done.stderr)
    return (
        f"- atheris, {name}: {counts['number_of_executed_units']} inputs in {time.monotonic() - begin:.0f} s, "
        f"{coverage[0]} branches at first and {coverage[-1]} at last, no finding"
    )


if __name__ == "__main__":
    sys.exit(main())
