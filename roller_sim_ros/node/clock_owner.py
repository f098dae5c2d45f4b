# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Who publishes ``/clock``: one on a network, or nobody's time is right."""

from __future__ import annotations

from rclpy.node import Node

from roller_sim_ros.wire import topics


class ClockOwner:
    """Looks for others that publish ``/clock`` beside a node that does.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    owns : bool
        Whether it publishes it.

    Attributes
    ----------
    rivals : tuple of str
        The nodes that do so, too, as of the last look.
    """

    def __init__(self, node: Node, *, owns: bool) -> None:
        self.rivals: tuple[str, ...] = ()
        self._node = node
        self._owns = owns

    def look(self) -> None:
        """Look for others, and log it when there are new ones."""
        if not self._owns:
            return
        others = [
            f"{item.node_namespace.rstrip('/')}/{item.node_name}"
            for item in self._node.get_publishers_info_by_topic(topics.CLOCK.name)
        ]
        # One of them is this node's own; another of the same name is a rival all the same.
        own = self._node.get_fully_qualified_name()
        if own in others:
            others.remove(own)
        rivals = tuple(sorted(others))
        if set(rivals) - set(self.rivals):
            self._node.get_logger().warning(said(rivals))
        self.rivals = rivals


def said(rivals: tuple[str, ...]) -> str:
    """Return what there is to say of rivals."""
    return (
        f"/clock is published by {', '.join(rivals)}, too: time has one owner on a network; end the other, or start "
        "this node with pacing.publish_clock false"
    )
