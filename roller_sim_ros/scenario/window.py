# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""When something holds: from … to … by time, chainage, pass or revolution."""

from __future__ import annotations

from dataclasses import dataclass

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.session import Moment
from roller_sim_ros.site.declaration import Record, declare


@dataclass(frozen=True)
class Window(Record):
    """Holds while all that is given does; everywhere and always where nothing is given.

    Times and chainages run up to, but not including, ``to``; passes and revolutions include it.
    """

    from_s: float | None = declare("from this time on", default=None, minimum=0.0)
    to_s: float | None = declare("up to this time", default=None, minimum=0.0)
    from_m: float | None = declare("from this chainage on, either way", default=None, minimum=0.0)
    to_m: float | None = declare("up to this chainage, either way", default=None, minimum=0.0)
    from_pass: int | None = declare("from this pass on, from 1", default=None, minimum=1)
    to_pass: int | None = declare("up to and with this pass", default=None, minimum=1)
    from_revolution: int | None = declare(
        "from this revolution on, from 0; below the sampling floor 128 samples count as one",
        default=None,
        minimum=0,
    )
    to_revolution: int | None = declare("up to and with this revolution", default=None, minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        for what in ("s", "m", "pass", "revolution"):
            begin, end = getattr(self, f"from_{what}"), getattr(self, f"to_{what}")
            if begin is None or end is None:
                continue
            if what in ("s", "m") and end <= begin:
                raise ParameterError(f"to_{what}", end, f"must be beyond from_{what}, {begin:g}")
            if end < begin:
                raise ParameterError(f"to_{what}", end, f"must be at least from_{what}, {begin}")

    def holds(self, moment: Moment) -> bool:
        """Return whether it holds."""
        position = moment.position
        return (
            _within(moment.time_s, self.from_s, self.to_s)
            and _within(position.chainage_m, self.from_m, self.to_m)
            and _within(position.pass_number, self.from_pass, _after(self.to_pass))
            and _within(moment.revolution, self.from_revolution, _after(self.to_revolution))
        )


def _within(value: float, begin: float | None, end: float | None) -> bool:
    return (begin is None or value >= begin) and (end is None or value < end)


def _after(last: int | None) -> int | None:
    return None if last is None else last + 1
