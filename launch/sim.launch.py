# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Starts the roller.

As in ``ros2 launch roller_sim_ros sim.launch.py namespace:=roller_1 record:=trace.mcap scenario:=soft_to_stiff``.
"""

from __future__ import annotations

from pathlib import Path

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

FLAGS = {
    "record": "MCAP file to record to; empty: none.",
    "scenario": "Scenario file, or the name of one that the package brings; empty: none.",
    "clock": "real or sim; empty: real, unless a parameter says otherwise.",
    "speed": "Simulated over real time, 0: as fast as possible; with clock:=sim.",
}
"""Arguments that are flags of ``roller-sim sim`` with a value."""

YES_OR_NO = ["true", "false", "True", "False"]

SWITCHES = {
    "lock_step": "Whether time stands still until a client steps it.",
    "exit_at_end": "Whether the node ends when all that the scenario plans has been driven.",
}
"""Arguments that are flags without a value."""


def _roller(context: LaunchContext) -> list[Node]:
    """Return the node; only arguments that were given are handed on, so that its own defaults hold."""

    def given(name: str) -> str:
        return LaunchConfiguration(name).perform(context)

    def yes(name: str) -> bool:
        return given(name) in ("true", "True")

    parameters: list[str | dict[str, bool]] = []
    if given("params_file"):
        # Of a file that is not there, launch only warns, and starts the node without it.
        if not Path(given("params_file")).is_file():
            raise RuntimeError(f"params_file:={given('params_file')}: there is no such file")
        parameters.append(given("params_file"))
    parameters.append({"autostart": yes("autostart")})
    flags = [word for name in FLAGS if given(name) for word in (f"--{name}", given(name))]
    if yes("use_sim_time") and not given("clock"):
        flags += ["--clock", "sim"]
    switches = [f"--{name.replace('_', '-')}" for name in SWITCHES if yes(name)]
    return [
        Node(
            package="roller_sim_ros",
            executable="sim",
            name="roller_sim",
            namespace=given("namespace"),
            parameters=parameters,
            arguments=[*flags, *switches],
            output="screen",
            emulate_tty=True,
        )
    ]


def generate_launch_description() -> LaunchDescription:
    """Describe the arguments and the node, as `ros2 launch` asks for it."""
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "namespace", default_value="", description="Namespace of the node and its topics."
            ),
            DeclareLaunchArgument(
                "params_file",
                default_value="",
                description="YAML file with ROS parameters; some are installed under share/config.",
            ),
            *(
                DeclareLaunchArgument(name, default_value="", description=text)
                for name, text in FLAGS.items()
            ),
            *(
                DeclareLaunchArgument(
                    name, default_value="false", description=text, choices=YES_OR_NO
                )
                for name, text in SWITCHES.items()
            ),
            DeclareLaunchArgument(
                "use_sim_time",
                default_value="false",
                description="Whether time is the roller's own, on /clock; the same as clock:=sim.",
                choices=YES_OR_NO,
            ),
            DeclareLaunchArgument(
                "autostart",
                default_value="true",
                description="Whether the node configures and activates itself.",
                choices=YES_OR_NO,
            ),
            OpaqueFunction(function=_roller),
        ]
    )
