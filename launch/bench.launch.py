# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Runs a scenario with a meter beside it and judges the meter, as ``roller-sim bench`` does.

As in ``ros2 launch roller_sim_ros bench.launch.py scenario:=soft_to_stiff meter:="ros2 run my_meters cmv"``. The
launch ends with the bench; the verdict is on the screen and in ``score.xml`` and ``score.json`` of the folder ``out``,
beside the recording, and not in the exit code of ``ros2 launch``: that is for ``ros2 run roller_sim_ros bench``. Roller
and meter are alone in a ROS domain of their own, so that there is no namespace to give; roller and ground are the
scenario's, time is the roller's own unless ``clock:=real``.
"""

from __future__ import annotations

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.substitutions import ExecutableInPackage

SCENARIO = "Scenario file, or the name of one that the package brings."

FLAGS = {
    "meter": "What starts the meter under test; empty: the roller's own meter is judged.",
    "topic": "Topic of the meter; empty: the only one that it publishes.",
    "limits": "YAML file with limits; empty: the defaults.",
    "junit": "File for the verdict as JUnit XML; empty: score.xml in the folder out.",
    "out": "Folder for trace, logs and verdict; empty: bench/ and the scenario's name.",
    "clock": "lock-step, sim or real; empty: lock-step.",
    "speed": "Simulated over real time, with clock:=sim.",
}
"""Arguments that are flags of ``roller-sim bench``."""


def _bench(context: LaunchContext) -> list[ExecuteProcess]:
    """Return the process; only arguments that were given are handed on, so that its own defaults hold."""

    def given(name: str) -> str:
        return LaunchConfiguration(name).perform(context)

    flags = [word for name in FLAGS if given(name) for word in (f"--{name}", given(name))]
    # Not a Node, whose --ros-args are for one node: the bench starts several.
    program = ExecutableInPackage(package="roller_sim_ros", executable="bench")
    return [
        ExecuteProcess(
            cmd=[program, given("scenario"), *flags],
            output="screen",
            on_exit=[Shutdown(reason="the bench has ended")],
        )
    ]


def generate_launch_description() -> LaunchDescription:
    """Describe the arguments and the process, as `ros2 launch` asks for it."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("scenario", description=SCENARIO),
            *(
                DeclareLaunchArgument(name, default_value="", description=doc)
                for name, doc in FLAGS.items()
            ),
            OpaqueFunction(function=_bench),
        ]
    )
