# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The one table of topics; publishers, recording and the README's table are made from it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from roller_sim_ros.meters.registry import FURTHER
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Pacing
from roller_sim_ros.wire.qos import Qos

BRISK_HZ = 40.0
"""Excitation frequency by which depths of "one second" are reckoned; rollers vibrate at 25 to 40 Hz."""

REAL_TIMES, SIMULATED_TIMES, DEEPEST = 5, 100, 50_000
"""By how much histories are deeper than one second, in real time and in simulated time, which may go faster, and no
deeper than this: the middleware sends again what a reader has missed only every 3 s, if it still has it then."""


class Direction(Enum):
    """What the node does with a topic."""

    PUBLISHED = "publishes"
    SUBSCRIBED = "subscribes"
    RECORDED = "records"
    """Neither: others publish it, the recording takes it along."""


Depth = Callable[[Pacing], int]


def _fixed(depth: int) -> Depth:
    return lambda _: depth


def _second_of(samples_per_message: Callable[[Pacing], int]) -> Depth:
    """Return the number of messages in one second that come every so many samples."""
    per_second = BRISK_HZ * SAMPLES_PER_REVOLUTION
    return lambda pacing: math.ceil(per_second / samples_per_message(pacing))


_BLOCKS = _second_of(lambda pacing: pacing.samples_per_message)
_SAMPLES = _second_of(lambda pacing: pacing.imu_decimation)
_REVOLUTIONS = _second_of(lambda _: SAMPLES_PER_REVOLUTION)


@dataclass(frozen=True)
class Topic:
    """One topic.

    Attributes
    ----------
    name : str
        Relative to the node's namespace; absolute where ROS 2 has one for the whole system.
    type_name : str
        As in ``package/msg/Name``.
    direction : Direction
        What the node does with it.
    doc : str
        What it says, with units, for the README's table.
    depth : callable
        Messages of about one second from the pacing, by which the depth of the history is reckoned.
    rate : str
        How often it comes, for the README's table.
    durability : str
        ``volatile`` or ``transient_local``. All topics are reliable, which best-effort readers match too.
    of_simulated_time : bool
        Whether it is there in simulated time only.
    """

    name: str
    type_name: str
    direction: Direction
    doc: str
    depth: Depth
    rate: str
    durability: str = "volatile"
    of_simulated_time: bool = False

    def qos(self, pacing: Pacing) -> Qos:
        """Return the quality of service at a pacing."""
        depth = self.depth(pacing)
        # Of a state only the last word counts, and of the clock, which is best effort to its readers.
        if not self.of_simulated_time and depth > 1:
            times = SIMULATED_TIMES if pacing.simulated_time else REAL_TIMES
            depth = min(times * depth, DEEPEST)
        return Qos("reliable", self.durability, depth)

    def resolved(self, namespace: str = "/") -> str:
        """Return the absolute name in a namespace."""
        if self.name.startswith("/"):
            return self.name
        return f"/{namespace.strip('/')}/{self.name}".replace("//", "/")


ACCELERATION = Topic(
    "drum/acceleration",
    "roller_sim_ros/msg/DrumAcceleration",
    Direction.PUBLISHED,
    "blocks of what the sensor delivers: vertical and horizontal drum acceleration, m/s²",
    _BLOCKS,
    "per block",
)
IMU = Topic(
    "drum/imu",
    "sensor_msgs/msg/Imu",
    Direction.PUBLISHED,
    "the same per sample as specific force, m/s², +9.81 on z at rest; "
    "while someone listens, or with `--record-topic drum/imu`",
    _SAMPLES,
    "per sample, decimated",
)
METER = Topic(
    "meter",
    "roller_sim_ros/msg/CompactionMeter",
    Direction.PUBLISHED,
    "CMV, RMV (dimensionless), period and mode from the published samples",
    _REVOLUTIONS,
    "per revolution",
)
CMV = Topic(
    "cmv",
    "std_msgs/msg/Float64",
    Direction.PUBLISHED,
    "CMV alone, dimensionless, NaN when there is none or samples were clipped; right after meter",
    _REVOLUTIONS,
    "per revolution",
)
FURTHER_METERS: tuple[Topic, ...] = tuple(
    Topic(
        f"meters/{meter.name}",
        "std_msgs/msg/Float64",
        Direction.PUBLISHED,
        f"{meter.label} alone, {meter.unit or 'dimensionless'}, NaN when there is none or samples were clipped; "
        "right after meter",
        _REVOLUTIONS,
        "per revolution",
    )
    for meter in FURTHER
)
"""Meter values beside CMV and RMV, in the order of the meters' registry."""

