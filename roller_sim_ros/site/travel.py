# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where the roller drives: forth and back on a lane as planned, or as it is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from roller_sim_ros.site.declaration import Record, declare
from roller_sim_ros.site.site import MAX_SPEED_M_S, Position


@dataclass(frozen=True)
class Plan(Record):
    """Passes forth and back, as planned."""

    speed_m_s: float = declare(
        "travel speed; 0: the roller vibrates on the spot",
        default=1.0,
        minimum=0.0,
        maximum=MAX_SPEED_M_S,
    )
    passes: int = declare(
        "passes; each goes the other way than the last", default=1, minimum=1, maximum=1000
    )
    direction: str = declare(
        "which way the first pass goes: forward from chainage 0, backward from the lane's end",
        default="forward",
        choices=("forward", "backward"),
    )
    start_m: float | None = declare(
        "chainage where the first pass begins; left out: the end of the lane that lies behind",
        default=None,
        minimum=0.0,
    )
    turn_s: float = declare(
        "how long the roller stands at a turning point before it goes back",
        default=0.0,
        minimum=0.0,
        maximum=3600.0,
    )


class Leg(NamedTuple):
    """A stretch travelled at one speed.

    Attributes
    ----------
    from_m, to_m : float
        Chainages.
    duration_s : float
        Time; also on the spot.
    ends_pass : bool
        Whether a planned pass ends with it.
    """

    from_m: float
    to_m: float
    duration_s: float
    ends_pass: bool


class Travel:
    """Follows a plan on a lane, or a speed that it is told; stands when all is driven.

    Driven by hand the roller stops at the ends of the lane until it is told to go back; every reversal begins a pass.
    Handed back to the plan it goes on with the pass that it is in.

    Parameters
    ----------
    plan : Plan
        What to do when nobody drives.
    length_m : float
        Length of the lane, from chainage 0.
    duration_s : float or None
        Time after which the plan ends.
    """

    def __init__(self, plan: Plan, length_m: float, duration_s: float | None) -> None:
        self._plan = plan
        self._length_m = length_m
        self._duration_s = duration_s
        self._forward = plan.direction == "forward"
        start_m = 0.0 if self._forward else length_m
        self._chainage_m = start_m if plan.start_m is None else plan.start_m
        self._pass_number = 1
        self._standing_s = 0.0
        self._elapsed_s = 0.0
        self._driven_m_s: float | None = None
        self._position: Position | None = None

    @property
    def position(self) -> Position:
        """Where the roller is."""
        if self._position is None:
            self._position = Position(
                self._chainage_m, self._pass_number, self._signed_speed(), self._all_driven()
            )
        return self._position

    def drive(self, speed_m_s: float | None) -> None:
        """Travel at a speed; None: as planned."""
        self._driven_m_s = speed_m_s
        self._position = None
        if speed_m_s is None:
            return
        self._standing_s = 0.0
        if speed_m_s and (speed_m_s > 0.0) != self._forward:
            self._reverse()

    def move(self, duration_s: float) -> list[Leg]:
        """Travel on for some time, and return the legs, one after the other, that fill it."""
        legs = []
        self._position = None
        left_s = duration_s
        if self._duration_s is not None:
            left_s = min(left_s, max(0.0, self._duration_s - self._elapsed_s))
        idle_s = duration_s - left_s
        if self._driven_m_s is not None:
            left_s, idle_s = duration_s, 0.0
        while left_s > 0.0:
            leg = self._next_leg(left_s)
            left_s -= leg.duration_s
            legs.append(leg)
        if idle_s > 0.0:
            legs.append(Leg(self._chainage_m, self._chainage_m, idle_s, ends_pass=False))
        self._elapsed_s += duration_s
        return legs

    def state(self) -> dict[str, float | int | bool]:
        """Return all that changes."""
        driven = self._driven_m_s
        return {
            "chainage_m": self._chainage_m,
            "forward": self._forward,
            "pass_number": self._pass_number,
            "standing_s": self._standing_s,
            "elapsed_s": self._elapsed_s,
            "driven": driven is not None,
            "driven_m_s": 0.0 if driven is None else driven,
        }

    def restore(self, state: dict[str, float | int | bool]) -> None:
        """Go on from a state that `state` returned."""
        self._position = None
        self._chainage_m = float(state["chainage_m"])
        self._forward = bool(state["forward"])
        self._pass_number = int(state["pass_number"])
        self._standing_s = float(state["standing_s"])
        self._elapsed_s = float(state["elapsed_s"])
        self._driven_m_s = float(state["driven_m_s"]) if state["driven"] else None

    @property
    def _end_m(self) -> float:
        """The end of the lane that lies ahead."""
        return self._length_m if self._forward else 0.0

    def _speed(self) -> float:
        return self._plan.speed_m_s if self._driven_m_s is None else abs(self._driven_m_s)

    def _signed_speed(self) -> float:
        stands = self._standing_s > 0.0 or self._all_driven()
        if self._driven_m_s is not None:
            stands = self._chainage_m == self._end_m
        if stands:
            return 0.0
        return self._speed() if self._forward else -self._speed()

    def _all_driven(self) -> bool:
        """Whether the plan is driven; never while somebody else drives."""
        if self._driven_m_s is not None:
            return False
        if self._duration_s is not None and self._elapsed_s >= self._duration_s:
            return True
        more = self._pass_number - self._plan.passes
        return more > 0 or (more == 0 and self._chainage_m == self._end_m)

    def _next_leg(self, most_s: float) -> Leg:
        here = self._chainage_m
        if self._driven_m_s is None:
            if self._all_driven():
                return Leg(here, here, most_s, ends_pass=False)
            if self._standing_s > 0.0:
                stood_s = min(self._standing_s, most_s)
                self._standing_s -= stood_s
                return Leg(here, here, stood_s, ends_pass=False)
        speed = self._speed()
        distance = abs(self._end_m - here)
        if speed * most_s < distance:
            self._chainage_m += speed * most_s if self._forward else -speed * most_s
            return Leg(here, self._chainage_m, most_s, ends_pass=False)
        if self._driven_m_s is not None and distance == 0.0:
            return Leg(here, here, most_s, ends_pass=False)
        self._chainage_m = self._end_m
        if self._driven_m_s is None and self._pass_number < self._plan.passes:
            self._reverse()
            self._standing_s = self._plan.turn_s
        duration_s = min(most_s, distance / speed)
        return Leg(here, self._chainage_m, duration_s, ends_pass=self._driven_m_s is None)

    def _reverse(self) -> None:
        self._forward = not self._forward
        self._pass_number += 1
