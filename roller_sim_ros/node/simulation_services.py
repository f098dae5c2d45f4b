# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Services of simulated time: steps, states, reset, saved states; names and results of simulation_interfaces."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from builtin_interfaces.msg import Time
from rclpy.node import Node

from roller_sim_ros.emulation import snapshot
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.msg import Result, SimulationState, SimulatorFeatures
from roller_sim_ros.node.roller import Roller
from roller_sim_ros.node.run import Run
from roller_sim_ros.node.step_length import check_advance, check_samples
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.parameters.quantity import shown
from roller_sim_ros.srv import (
    Advance,
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    RestoreState,
    SaveState,
    SetSimulationState,
    StepSimulation,
)

STOPPED, PLAYING, PAUSED, QUITTING = (
    SimulationState.STATE_STOPPED,
    SimulationState.STATE_PLAYING,
    SimulationState.STATE_PAUSED,
    SimulationState.STATE_QUITTING,
)
_NAMES = {STOPPED: "stopped", PLAYING: "playing", PAUSED: "paused", QUITTING: "quitting"}


class Refused(RollerSimError):
    """A request that is answered with another result than OK.

    Attributes
    ----------
    result : int
        The result; the message is for a reader.
    """

    def __init__(self, result: int, reason: str) -> None:
        super().__init__(reason)
        self.result = result


