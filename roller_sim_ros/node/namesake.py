# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Another node of the same name: its topics and services are mixed with one's own."""

from __future__ import annotations

from rclpy.node import Node


class Namesake:
    """Looks for another node of the same name in the same namespace, and logs it once when there is one.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._there = False

    def look(self) -> None:
        """Look for it."""
        own = (self._node.get_name(), self._node.get_namespace())
        there = self._node.get_node_names_and_namespaces().count(own) > 1
        if there and not self._there:
            self._node.get_logger().warning(
                f"another node is called {self._node.get_fully_qualified_name()}, too: nobody can tell their topics "
                "and services apart; end the other, or start this one with --namespace"
            )
        self._there = there
