# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""`python -m soak [--real-minutes M] [--simulated-hours H] [--write]`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from benchmarks.machine import facts, load
from soak.memory import Memory
from soak.run import Result, lock_step, real_time
from tools.markdown_table import table
from tools.sections import write_section

PAGE = Path(__file__).resolve().parents[1] / "docs" / "robustness.md"
HEAD = (
    "what",
    "how long",
    "samples",
    "lost",
    "drift",
    "memory at the start and after each quarter",
)


def main() -> int:
    """Soak, tell, and return 1 if a sample was lost."""
    parser = argparse.ArgumentParser(
        prog="python -m soak",
        description="Let the roller work on a scenario at 40 Hz and count every sample.",
    )
    parser.add_argument(
        "--real-minutes", type=float, default=60.0, help="in real time (default %(default)g)"
    )
    parser.add_argument(
        "--simulated-hours", type=float, default=24.0, help="in lock step (default %(default)g)"
    )
    parser.add_argument("--write", action="store_true", help="put the results into docs")
    arguments = parser.parse_args()
    before = load()
    results = []
    if arguments.real_minutes > 0.0:
        results.append(real_time(60.0 * arguments.real_minutes))
    if arguments.simulated_hours > 0.0:
        results.append(lock_step(arguments.simulated_hours))
    lines = [table(HEAD, [_row(result) for result in results]), ""]
    lines += [f"The roller's last words, {it.what}: {it.last_words}\n" for it in results]
    machine = "; ".join(f"{name} {value}" for name, value in facts().items())
    lines.append(f"*{machine}; load before {before}.*")
    text = "\n".join(lines)
    print(text)
    if arguments.write:
        write_section(PAGE, "soak", text)
    return int(any(result.lost for result in results))


def _row(it: Result) -> tuple[str, ...]:
    long = f"{it.simulated_s / 3600.0:.2f} h in {it.wall_s / 60.0:.1f} min"
    drift = f"{it.drift_samples:+.3f} samples"
    if it.clock_drift_ms is not None:
        drift += f", {it.clock_drift_ms:+.2f} ms against the steady clock"
    memory = f"node {_memory(it.memory)}"
    if it.recording is not None:
        memory += f"; recording {_memory(it.recording)}"
    samples = f"{it.truth.samples} true, {it.acceleration.samples} of the sensor"
    return it.what, long, samples, f"{it.lost}", drift, memory


def _memory(memory: Memory) -> str:
    quarters = ", ".join(f"{mb:.1f}" for mb in memory.quarters())
    return f"{quarters} MB, slope {memory.slope_mb_per_h:+.2f} MB/h"


if __name__ == "__main__":
    sys.exit(main())
