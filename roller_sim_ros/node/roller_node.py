# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The lifecycle node: transitions, parameters, and what it does once a second."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType  # type: ignore[attr-defined]
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.timer import Timer

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node import parameters
from roller_sim_ros.node.fault_services import FaultServices
from roller_sim_ros.node.namesake import Namesake
from roller_sim_ros.node.parameter_service import CheckedParameterService
from roller_sim_ros.node.report import Report
from roller_sim_ros.node.roller import Roller
from roller_sim_ros.node.simulation_services import SimulationServices
from roller_sim_ros.parameters import PARAMETERS, Value

NAME = "roller_sim"
TICK_S = 0.1
REPORT_S = 1.0


class RollerNode(LifecycleNode):
    """The roller as a ROS 2 node.

    Configured: topics, recording and compiled kernels are there. Active: the roller runs, from standstill.

    Parameters
    ----------
    namespace : str
        Namespace, unless the command line remaps it.
    overrides : mapping
        {dotted name: SI value}, stronger than those of the command line and of files.
    stopping : callable
        Whether the process is asked to end; a long step heeds it.

    Attributes
    ----------
    roller : Roller
        What the transitions act on.
    simulation : SimulationServices
        Steps, states and saved states.
    on_report : callable or None
        Called once a second with the node's `Report`.

    Raises
    ------
    RollerSimError
        If a parameter is unknown or its value refused, or the scenario cannot be read.
    """

    def __init__(
        self,
        *,
        namespace: str = "",
        overrides: Mapping[str, Value] | None = None,
        stopping: Callable[[], bool] = lambda: False,
    ) -> None:
        super().__init__(
            NAME,
            namespace=namespace,
            parameter_overrides=parameters.as_overrides(dict(overrides or {})),
            automatically_declare_parameters_from_overrides=True,
            start_parameter_services=False,
        )
        self._parameter_requests = CheckedParameterService(self)
        self.roller = Roller(self, parameters.declare(self))
        self.on_report: Callable[[Report], None] | None = None
        self._tick_timer: Timer | None = None
        self._next_report = 0.0
        self._echoing = False
        self._namesake = Namesake(self)
        self.add_on_set_parameters_callback(self._on_set_parameters)
        self.simulation = SimulationServices(self, self.roller, stopping)
        self._faults = FaultServices(self, self.roller)

    @property
    def autostart(self) -> bool:
        """Whether the node is to be configured and activated when it starts."""
        return bool(self.get_parameter(parameters.AUTOSTART).value)

    def set_parameters_atomically(
        self, parameter_list: list[Parameter[Any]]
    ) -> SetParametersResult:
        """Set parameters, all or none: what the services for it call.

        Checked here before rclpy does, whose reasons name neither unit nor parameter in all cases.
        """
        items = parameters.floats_for_integers(parameter_list)
        try:
            if not self._echoing:
                self.roller.check(_declared(items))
        except RollerSimError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return super().set_parameters_atomically(items)

    def shut_down(self) -> None:
        """Stop and close everything from whatever state; the node is of no use afterwards."""
        # It cannot shut down twice, nor from within a transition that was interrupted.
        with suppress(RuntimeError):
            self.trigger_shutdown()
        self._release()

    def on_configure(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Compile, open the topics and the recording."""
        return self._transition(self._configure)

    def on_activate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Start the roller from standstill."""
        return self._transition(self._activate)

    def on_deactivate(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Stop the roller; topics and recording stay open."""
        return self._transition(self._deactivate)

    def on_cleanup(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Close the recording and the topics."""
        return self._transition(self._release)

    def on_shutdown(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Stop the roller, close the recording and the topics."""
        return self._transition(self._release)

    def on_error(self, _state: LifecycleState) -> TransitionCallbackReturn:
        """Go back to unconfigured after a transition failed in an unforeseen way."""
        return self._transition(self._release)

    def _transition(self, act: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            act()
        except RollerSimError as error:
            self.get_logger().error(str(error))
            return TransitionCallbackReturn.FAILURE
        except Exception as error:
            # rclpy turns it into ERROR and says nothing.
            self.get_logger().fatal(f"defect: {error!r}")
            raise
        return TransitionCallbackReturn.SUCCESS

    def _configure(self) -> None:
        self.roller.prepare()
        self._next_report = time.monotonic() + REPORT_S
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._tick_timer = self.create_timer(TICK_S, self._tick, clock=steady)

    def _activate(self) -> None:
        self.roller.start()
        self.roller.active = True

    def _deactivate(self) -> None:
        self.roller.active = False
        self.roller.stop()

    def _release(self) -> None:
        self.roller.active = False
        if self._tick_timer is not None:
            self.destroy_timer(self._tick_timer)
            self._tick_timer = None
        self.roller.release()

    def _on_set_parameters(self, items: list[Parameter[Any]]) -> SetParametersResult:
        values = _declared(items)
        try:
            if values and not self._echoing:
                self.roller.change(values)
        except RollerSimError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _tick(self) -> None:
        self.roller.watch()
        now = time.monotonic()
        if now >= self._next_report:
            self._next_report = now + REPORT_S - TICK_S / 2
            self._show_current()
            self._namesake.look()
            report = self.roller.report()
            if self.on_report is not None:
                self.on_report(report)

    def _show_current(self) -> None:
        """Let the parameters say what holds: by a command, by the scenario, by a state that was restored."""
        flat = self.roller.configuration.flat()
        told = [Parameter(name, value=value) for name, value in flat.items()]
        changed = [item for item in told if item.value != self.get_parameter(item.name).value]
        if changed:
            self._echoing = True
            try:
                self.set_parameters_atomically(changed)
            finally:
                self._echoing = False


def _declared(items: list[Parameter[Any]]) -> dict[str, Value]:
    """Return {dotted name: value} of those that are the roller's."""
    return {item.name: item.value for item in items if item.name in PARAMETERS}
