# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Services that break the roller's sensors and mend them, and the one that hands it back to the scenario."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rclpy.node import Node
from std_srvs.srv import Trigger

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.faults import FAULTS, FaultRefused, Span
from roller_sim_ros.node.roller import Roller
from roller_sim_ros.parameters import Value
from roller_sim_ros.parameters.quantity import declared, shown, shown_name
from roller_sim_ros.srv import ClearFaults, InjectFault


class FaultServices:
    """``inject_fault``, ``clear_faults`` and ``release``.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose services they are.
    roller : Roller
        On what they act.
    """

    def __init__(self, node: Node, roller: Roller) -> None:
        self._roller = roller
        node.create_service(InjectFault, "inject_fault", self._inject)
        node.create_service(ClearFaults, "clear_faults", self._clear)
        node.create_service(Trigger, "release", self._release)

    def _inject(self, request: Any, response: Any) -> Any:
        try:
            run = self._run("inject_fault")
            values = typed(request.fault_id, request.names, request.values)
            span = Span(request.duration_s) if request.duration_s != 0.0 else None
            response.handle = run.emulator.inject(request.fault_id, values, span=span)
        except RollerSimError as error:
            response.message = str(error)
        else:
            response.success = True
        return response

    def _clear(self, request: Any, response: Any) -> Any:
        try:
            self._run("clear_faults").emulator.clear(request.handle or None)
        except RollerSimError as error:
            response.message = str(error)
        else:
            response.success = True
        return response

    def _release(self, _request: Any, response: Any) -> Any:
        try:
            self._run("release")
            self._roller.inputs.release()
        except RollerSimError as error:
            response.message = str(error)
        else:
            response.success = True
        return response

    def _run(self, what: str) -> Any:
        run = self._roller.run
        if run is None:
            raise RollerSimError(f"{what}: the roller is not active; activate it first")
        return run


def typed(fault_id: str, names: Sequence[str], texts: Sequence[str]) -> dict[str, Value]:
    """Return a fault's parameters from texts, of the types that they are declared with.

    Raises
    ------
    FaultRefused
        If names and values do not go together, or a text is none of a number or of true or false.
    """
    if len(names) != len(texts):
        raise FaultRefused(
            f"{len(names)} names and {len(texts)} values: there must be one value for each name"
        )
    if len(set(names)) != len(names):
        raise FaultRefused(f"a name is given twice: {', '.join(map(shown_name, names))}")
    fault = FAULTS.get(fault_id)
    defaults = {name: default for name, _, default in declared(fault)} if fault else {}
    return {
        name: _value(name, text, defaults.get(name))
        for name, text in zip(names, texts, strict=True)
    }


def _value(name: str, text: str, default: Value | None) -> Value:
    if isinstance(default, bool):
        if text not in ("true", "false"):
            raise FaultRefused(f"{name} = {shown(text)}: must be true or false")
        return text == "true"
    if isinstance(default, int | float):
        try:
            number = float(text)
        except ValueError:
            raise FaultRefused(f"{name} = {shown(text)}: must be a number") from None
        whole = isinstance(default, int) and number.is_integer()
        return int(number) if whole else number
    return text
