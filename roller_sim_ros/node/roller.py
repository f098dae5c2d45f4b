# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The roller behind the node: topics, recording, commands, and the run with its time."""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable, Mapping
from typing import TypeVar

from rclpy.node import Node

from roller_sim_ros.emulation import Emulator, snapshot
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.beginning import Beginning
from roller_sim_ros.node.inputs import Inputs, standing, upcoming
from roller_sim_ros.node.lateness import Lateness
from roller_sim_ros.node.pacing import Pacer
from roller_sim_ros.node.realtime import request_scheduling
from roller_sim_ros.node.report import Drive, RecordingReport, Report, diagnostics
from roller_sim_ros.node.run import Run
from roller_sim_ros.node.station import Station
from roller_sim_ros.node.warm_up import try_out, warm_up
from roller_sim_ros.parameters import PARAMETERS, Configuration, ParameterError, Value
from roller_sim_ros.session import Refusal
from roller_sim_ros.wire import messages, topics

T = TypeVar("T")


class Roller:
    """Prepared, it has its topics and its recording; started, it runs: in real time, or in time of its own.

    All calls come from one thread, that of the node's executor; only the pacing thread works beside it.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    beginning : Beginning
        All parameters, and the scenario.

    Attributes
    ----------
    inputs : Inputs
        Who takes what clients want.
    active : bool
        Whether the node is: a client may stop and start the run then.
    stop_at_end : bool
        Whether time stands still where all that the scenario planned has been driven.
    last_report : Report or None
        The last one while the roller ran.
    """

    def __init__(self, node: Node, beginning: Beginning) -> None:
        self.active = False
        self.stop_at_end = False
        self.last_report: Report | None = None
        self._node = node
        self._beginning = beginning
        self._configuration = beginning.configuration
        self._prepared: Configuration | None = None
        self._pacer: Pacer | None = None
        self._step_failure: Exception | None = None
        self._reported = (0.0, 0.0)
        self.inputs = Inputs(self._warn, self._answer, self._watched_s)
        self._station = Station(
            node,
            {
                topics.EXCITER_COMMAND: self.inputs.take_exciter,
                topics.CMD_VEL: self.inputs.take_travel,
            },
            self.now_ns,
        )

    @property
    def configuration(self) -> Configuration:
        """All parameters as they were last accepted; commands count as parameters of the exciter."""
        if self._pacer is None:
            return self._configuration
        return self._configuration.changed(
            {
                name: value
                for name, value in upcoming(self._pacer.run.emulator).flat().items()
                if not name.startswith(_OF_THE_NODE)
            }
        )

    @property
    def last_recording(self) -> RecordingReport | None:
        """What became of the last recording that was closed."""
        return self._station.last_recording

    @property
    def running(self) -> bool:
        """Whether it was started and not stopped; it may be paused."""
        return self._pacer is not None

    @property
    def run(self) -> Run | None:
        """What runs."""
        return self._pacer.run if self._pacer else None

    @property
    def playing(self) -> bool:
        """Whether time goes on by itself."""
        return self._pacer is not None and self._pacer.playing

    @property
    def simulated_time(self) -> bool:
        """Whether time is that of the samples."""
        return self._configuration.pacing.simulated_time

    @property
    def lock_step(self) -> bool:
        """Whether time goes on only when a client steps it."""
        return self._configuration.pacing.lock_step

    @property
    def ended(self) -> bool:
        """Whether all that the scenario planned has been driven."""
        return self._pacer is not None and self._pacer.run.ended

    @property
    def failure(self) -> Exception | None:
        """What ended the run unasked."""
        return self._step_failure or (self._pacer.failure if self._pacer else None)

    def now_ns(self) -> int:
        """Return the time that messages and recordings are stamped with, ns."""
        if not self.simulated_time:
            return int(self._node.get_clock().now().nanoseconds)
        return self._pacer.run.time_ns if self._pacer else 0

    def prepare(self) -> None:
        """Compile; open the topics and the recording.

        Raises
        ------
        RollerSimError
            If the configuration cannot be emulated or the recording not be begun; all is closed then.
        """
        self._beginning = self._beginning.with_parameters(self._configuration)
        configuration = self._configuration = self._beginning.configuration
        try:
            warm_up(self._beginning)
            self._station.open(self._beginning)
        except RollerSimError:
            self.release()
            raise
        self._prepared = configuration

    def start(self, *, paused: bool = False) -> None:
        """Start from the beginning.

        Parameters
        ----------
        paused : bool
            Do not let time go on by itself yet; in lock step it never does.

        Raises
        ------
        RollerSimError
            As `prepare`, which is done again if parameters changed that need it.
        """
        if self._prepared is None or _structure(self._prepared) != _structure(self._configuration):
            self._close_topics()
            self.prepare()
        self._beginning = self._beginning.with_parameters(self._configuration)
        self._configuration = self._beginning.configuration
        start_ns = 0 if self.simulated_time else self.now_ns()
        self._begin(self._beginning.emulator(start_ns), paused=paused)

    def go_on(self, emulator: Emulator) -> None:
        """Run an emulator that was restored, paused; the one that ran is dropped.

        Raises
        ------
        RollerSimError
            If its recording cannot be begun.
        """
        self.stop()
        self._configuration = self._configuration.changed(
            {
                name: value
                for name, value in emulator.session.configuration.flat().items()
                if not name.startswith(_OF_THE_NODE)
            }
        )
        self._begin(emulator, paused=True)

    def reset(self) -> None:
        """Run from the beginning again, with the parameters of then; paused if it was.

        Raises
        ------
        RollerSimError
            If its recording cannot be begun.
        """
        playing = self.playing
        self.stop()
        self._configuration = self._beginning.configuration
        self.start(paused=not playing)

    def play(self) -> None:
        """Let time go on by itself."""
        if self._pacer is not None:
            self._pacer.play()

    def pause(self) -> None:
        """Let time stand still after the block under way."""
        if self._pacer is not None:
            self._pacer.pause()

    def failed(self, error: Exception) -> None:
        """Note that a step of the run failed; the process ends."""
        self._step_failure = error

    def stop(self) -> None:
        """Stop; topics and recording stay open."""
        if self._pacer is not None:
            self._pacer.stop()
            gc.unfreeze()
            if self._configuration.pacing.realtime_priority > 0:
                request_scheduling(0)
            self.report()
            self._configuration = self.configuration
            self._pacer = None
            self.inputs.end()

    def release(self) -> None:
        """Stop, and close everything."""
        self.stop()
        self._station.close_recording()
        self._close_topics()

    def check(self, values: Mapping[str, Value]) -> Configuration:
        """Return the configuration that `change` would make.

        Raises
        ------
        ParameterError
            If a value is refused, or a parameter cannot change while the roller runs.
        """
        if self._pacer is not None:
            for name, value in values.items():
                if not PARAMETERS[name][0].changes:
                    raise ParameterError(
                        name, value, "cannot change while the roller is active; deactivate it first"
                    )
        recorded_to = self._configuration.recording.path
        if self._prepared is not None and recorded_to and "recording.path" not in values:
            for name, value in values.items():
                if PARAMETERS[name][0].of_node and value != self._configuration.flat()[name]:
                    raise ParameterError(
                        *(name, value),
                        f"cannot change while {recorded_to} is recorded to; set recording.path, too, or first to none",
                    )
        for name, value in values.items():
            if name == "scenario.path" and value != self._configuration.scenario.path:
                raise ParameterError(name, value, "is said when the node starts")
        return self.configuration.changed(values)

    def change(self, values: Mapping[str, Value]) -> None:
        """Change parameters, all or none.

        Raises
        ------
        RollerSimError
            As `check`, or if the roller cannot be computed with them.
        """
        configuration = self.check(values)
        try_out(configuration)
        recording = {name: value for name, value in values.items() if PARAMETERS[name][0].of_node}
        if recording:
            self._record(recording)
        roller = {name: value for name, value in values.items() if name not in recording}
        if roller:
            self.inputs.change(roller)
        if self._pacer is None:
            self._configuration = configuration

    def between_blocks(self, act: Callable[[], T]) -> T:
        """Do something while no block is under way, and return what comes of it."""
        return self._pacer.between_blocks(act) if self._pacer else act()

    def watch(self) -> None:
        """Look after what goes on by itself: watchdogs, topics that are to be recorded, ``/clock``."""
        if not self.simulated_time:
            self.inputs.watch()
        elif not self.playing:
            self._station.announce_clock()
        self._station.look_for_topics()

    def report(self) -> Report:
        """Return what there is to tell since the last call, and send it as diagnostics."""
        pacer, station = self._pacer, self._station
        factor = math.nan
        if pacer is not None:
            (before_s, then_s), (after_s, now_s) = self._reported, pacer.run.progress
            self._reported = (after_s, now_s)
            if now_s > then_s:
                factor = (after_s - before_s) / (now_s - then_s)
        station.look_for_rivals()
        unsent, recently_unsent = station.unsent()
        lateness = pacer.lateness if pacer else Lateness()
        exciter, travel = self.inputs.exciter, self.inputs.travel
        report = Report(
            node=self._node.get_fully_qualified_name(),
            drive=Drive.of(pacer.run.emulator, self._beginning.scenario) if pacer else None,
            paused=pacer is not None and not pacer.playing,
            simulated_time=self.simulated_time,
            rivals=station.rivals,
            recent=lateness.recent(),
            total=lateness.total(),
            unsent=unsent,
            recently_unsent=recently_unsent,
            real_time_factor=factor,
            realtime=tuple(pacer.realtime) if pacer else (),
            recording=station.recording_report(),
            refused=exciter.refused,
            refusal=exciter.reason,
            refusing=exciter.refusing,
            travel_refused=travel.refused,
            travel_refusal=travel.reason,
            travel_refusing=travel.refusing,
        )
        if report.drive is not None:
            self.last_report = report
        station.send(messages.diagnostic_array(diagnostics(report), self.now_ns()))
        return report

    def _begin(self, emulator: Emulator, *, paused: bool) -> None:
        outlet = self._station.outlet
        assert outlet is not None  # since prepared
        pacing = self._configuration.pacing
        self._station.begin_run(self._beginning)
        run = Run(
            emulator,
            pacing.samples_per_message,
            outlet.send,
            outlet.imu_wanted,
            clock=self._station.publishes_clock,
        )
        speed = pacing.speed if self.simulated_time else 1.0
        pacer = self._pacer = Pacer(run, speed, pacing.realtime_priority)
        run.on_end = self._on_end
        if self.simulated_time:
            run.before_revolution = lambda _: self.inputs.watch()
        self.inputs.begin(emulator)
        # What is there by now stays; the collector need not look at it again and again.
        gc.collect()
        gc.freeze()
        self._reported = (0.0, 0.0)
        pacer.start(paused=paused or pacing.lock_step)
        if pacing.realtime_priority > 0:
            # This thread holds the interpreter now and then; preempted in it, it would hold up the pacing.
            request_scheduling(pacing.realtime_priority - 1)
        for line in pacer.realtime:
            self._node.get_logger().info(f"real time: {line}")

    def _record(self, values: Mapping[str, Value]) -> None:
        """Take other parameters of the recording, and end it or begin another if topics are open."""
        begins = self._beginning.with_recording(values)
        if self._prepared is not None and begins != self._beginning:
            now = begins.with_parameters(self.configuration.changed(values))
            try:
                self._station.record(now, self.between_blocks, self._begin_trace)
            except RollerSimError as error:
                path = now.configuration.recording.path
                raise ParameterError("recording.path", path, str(error)) from error
        self._beginning = begins
        self._configuration = self._configuration.changed(values)

    def _begin_trace(self) -> bool:
        """Let a trace that begins in the middle of a run begin with its state; return whether there is a run."""
        if self._pacer is None:
            return False
        emulator = self._pacer.run.emulator
        emulator.tell_all_again()
        emulator.note_restored(snapshot.save(emulator))
        return True

    def _on_end(self) -> None:
        if self.stop_at_end and self._pacer is not None:
            self._pacer.stop_playing()
        else:
            self._node.get_logger().info("the scenario has been driven; the roller stands")

    def _close_topics(self) -> None:
        self._prepared = None
        self._station.close_topics()

    def _warn(self, line: str) -> None:
        self._node.get_logger().warning(line)

    def _answer(self, code: Refusal, reason: str) -> None:
        """Let ``exciter/state`` of a roller that is not active say why a command was refused."""
        self._station.send(standing(self._configuration.exciter, self.now_ns(), code, reason))

    def _watched_s(self) -> float:
        """Return the time by which the watchdogs count."""
        if not self.simulated_time:
            return time.monotonic()
        return self._pacer.run.time_s if self._pacer else 0.0


_OF_THE_NODE = ("pacing.", "recording.", "scenario.")
"""How parameters begin that a saved state says nothing about."""


def _structure(configuration: Configuration) -> dict[str, Value]:
    """Return the parameters that cannot change while the roller runs."""
    flat = configuration.flat()
    return {name: value for name, value in flat.items() if not PARAMETERS[name][0].changes}