class SimulationServices:
    """The services, which act on the roller in the executor's thread.

    Parameters
    ----------
    node : rclpy.node.Node
        Whose services they are.
    roller : Roller
        On what they act.
    stopping : callable
        Whether the process is asked to end: a step is cut short then.

    Attributes
    ----------
    quitting : bool
        Whether a client asked the process to end.
    """

    def __init__(self, node: Node, roller: Roller, stopping: Callable[[], bool]) -> None:
        self.quitting = False
        self._roller = roller
        self._stopping = stopping
        for service, name, act in (
            (StepSimulation, "step_simulation", self._step),
            (Advance, "advance", self._advance),
            (ResetSimulation, "reset_simulation", self._reset),
            (SetSimulationState, "set_simulation_state", self._set_state),
            (SaveState, "save_state", self._save),
            (RestoreState, "restore_state", self._restore),
        ):
            node.create_service(service, name, _answering(act))
        node.create_service(GetSimulationState, "get_simulation_state", self._get_state)
        node.create_service(GetSimulatorFeatures, "get_simulator_features", self._get_features)

    @property
    def state(self) -> int:
        """What GetSimulationState says."""
        if self.quitting:
            return int(QUITTING)
        if not self._roller.running:
            return int(STOPPED)
        return int(PLAYING if self._roller.playing else PAUSED)

    def _step(self, request: Any, _response: Any) -> None:
        run = self._paused(Result.RESULT_OPERATION_FAILED)
        check_samples(request.steps)
        self._drive(run, lambda: run.step(request.steps, self._going_on(run)))

    def _advance(self, request: Any, response: Any) -> None:
        run = self._paused(Result.RESULT_INCORRECT_STATE)
        revolutions, seconds = request.revolutions, request.seconds
        check_advance(revolutions, seconds)
        going_on = self._going_on(run)
        try:
            if revolutions:
                self._drive(run, lambda: run.step(revolutions * SAMPLES_PER_REVOLUTION, going_on))
            else:
                self._drive(run, lambda: run.step_for(seconds, going_on))
        finally:
            response.next_sample = run.next_sample
            second, nanosecond = divmod(run.time_ns, 10**9)
            response.stamp = Time(sec=second, nanosec=nanosecond)

    def _reset(self, request: Any, _response: Any) -> None:
        time_and_state = ResetSimulation.Request.SCOPE_TIME | ResetSimulation.Request.SCOPE_STATE
        scope = request.scope or ResetSimulation.Request.SCOPE_ALL
        if scope & time_and_state != time_and_state:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                f"scope {request.scope}: time and state are reset together, by scope 0 or 255, and nothing is spawned",
            )
        if self._roller.running:
            self._roller.reset()

    def _set_state(self, request: Any, _response: Any) -> None:
        roller, wanted, now = self._roller, request.state.state, self.state
        if wanted not in _NAMES:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                f"state {wanted}: must be one of {', '.join(f'{k} ({v})' for k, v in _NAMES.items())}",
            )
        if wanted == now:
            raise Refused(
                SetSimulationState.Response.ALREADY_IN_TARGET_STATE, f"is {_NAMES[now]} already"
            )
        if wanted == QUITTING:
            self.quitting = True
            return
        if not roller.active:
            raise Refused(
                Result.RESULT_INCORRECT_STATE,
                "the node is not active: activate it (lifecycle) first",
            )
        if wanted == PLAYING and roller.lock_step:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                "time does not go on by itself in lock step: call step_simulation or advance, or start without "
                "pacing.lock_step",
            )
        if wanted == PAUSED and not roller.simulated_time:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                "real time cannot be paused: start with pacing.clock sim (--clock sim)",
            )
        try:
            if wanted == STOPPED:
                roller.stop()
            elif now == STOPPED:
                roller.start(paused=wanted == PAUSED)
            elif wanted == PLAYING:
                roller.play()
            else:
                roller.pause()
        except RollerSimError as error:
            raise Refused(SetSimulationState.Response.STATE_TRANSITION_ERROR, str(error)) from error

    def _get_state(self, _request: Any, response: Any) -> Any:
        response.state.state = self.state
        response.result.result = Result.RESULT_OK
        return response

    def _get_features(self, _request: Any, response: Any) -> Any:
        features = [
            SimulatorFeatures.SIMULATION_RESET,
            SimulatorFeatures.SIMULATION_STATE_GETTING,
            SimulatorFeatures.SIMULATION_STATE_SETTING,
        ]
        if self._roller.simulated_time:
            features += [
                SimulatorFeatures.SIMULATION_STATE_PAUSE,
                SimulatorFeatures.STEP_SIMULATION_SINGLE,
                SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
            ]
        response.features.features = features
        clock = "simulated time" if self._roller.simulated_time else "real time"
        pace = ", in lock step" if self._roller.lock_step else ""
        response.features.custom_info = (
            f"roller_sim_ros in {clock}{pace}; a step is one sample, advance steps by more"
        )
        return response

    def _save(self, request: Any, response: Any) -> None:
        run = self._running()
        # A block that is computed and not yet out would be lost to the state.
        state = self._roller.between_blocks(lambda: snapshot.save(run.emulator))
        if not request.path:
            response.state = state
            return
        try:
            # Nothing that is there is overwritten.
            with Path(request.path).open("xb") as file:
                file.write(state)
        except (OSError, ValueError) as error:
            raise Refused(
                Result.RESULT_OPERATION_FAILED, f"path {shown(request.path)}: {_said(error)}"
            ) from error

    def _restore(self, request: Any, _response: Any) -> None:
        if not self._roller.simulated_time:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                "real time does not go back: start with pacing.clock sim (--clock sim)",
            )
        self._running()
        if request.path and request.state:
            raise Refused(
                Result.RESULT_OPERATION_FAILED, "path and state: one of them must be empty"
            )
        state = bytes(request.state)
        if request.path:
            try:
                state = Path(request.path).read_bytes()
            except FileNotFoundError:
                raise Refused(
                    Result.RESULT_NOT_FOUND, f"path {shown(request.path)}: there is no such file"
                ) from None
            except (OSError, ValueError) as error:
                raise Refused(
                    Result.RESULT_OPERATION_FAILED, f"path {shown(request.path)}: {_said(error)}"
                ) from error
        self._roller.go_on(snapshot.restore(state, told=True))

    def _running(self) -> Run:
        run = self._roller.run
        if run is None:
            raise Refused(
                Result.RESULT_INCORRECT_STATE,
                "nothing runs: activate the node (lifecycle), or set the state to paused or playing",
            )
        return run

    def _paused(self, otherwise: int) -> Run:
        if not self._roller.simulated_time:
            raise Refused(
                Result.RESULT_FEATURE_UNSUPPORTED,
                "real time is not stepped: start with pacing.lock_step (--lock-step) or pacing.clock sim",
            )
        if self.state != PAUSED:
            raise Refused(
                otherwise, f"the simulation is {_NAMES[self.state]}: set its state to paused first"
            )
        return self._running()

    def _going_on(self, run: Run) -> Callable[[], bool]:
        at_end = self._roller.stop_at_end
        return lambda: not self._stopping() and not (at_end and run.ended)

    def _drive(self, run: Run, steps: Callable[[], bool]) -> None:
        """Step, and say so if it did not come to the end.

        Raises
        ------
        Refused
            Then.
        """
        try:
            whole = steps()
        except Exception as error:
            self._roller.failed(error)
            raise Refused(
                Result.RESULT_OPERATION_FAILED, f"the roller failed: {error!r}"
            ) from error
        if not whole and not run.ended:
            raise Refused(Result.RESULT_OPERATION_FAILED, "the process is ending")


def _answering(act: Callable[[Any, Any], None]) -> Callable[[Any, Any], Any]:
    """Return the callback of a service: what `act` raises becomes its result."""

    def answer(request: Any, response: Any) -> Any:
        try:
            act(request, response)
        except Refused as error:
            response.result = Result(result=error.result, error_message=str(error))
        except RollerSimError as error:
            response.result = Result(
                result=Result.RESULT_OPERATION_FAILED, error_message=str(error)
            )
        else:
            response.result = Result(result=Result.RESULT_OK)
        return response

    return answer


def _said(error: Exception) -> str:
    return str(getattr(error, "strerror", None) or error)
