# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What clients want of the roller: exciter and travel commands, changes of parameters, release; and the watchdogs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rosbags.serde import SerdeError

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.node.command_input import COMMANDED, CommandInput, stopped
from roller_sim_ros.parameters import Configuration, Exciter, Value
from roller_sim_ros.session import CommandRefused, ExciterCommand, ExciterStatus, Refusal
from roller_sim_ros.session.command import checked_speed
from roller_sim_ros.wire import messages, topics
from roller_sim_ros.wire.messages import Message
from roller_sim_ros.wire.types import decode


class Inputs:
    """Hands on what comes in to the emulator that runs, and tells what became of it.

    Parameters
    ----------
    warn : callable
        Takes what is to be logged of refusals.
    answer : callable
        Takes code and reason of a refusal that no emulator can tell, since none runs.
    now_s : callable
        Time by which the watchdogs count, s.

    Attributes
    ----------
    emulator : Emulator or None
        Who obeys; none while the roller is not active.
    exciter, travel : CommandInput
        What came of the commands.
    """

    def __init__(
        self,
        warn: Callable[[str], None],
        answer: Callable[[Refusal, str], None],
        now_s: Callable[[], float],
    ) -> None:
        self.emulator: Emulator | None = None
        self._warn = warn
        self._answer = answer
        self.exciter = CommandInput(now_s)
        self.travel = CommandInput(now_s)
        self._driven_m_s = 0.0

    def begin(self, emulator: Emulator) -> None:
        """Obey on behalf of an emulator from now on; the watchdogs count from now."""
        self.emulator = emulator
        self._driven_m_s = 0.0
        self.exciter.alive()
        self.travel.alive()

    def end(self) -> None:
        """Refuse commands from now on."""
        self.emulator = None

    def take_exciter(self, data: bytes) -> None:
        """Take the bytes of an ``exciter/command``."""
        if self._lost():
            return
        try:
            message = _decoded(data, topics.EXCITER_COMMAND)
            if self.emulator is None:
                raise CommandRefused(
                    Refusal.NOT_ACTIVE,
                    f"frequency {message.frequency:g} Hz, amplitude {message.amplitude:g} m: "
                    "the roller is not active",
                )
            _obey(
                self.emulator,
                ExciterCommand(message.vibrate, message.frequency, message.amplitude),
            )
        except CommandRefused as error:
            self._refuse_exciter(error.code, f"command refused: {error}", str(error))
        else:
            self.exciter.accepted()

    def take_travel(self, data: bytes) -> None:
        """Take the bytes of a ``cmd_vel``."""
        if self._lost():
            return
        try:
            speed_m_s = checked_speed(_decoded(data, topics.CMD_VEL).linear.x)
            if self.emulator is None:
                raise CommandRefused(
                    Refusal.NOT_ACTIVE, f"speed {speed_m_s:g} m/s: the roller is not active"
                )
            self.emulator.command_travel(speed_m_s)
        except CommandRefused as error:
            if self.travel.refuse(error.code, str(error)):
                self._warn(f"travel command refused: {error}")
        else:
            self._driven_m_s = speed_m_s
            self.travel.accepted()

    def change(self, values: Mapping[str, Value]) -> None:
        """Change live parameters of the emulator that runs, if one does.

        Raises
        ------
        ParameterError
            If a value is refused.
        """
        if self.emulator is not None:
            self.emulator.change(values)
        if any(name in COMMANDED for name in values):
            self.exciter.accepted()

    def release(self) -> None:
        """Hand exciter and travel back to the scenario."""
        if self.emulator is not None:
            self.emulator.release()
        self._driven_m_s = 0.0
        self.exciter.accepted()
        self.travel.accepted()

    def watch(self) -> None:
        """Let the exciter run down, and the roller stop, when commands fail to come."""
        emulator = self.emulator
        if emulator is None:
            return
        watched = emulator.session.configuration
        timeout_s = watched.travel.command_timeout_s
        if watched.exciter.command_timeout_s <= 0.0 and timeout_s <= 0.0:
            return
        if self._lost():
            # The machine goes on with the last command, which the frozen link seems to repeat.
            self.exciter.alive()
            self.travel.alive()
            return
        exciter = upcoming(emulator).exciter
        overdue = self.exciter.overdue(exciter)
        if overdue:
            _obey(emulator, stopped(exciter))
            self._refuse_exciter(Refusal.TIMEOUT, overdue, overdue)
        silent_s = self.travel.silent_s()
        if self._driven_m_s and 0.0 < timeout_s < silent_s:
            emulator.command_travel(0.0)
            self._driven_m_s = 0.0
            reason = (
                f"no travel command for {silent_s:.2f} s: at most {timeout_s:g} s "
                "(travel.command_timeout_s); the roller stops"
            )
            if self.travel.refuse(Refusal.TIMEOUT, reason):
                self._warn(reason)

    def _lost(self) -> bool:
        """Whether a fault keeps commands from arriving."""
        return self.emulator is not None and self.emulator.instruments.faults.link_frozen

    def _refuse_exciter(self, code: Refusal, line: str, reason: str) -> None:
        if self.exciter.refuse(code, reason):
            self._warn(line)
        if self.emulator is not None:
            self.emulator.refuse(code, reason)
        else:
            self._answer(code, reason)


def upcoming(emulator: Emulator) -> Configuration:
    """Return the configuration of an emulator with what waits for the next multiple of 128 samples."""
    with emulator.held():
        return emulator.session.upcoming


def standing(exciter: Exciter, stamp_ns: int, code: Refusal, reason: str) -> Message:
    """Return the ``exciter/state`` of a roller that is not active."""
    status = ExciterStatus(
        vibrating=False,
        commanded_frequency_hz=exciter.frequency_hz,
        commanded_amplitude_m=exciter.amplitude_m,
        frequency_hz=0.0,
        amplitude_m=0.0,
        force_amplitude_n=0.0,
        applied_sample=0,
    )
    return messages.exciter_state(status, stamp_ns, code, reason)


def _obey(emulator: Emulator, command: ExciterCommand) -> None:
    emulator.command(
        vibrate=command.vibrate,
        frequency_hz=command.frequency_hz,
        amplitude_m=command.amplitude_m,
    )


def _decoded(data: bytes, topic: topics.Topic) -> Any:
    """Return the message of a command.

    Raises
    ------
    CommandRefused
        If the bytes are none.
    """
    try:
        return decode(data, topic.type_name)
    except SerdeError as error:
        name = topic.type_name.rpartition("/")[2]
        reason = f"message of {len(data)} bytes: is no {name} ({error})"
        raise CommandRefused(Refusal.DAMAGED, reason) from None
