# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The command line: ``roller-sim COMMAND …``; each command is the module of its name.

A command has ``main(argv: list[str] | None = None) -> int`` and is imported only when it is called, so
that those that need no ROS 2 start quickly and without it.
"""

from __future__ import annotations

import importlib
import os
import sys

from roller_sim_ros import __version__
from roller_sim_ros.errors import RollerSimError

COMMANDS = {
    "sim": "run the roller in real time as a ROS 2 node",
    "panel": "show a roller that runs as a live page in a browser",
    "run": "run the roller without ROS, as fast as it goes",
    "figures": "redraw the figures of the paper",
    "sweep": "map what the roller settles on over a grid of parameters",
    "estimate": "estimate the ground from a trace: shear modulus and plastic parameter",
    "analyze": "evaluate a trace: gaps, meter values, plot and CSV",
    "score": "judge a compaction meter by the truth beside it in a trace",
    "bench": "run a scenario with a compaction meter beside it, and judge the meter",
    "report": "write a trace as one page to look at, HTML and PDF",
    "export": "write a trace as CSV, Parquet, MATLAB, sound or a map",
    "fmu": "write the roller as a functional mock-up unit (FMI)",
    "play": "republish a trace over ROS 2 at its original pace",
    "replay": "compute a trace again from what came into it, and compare bit by bit",
    "recover": "rewrite a trace that was cut off, and state what was lost",
}
"""The commands and a line on each."""

# Modules that only a ROS 2 installation has, and those that are generated there; a missing one is the user's set-up,
# not a defect.
ROS_MODULES = (
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "lifecycle_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rclpy",
    "roller_sim_ros.msg",
    "roller_sim_ros.srv",
    "rosgraph_msgs",
    "rosidl_runtime_py",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
)


def main(argv: list[str] | None = None) -> int:
    """Run the command that the arguments name.

    Parameters
    ----------
    argv : list of str, optional
        Arguments after the program's name; those of the process when left out.

    Returns
    -------
    int
        Exit code: that of the command; 1 after a `RollerSimError`, which is shown as one line; 2 when
        the command line is wrong; 130 when interrupted; 141 when the reader of the output went away.
    """
    arguments = sys.argv[1:] if argv is None else argv
    if not arguments:
        print(_help(), file=sys.stderr)
        return 2
    command, *rest = arguments
    if command in ("-h", "--help"):
        print(_help())
        return 0
    if command == "--version":
        print(f"roller-sim {__version__}")
        return 0
    if command not in COMMANDS:
        names = ", ".join(COMMANDS)
        print(f"roller-sim: error: no command {command!r}; there are {names}", file=sys.stderr)
        return 2
    return _call(command, rest)


def _call(command: str, arguments: list[str]) -> int:
    """Import and run a command; turn what may go wrong for the user into a line and an exit code."""
    try:
        module = importlib.import_module(f"{__name__}.{command}")
        code: int = module.main(arguments)
        sys.stdout.flush()
    except RollerSimError as error:
        return _fail(command, str(error))
    except ModuleNotFoundError as error:
        missing = error.name or ""
        if not any(missing == name or missing.startswith(f"{name}.") for name in ROS_MODULES):
            raise
        return _fail(
            command,
            "needs ROS 2 and this package's messages, which pip does not bring: make setup in a clone of the "
            f"repository brings both, colcon build the messages for a ROS 2 that is there ({error})",
        )
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # Python flushes the output once more when it exits; the pipe must not fail it again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    return code


def _fail(command: str, message: str) -> int:
    print(f"roller-sim {command}: error: {message}", file=sys.stderr)
    return 1


def _help() -> str:
    width = max(map(len, COMMANDS))
    lines = [f"  {name:<{width}}  {line}" for name, line in COMMANDS.items()]
    return "\n".join(
        [
            "usage: roller-sim COMMAND [OPTION ...]",
            "",
            "A vibratory soil-compaction roller: its sensors, emulated by a physical drum/soil model.",
            "",
            "commands:",
            *lines,
            "",
            "roller-sim COMMAND --help tells the options of a command, with units, defaults and an example.",
            "roller-sim --version tells the version.",
        ]
    )
