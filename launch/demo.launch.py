# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Starts the roller and its live page.

As in ``ros2 launch roller_sim_ros demo.launch.py namespace:=roller_1 record:=trace.mcap scenario:=soft_to_stiff``; the
page is at http://127.0.0.1:8080/.
"""

from __future__ import annotations

from pathlib import Path

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ROLLER = {
    "namespace": "Namespace of the roller and its topics.",
    "params_file": "YAML file with ROS parameters of the roller; some are installed under share/config.",
    "record": "MCAP file to record to; empty: none.",
    "scenario": "Scenario file, or the name of one that the package brings; empty: none.",
}
"""Arguments that are handed on to sim.launch.py."""

PAGE = {
    "bind": ("127.0.0.1", "Address that the page listens on."),
    "port": ("8080", "Port of the page."),
    "token": ("", "What the address of the page must hold; empty: nothing."),
}
"""Arguments that are flags of ``roller-sim panel``."""


def _both(context: LaunchContext) -> list[IncludeLaunchDescription | Node]:
    """Return the roller and the page."""

    def given(name: str) -> str:
        return LaunchConfiguration(name).perform(context)

    roller = {name: given(name) for name in (*ROLLER, "use_sim_time")}
    flags = [word for name in PAGE if given(name) for word in (f"--{name}", given(name))]
    return [
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(str(Path(__file__).with_name("sim.launch.py"))),
            launch_arguments=roller.items(),
        ),
        Node(
            package="roller_sim_ros",
            executable="panel",
            namespace=given("namespace"),
            parameters=[{"use_sim_time": given("use_sim_time") in ("true", "True")}],
            arguments=flags,
            output="screen",
        ),
    ]


def generate_launch_description() -> LaunchDescription:
    """Describe the arguments and the nodes, as `ros2 launch` asks for it."""
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value="", description=text)
                for name, text in ROLLER.items()
            ),
            *(
                DeclareLaunchArgument(name, default_value=default, description=text)
                for name, (default, text) in PAGE.items()
            ),
            DeclareLaunchArgument(
                "use_sim_time",
                default_value="false",
                description="Whether time is the roller's own, on /clock, for roller and page.",
                choices=["true", "false", "True", "False"],
            ),
            OpaqueFunction(function=_both),
        ]
    )
