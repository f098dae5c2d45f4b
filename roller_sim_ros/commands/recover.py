# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim recover``: a whole trace of one that was cut off, and what was lost."""

from __future__ import annotations

import argparse
import sys
import textwrap
from pathlib import Path

from roller_sim_ros.traces.metadata import PARAMETERS
from roller_sim_ros.traces.recover import Account, TopicAccount, recover, recovered_path

WIDTH = 100

LOSS = (
    "Lost is a message that the file no longer holds with all its bytes, or that is in a chunk which fails "
    "its checksum. What the recorder had not written yet when it was stopped ({unwritten}) was never in "
    "the file. All else is kept, metadata too. It is a failure (exit code 1) only when not one message can "
    "be read."
)


def main(argv: list[str] | None = None) -> int:
    """Recover a trace and print the account.

    Parameters
    ----------
    argv : list of str, optional
        Arguments after the command's name.

    Returns
    -------
    int
        0; all else is raised.

    Raises
    ------
    TraceError
        If the trace cannot be read, no message is left in it, or the new file cannot be written.
    """
    arguments = _parser().parse_args(argv)
    account = recover(
        arguments.trace,
        arguments.output,
        overwrite=arguments.overwrite,
        progress=_Progress() if sys.stderr.isatty() else None,
    )
    print(account_text(account))
    return 0


def account_text(account: Account) -> str:
    """Return the account as the user reads it."""
    if account.whole:
        lines = [f"{account.source} is whole: {_messages(account.kept)}, {_span_text(account)}"]
        if account.target:
            lines.append(f"{account.target} is a copy of it")
        else:
            lines.append("nothing was written (-o PATH makes a copy)")
        return "\n".join([*lines, "", *_table(account)])
    lines = [textwrap.fill(LOSS.format(unwritten=_unwritten(account)), WIDTH), ""]
    lines.append(f"{account.source}: {account.unused_bytes} of {account.size} bytes cannot be used")
    for damage in account.damages:
        known = f", {_messages(damage.messages)} lost" if damage.messages else ""
        lines.append(f"  from byte {damage.offset}, {damage.length} bytes: {damage.reason}{known}")
    if account.salvaged:
        lines.append(f"  {_messages(account.salvaged)} saved out of the part that was cut off")
    if account.orphans:
        lines.append(f"  {_messages(account.orphans)} lost because their topic is named nowhere")
    lines.append(
        f"{account.target}: {_messages(account.kept)}, {_span_text(account)}, "
        f"{len(account.metadata)} metadata records"
    )
    return "\n".join([*lines, "", *_table(account)])


def _table(account: Account) -> list[str]:
    start = min((topic.first_ns for topic in account.topics.values() if topic.kept), default=0)
    rows: list[tuple[str, ...]] = [
        ("topic", "messages", "from s", "to s", "missing", "gaps in samples")
    ]
    rows += [_row(name, topic, start) for name, topic in sorted(account.topics.items())]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            cell.ljust(width) if index in (0, 5) else cell.rjust(width)
            for index, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _row(name: str, topic: TopicAccount, start_ns: int) -> tuple[str, ...]:
    if not topic.kept:
        return (name, "0", "", "", "", "")
    times = [f"{(time_ns - start_ns) / 1e9:.3f}" for time_ns in (topic.first_ns, topic.last_ns)]
    return (name, str(topic.kept), *times, str(topic.missing_messages), _gaps(topic))


def _gaps(topic: TopicAccount) -> str:
    gaps = topic.sample_gaps
    if topic.odd_messages:
        return f"{_messages(topic.odd_messages)} not of the type"
    if not gaps:
        return "none" if topic.counts_samples else ""
    missing = sum(end - start for start, end in gaps)
    start, end = gaps[0]
    more = f" and {len(gaps) - 1} more" if len(gaps) > 1 else ""
    return f"{missing} samples: {start} to {end - 1}{more}"


def _span_text(account: Account) -> str:
    kept = [topic for topic in account.topics.values() if topic.kept]
    span = max(topic.last_ns for topic in kept) - min(topic.first_ns for topic in kept)
    return f"{span / 1e9:.3f} s"


def _unwritten(account: Account) -> str:
    period = account.metadata.get(PARAMETERS, {}).get("recording.flush_period_s")
    return f"up to {period} s, its flush period" if period else "at most its open chunk"


def _messages(count: int) -> str:
    return "1 message" if count == 1 else f"{count} messages"


class _Progress:
    """A line on the terminal that tells how far the reading is."""

    def __init__(self) -> None:
        self._shown = -1

    def __call__(self, done: int, size: int) -> None:
        percent = 100 * done // max(size, 1)
        if percent != self._shown:
            self._shown = percent
            end = "\n" if percent == 100 else ""
            print(f"\rreading {percent} %", end=end, file=sys.stderr, flush=True)


def _parser() -> argparse.ArgumentParser:
    what = (
        "Make a whole MCAP file of one that was cut off (SIGKILL, power, full disk) or damaged, and state "
        "what was lost. The given file is never changed. Any MCAP file will do."
    )
    loss = LOSS.format(unwritten="at most its flush period, 0.5 s by default")
    table = (
        "The table tells by topic: messages kept; log times of the first and the last, s from the trace's "
        "first; messages missing between those, by the recorder's own counter; and gaps in the samples of "
        "DrumAcceleration and DrumSoilState."
    )
    parser = argparse.ArgumentParser(
        prog="roller-sim recover",
        description="\n\n".join(textwrap.fill(text, WIDTH) for text in (what, loss)),
        epilog=(
            f"{textwrap.fill(table, WIDTH)}\n\n"
            "example:\n  roller-sim recover broken.mcap -o whole.mcap"
        ),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("trace", type=Path, help="the MCAP file")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="PATH",
        help=(
            "file to write (default: TRACE with .recovered before .mcap, as in "
            f"{recovered_path(Path('broken.mcap'))}; nothing when the trace is whole)"
        ),
    )
    parser.add_argument(
        "--overwrite", action="store_true", help="replace a file that is there (default: refuse)"
    )
    return parser
