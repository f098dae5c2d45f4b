# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The process around the node: start, executor loop, orderly end."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence

import rclpy
from rclpy.exceptions import InvalidNamespaceException
from rclpy.executors import Executor, SingleThreadedExecutor
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.signals import SignalHandlerOptions
from rclpy.validate_namespace import validate_namespace

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.report import Report
from roller_sim_ros.node.roller import Roller
from roller_sim_ros.node.roller_node import RollerNode
from roller_sim_ros.node.signals import Signals
from roller_sim_ros.parameters import Value

SPIN_S = 0.1
"""How long the executor waits at most: a signal is noticed within it."""

SWITCH_INTERVAL_S = 0.5e-3
"""How long the executor's thread may keep the interpreter from the pacing thread."""


def run_node(
    ros_arguments: Sequence[str],
    signals: Signals,
    *,
    namespace: str = "",
    overrides: Mapping[str, Value] | None = None,
    exit_at_end: bool = False,
    on_report: Callable[[Report], None] | None = None,
    on_end: Callable[[Roller], None] | None = None,
) -> int:
    """Run the node until SIGINT or SIGTERM, or until a client or the end of the scenario ends it.

    Parameters
    ----------
    ros_arguments : sequence of str
        ``--ros-args`` and what follows.
    signals : Signals
        What ends the node.
    namespace : str
        Namespace of the node.
    overrides : mapping
        {dotted name: SI value} that hold whatever files and arguments say.
    exit_at_end : bool
        End where all that the scenario planned has been driven, with that sample.
    on_report, on_end : callable
        Called once a second while the node is configured, and when all is closed.

    Returns
    -------
    int
        0 after an orderly end; 1 when the node could not start, which the log says.

    Raises
    ------
    RollerSimError
        If an argument or a parameter is refused, or the roller fails while it runs.
    KeyboardInterrupt
        If a signal came before it ran.
    """
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    node: RollerNode | None = None
    try:
        _initialise(ros_arguments)
        _check_namespace(namespace)
        node = RollerNode(namespace=namespace, overrides=overrides, stopping=lambda: signals.stop)
        if exit_at_end and not node.roller.configuration.scenario.path:
            raise RollerSimError("--exit-at-end: there is no end without a scenario (--scenario)")
        node.on_report = on_report
        node.roller.stop_at_end = exit_at_end
        if node.autostart and not _autostart(node):
            return 1
        signals.running = True
        _spin(node, signals)
    finally:
        signals.running = True
        _end(node)
    if on_end is not None:
        on_end(node.roller)
    return 0


def _initialise(ros_arguments: Sequence[str]) -> None:
    try:
        # rclpy's own handlers would take the context away before the node could say that it ends.
        rclpy.init(args=list(ros_arguments), signal_handler_options=SignalHandlerOptions.NO)
    except Exception as error:
        raise RollerSimError(f"ROS 2 refuses its arguments: {_first_line(error)}") from error


def _check_namespace(namespace: str) -> None:
    try:
        validate_namespace(f"/{namespace.strip('/')}")
    except InvalidNamespaceException as error:
        reason = " ".join(str(error).split())
        raise RollerSimError(f"--namespace {namespace}: {reason}") from error


def _autostart(node: RollerNode) -> bool:
    success = TransitionCallbackReturn.SUCCESS
    return node.trigger_configure() == success and node.trigger_activate() == success


def _spin(node: RollerNode, signals: Signals) -> None:
    executor = _executor(node)
    executor.add_node(node)
    try:
        while not signals.stop:
            executor.spin_once(timeout_sec=SPIN_S)
            if node.simulation.quitting or (node.roller.stop_at_end and node.roller.ended):
                break
            if node.roller.failure is not None:
                raise RollerSimError(
                    f"the roller failed: {node.roller.failure!r}"
                ) from node.roller.failure
    finally:
        executor.remove_node(node)


def _executor(node: RollerNode) -> Executor:
    """Return the executor: in lock step, where each step is a call, the one that costs a third of the other's time.

    It is experimental, and older releases have none; its `spin_once` is sound, its `spin` is not.
    """
    if node.roller.lock_step:
        try:
            from rclpy.experimental.events_executor import EventsExecutor
        except ImportError:
            pass
        else:
            return EventsExecutor()
    return SingleThreadedExecutor()


def _end(node: RollerNode | None) -> None:
    if node is not None:
        node.shut_down()
        node.destroy_node()
    if rclpy.ok():
        rclpy.shutdown()


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0] if str(error).strip() else repr(error)