EXCITER_STATE = Topic(
    "exciter/state",
    "roller_sim_ros/msg/ExciterState",
    Direction.PUBLISHED,
    "what the exciter does and was told: Hz, m, N; why a command was refused",
    _fixed(10),
    "10 Hz and on change",
)
TRUTH = Topic(
    "truth",
    "roller_sim_ros/msg/DrumSoilState",
    Direction.PUBLISHED,
    "blocks of the motion itself: m/s², N, m; G in Pa, p in m, true CMV, RMV and mode",
    _BLOCKS,
    "per block",
)
APPLIED = Topic(
    "applied",
    "roller_sim_ros/msg/AppliedChange",
    Direction.PUBLISHED,
    "every command and parameter change at the sample where it took effect, SI units",
    _fixed(100),
    "on change",
)
INPUTS = Topic(
    "inputs",
    "roller_sim_ros/msg/RunInput",
    Direction.PUBLISHED,
    "all that comes into the run from outside, at its sample: what `roller-sim replay` computes the run from again",
    _fixed(100),
    "at start and as it comes",
)
SITE_STATE = Topic(
    "site/state",
    "roller_sim_ros/msg/SiteState",
    Direction.PUBLISHED,
    "chainage, m, pass and speed, m/s; true G, Pa, p, m, CMV and mode there; who is master",
    _REVOLUTIONS,
    "per revolution",
)
TACHO = Topic(
    "tacho",
    "roller_sim_ros/msg/TachoPulse",
    Direction.PUBLISHED,
    "pulse of the eccentric's tacho, if there is one: time and phase, s, rad",
    _REVOLUTIONS,
    "per revolution",
)
ODOMETRY = Topic(
    "odom",
    "nav_msgs/msg/Odometry",
    Direction.PUBLISHED,
    "travel speed and dead reckoning, if there is a sensor: m/s, m, odom → base_link",
    _fixed(20),
    "20 Hz",
)
FIX = Topic(
    "fix",
    "sensor_msgs/msg/NavSatFix",
    Direction.PUBLISHED,
    "position by satellite, if there is a receiver: deg, m",
    _fixed(10),
    "10 Hz",
)
FAULTS = Topic(
    "faults",
    "roller_sim_ros/msg/FaultStates",
    Direction.PUBLISHED,
    "faults that are active, and what a correct meter does under each",
    _fixed(1),
    "at start and on change",
    durability="transient_local",
)
MACHINE = Topic(
    "machine",
    "diagnostic_msgs/msg/DiagnosticStatus",
    Direction.PUBLISHED,
    "facts of the roller: name and value of its parameters, SI units in the names",
    _fixed(1),
    "at start and on change",
    durability="transient_local",
)
SOIL = Topic(
    "soil",
    "diagnostic_msgs/msg/DiagnosticStatus",
    Direction.PUBLISHED,
    "facts of the ground: name and value of its parameters, SI units in the names",
    _fixed(1),
    "at start and on change",
    durability="transient_local",
)
DIAGNOSTICS = Topic(
    "/diagnostics",
    "diagnostic_msgs/msg/DiagnosticArray",
    Direction.PUBLISHED,
    "sample rate, lateness, real-time factor, recorder, last refused command",
    _fixed(10),
    "1 Hz",
)
CLOCK = Topic(
    "/clock",
    "rosgraph_msgs/msg/Clock",
    Direction.PUBLISHED,
    "in simulated time only: the time up to which all is simulated, from 0 on; before the messages of its block",
    _fixed(10),
    "per block",
    of_simulated_time=True,
)
EXCITER_COMMAND = Topic(
    "exciter/command",
    "roller_sim_ros/msg/ExciterCommand",
    Direction.SUBSCRIBED,
    "what the exciter is to do: vibrate, Hz, m",
    _fixed(10),
    "by the controller",
)
CMD_VEL = Topic(
    "cmd_vel",
    "geometry_msgs/msg/Twist",
    Direction.SUBSCRIBED,
    "travel speed: linear.x, m/s, forward positive; the rest is not looked at",
    _fixed(10),
    "by the controller",
)
PARAMETER_EVENTS = Topic(
    "/parameter_events",
    "rcl_interfaces/msg/ParameterEvent",
    Direction.RECORDED,
    "parameters set at any node, SI units in the names",
    _fixed(1000),
    "on change",
)

TOPICS: tuple[Topic, ...] = (
    ACCELERATION,
    IMU,
    METER,
    CMV,
    *FURTHER_METERS,
    EXCITER_STATE,
    TRUTH,
    APPLIED,
    INPUTS,
    SITE_STATE,
    TACHO,
    ODOMETRY,
    FIX,
    FAULTS,
    MACHINE,
    SOIL,
    DIAGNOSTICS,
    CLOCK,
    EXCITER_COMMAND,
    CMD_VEL,
    PARAMETER_EVENTS,
)
"""All topics, in the order of the README's table."""
