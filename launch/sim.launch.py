"""Starts the roller.

As in ``ros2 launch roller_sim_ros sim.launch.py namespace:=roller_1 record:=trace.mcap``.
"""

from __future__ import annotations

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def _roller(context: LaunchContext) -> list[Node]:
    """Return the node; only arguments that were given are handed on, so that its own defaults hold."""

    def given(name: str) -> str:
        return LaunchConfiguration(name).perform(context)

    parameters: list[str | dict[str, bool]] = []
    if given("params_file"):
        parameters.append(given("params_file"))
    parameters.append({"autostart": given("autostart").lower() in ("true", "1")})
    return [
        Node(
            package="roller_sim_ros",
            executable="sim",
            name="roller_sim",
            namespace=given("namespace"),
            parameters=parameters,
            arguments=["--record", given("record")] if given("record") else [],
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
            DeclareLaunchArgument(
                "record", default_value="", description="MCAP file to record to; empty: none."
            ),
            DeclareLaunchArgument(
                "autostart",
                default_value="true",
                description="Whether the node configures and activates itself.",
            ),
            OpaqueFunction(function=_roller),
        ]
    )
