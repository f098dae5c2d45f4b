# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What atheris feeds, following the branches that its bytes take: the reading of scenarios and of bags.

A process of its own for each, as ``python -m fuzz.coverage_guided scenarios 60``: libFuzzer never returns.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import roller_sim_ros

READINGS = ("scenarios", "bags")


def kernels() -> list[str]:
    """Return the modules that numba compiles, and only as they are."""
    folder = Path(roller_sim_ros.__file__).parent
    return [
        ".".join(path.relative_to(folder.parent).with_suffix("").parts)
        for path in folder.rglob("*.py")
        if "njit" in path.read_text(encoding="utf-8")
    ]


def main() -> None:
    """Feed one of the readings for some seconds."""
    name, seconds = sys.argv[1:]
    import atheris

    with atheris.instrument_imports(include=["mcap", "yaml", "roller_sim_ros"], exclude=kernels()):
        from fuzz import items, targets

    if name == "scenarios":
        corpus = [text.encode() for text in items.SCENARIOS]

        def feed(data: bytes) -> None:
            targets.feed_scenario(data.decode("utf-8", "replace"))

    else:
        corpus = [targets.small_trace(0.0), targets.small_trace(1e3)]

        def feed(data: bytes) -> None:
            targets.feed_bag(data)

    with tempfile.TemporaryDirectory(prefix="roller_sim_corpus_") as folder:
        for number, content in enumerate(corpus):
            (Path(folder) / str(number)).write_bytes(content)
        options = [f"-max_total_time={seconds}", "-timeout=60", "-rss_limit_mb=2048"]
        options += ["-print_final_stats=1", "-artifact_prefix=build/fuzz_"]
        atheris.Setup([sys.argv[0], *options, folder], feed)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
