# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The services of the parameters, which refuse what rclpy's own would end the process for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import ParameterException
from rclpy.parameter import Parameter
from rclpy.parameter_service import ParameterService

TYPES = frozenset(kind.value for kind in Parameter.Type)


class CheckedParameterService(ParameterService):
    """Answers every request to set parameters, whatever a client sends as a type or a value."""

    def _set_parameters_callback(self, request: Any, response: Any) -> Any:
        for item in request.parameters:
            response.results.append(self._set([item]))
        return response

    def _set_parameters_atomically_callback(self, request: Any, response: Any) -> Any:
        response.result = self._set(request.parameters)
        return response

    def _set(self, items: Sequence[Any]) -> SetParametersResult:
        for item in items:
            if item.value.type not in TYPES:
                return SetParametersResult(
                    successful=False,
                    reason=f"{item.name!r}: there is no type of parameters {item.value.type}; those there are: "
                    f"0 … {max(TYPES)} (rcl_interfaces/ParameterType)",
                )
        node = self._get_node()
        try:
            return node.set_parameters_atomically(
                [Parameter.from_parameter_msg(it) for it in items]
            )
        except ParameterException as error:
            return SetParametersResult(successful=False, reason=" ".join(str(error).split()))
