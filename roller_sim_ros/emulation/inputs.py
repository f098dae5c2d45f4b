# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What comes into a run from outside, noted at its sample, so that the run can be computed again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters.quantity import shown


class InputKind(Enum):
    """What came; the texts of the message's ``kind``."""

    BEGIN = "begin"
    """The run begins: ``start_ns``, ``run_up``, ``seed``, ``parameters``, ``sensors``, ``scenario``, ``parts``."""
    RESTORE = "restore"
    """It goes on from a saved state."""
    COMMAND = "command"
    TRAVEL = "travel"
    RELEASE = "release"
    CHANGE = "change"
    INJECT = "inject"
    CLEAR = "clear"
    REFUSE = "refuse"
    """``exciter/state`` is to say that a command was refused."""


@dataclass(frozen=True)
class Input:
    """Something that came in.

    Attributes
    ----------
    sample : int
        Index of the sample that was the next one then.
    kind : InputKind
        What it is.
    arguments : mapping
        Of the emulator's method of that name, plain values.
    state : bytes
        RESTORE: as `roller_sim_ros.emulation.snapshot.save` gave it.
    """

    sample: int
    kind: InputKind
    arguments: Mapping[str, Any] = field(default_factory=dict)
    state: bytes = b""

    @property
    def text(self) -> str:
        """The arguments as one JSON object; numbers come back from it to the last bit."""
        return json.dumps(self.arguments, ensure_ascii=False)


class InputError(RollerSimError):
    """An input that was recorded is none of this version."""


def input_of(message: Any) -> Input:
    """Return the input that a message of ``inputs`` tells of.

    Raises
    ------
    InputError
        If it is of another kind, or its arguments are none.
    """
    try:
        arguments = json.loads(message.arguments)
        kind = InputKind(message.kind)
    except (ValueError, RecursionError):
        raise InputError(
            f"the input {shown(message.kind)} at sample {message.sample} is not understood by this version"
        ) from None
    if not isinstance(arguments, dict):
        raise InputError(f"the input {kind.value} at sample {message.sample} has no arguments")
    return Input(int(message.sample), kind, arguments, bytes(message.state))
