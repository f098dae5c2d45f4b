"""The roller behind the node: topics, recording, commands, and the pacing thread."""

from __future__ import annotations

import gc
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from rclpy.node import Node
from rclpy.subscription import Subscription
from rosbags.serde import SerdeError

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.command_input import COMMANDED, CommandInput, stopped
from roller_sim_ros.node.interfaces import message_type
from roller_sim_ros.node.lateness import Lateness
from roller_sim_ros.node.outlet import Outlet
from roller_sim_ros.node.pacing import Pacer
from roller_sim_ros.node.qos import overridable, overrides_of, profile
from roller_sim_ros.node.realtime import request_scheduling
from roller_sim_ros.node.recording import Recording, receiver
from roller_sim_ros.node.report import Drive, RecordingReport, Report, diagnostics
from roller_sim_ros.node.warm_up import try_out, warm_up
from roller_sim_ros.parameters import PARAMETERS, Configuration, ParameterError, Value
from roller_sim_ros.session import CommandRefused, ExciterCommand, ExciterStatus, Refusal
from roller_sim_ros.wire import messages, topics
from roller_sim_ros.wire.types import decode

CLOSE_S = 1.5
"""How long the end of the node waits for the recording to be finished."""


class Roller:
    """Prepared, it has its topics and its recording; started, it runs in real time.

    All calls come from one thread, that of the node's executor; only the pacing thread works beside it.

    Parameters
    ----------
    node : rclpy.node.Node
        The node.
    configuration : Configuration
        All parameters.

    Attributes
    ----------
    configuration : Configuration
        All parameters as they were last accepted; commands count as parameters of the exciter.
    last_report : Report or None
        The last one while the roller ran.
    last_recording : RecordingReport or None
        What became of the last recording that was closed.
    """

    def __init__(self, node: Node, configuration: Configuration) -> None:
        self.configuration = configuration
        self.last_report: Report | None = None
        self.last_recording: RecordingReport | None = None
        self._node = node
        self._prepared: Configuration | None = None
        self._commands: Subscription[Any] | None = None
        self._outlet: Outlet | None = None
        self._recording: Recording | None = None
        self._pacer: Pacer | None = None
        self._input = CommandInput()
        self._reported = (0.0, 0.0)
        self._unsent = 0

    @property
    def running(self) -> bool:
        """Whether it was started and not stopped."""
        return self._pacer is not None

    @property
    def failure(self) -> Exception | None:
        """What ended the pacing unasked."""
        return self._pacer.failure if self._pacer else None

    def prepare(self) -> None:
        """Compile; open the topics and the recording.

        Raises
        ------
        RollerSimError
            If the configuration cannot be emulated or the recording not be begun; all is closed then.
        """
        configuration = self.configuration
        topic = topics.EXCITER_COMMAND
        try:
            warm_up(configuration)
            self._outlet = Outlet(self._node, configuration.pacing)
            with overrides_of(topic):
                self._commands = self._node.create_subscription(
                    message_type(topic.type_name),
                    topic.name,
                    receiver(self._on_command),
                    profile(topic.qos(configuration.pacing)),
                    raw=True,
                    qos_overriding_options=overridable(),
                )
            self._open_recording(self._outlet, self._commands.topic_name)
        except RollerSimError:
            self.release()
            raise
        self._prepared = configuration

    def start(self) -> None:
        """Start from standstill.

        Raises
        ------
        RollerSimError
            As `prepare`, which is done again if parameters changed that need it.
        """
        if self._prepared is None or _structure(self._prepared) != _structure(self.configuration):
            self._close_topics()
            self.prepare()
        assert self._outlet is not None  # since prepared
        pacing = self.configuration.pacing
        start_ns = self._node.get_clock().now().nanoseconds
        self._input.accepted()
        self._pacer = Pacer(
            Emulator(self.configuration, start_ns=start_ns, run_up=True),
            pacing.samples_per_message,
            self._outlet.send,
            self._outlet.imu_wanted,
            pacing.realtime_priority,
        )
        # What is there by now stays; the collector need not look at it again and again.
        gc.collect()
        gc.freeze()
        self._reported = (0.0, 0.0)
        self._pacer.start()
        if pacing.realtime_priority > 0:
            # This thread holds the interpreter now and then; preempted in it, it would hold up the pacing.
            request_scheduling(pacing.realtime_priority - 1)
        for line in self._pacer.realtime:
            self._node.get_logger().info(f"real time: {line}")

    def stop(self) -> None:
        """Stop; topics and recording stay open."""
        if self._pacer is not None:
            self._pacer.stop()
            gc.unfreeze()
            if self.configuration.pacing.realtime_priority > 0:
                request_scheduling(0)
            self.report()
            self._pacer = None

    def release(self) -> None:
        """Stop, and close everything."""
        self.stop()
        self._close_recording()
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
                if not PARAMETERS[name][0].live:
                    raise ParameterError(
                        name, value, "cannot change while the roller is active; deactivate it first"
                    )
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
        if self._pacer is not None:
            self._pacer.emulator.change(values)
        self.configuration = configuration
        if any(name in COMMANDED for name in values):
            self._input.accepted()

    def watch(self) -> None:
        """Run the exciter down when commands fail to come; look for topics that are to be recorded."""
        if self._pacer is not None:
            overdue = self._input.overdue(self.configuration.exciter)
            if overdue:
                self._obey(self._pacer, stopped(self.configuration.exciter))
                self._refuse(Refusal.TIMEOUT, overdue, overdue)
        if self._recording is not None:
            self._recording.look_for_topics()

    def report(self) -> Report:
        """Return what there is to tell since the last call, and send it as diagnostics."""
        pacer, recording = self._pacer, self._recording
        factor = math.nan
        if pacer is not None:
            (before_s, then_s), (after_s, now_s) = self._reported, pacer.progress
            self._reported = (after_s, now_s)
            if now_s > then_s:
                factor = (after_s - before_s) / (now_s - then_s)
        unsent = self._outlet.unsent if self._outlet else 0
        if unsent > self._unsent:
            self._node.get_logger().error(f"{unsent - self._unsent} messages could not be sent")
        lateness = pacer.lateness if pacer else Lateness()
        report = Report(
            node=self._node.get_fully_qualified_name(),
            drive=_drive(pacer.emulator) if pacer else None,
            recent=lateness.recent(),
            total=lateness.total(),
            unsent=unsent,
            recently_unsent=unsent - self._unsent,
            real_time_factor=factor,
            realtime=tuple(pacer.realtime) if pacer else (),
            recording=recording.report() if recording else None,
            refused=self._input.refused,
            refusal=self._input.reason,
            refusing=self._input.refusing,
        )
        self._unsent = unsent
        if report.drive is not None:
            self.last_report = report
        if self._outlet is not None:
            stamp_ns = self._node.get_clock().now().nanoseconds
            self._outlet.send([messages.diagnostic_array(diagnostics(report), stamp_ns)])
        return report

    def _open_recording(self, outlet: Outlet, command_topic: str) -> None:
        """Begin the recording that the parameters ask for, or go on with the one that is open."""
        wanted = self.configuration.recording
        if self._recording is not None and self._recording.parameters == wanted:
            self._recording.attach(outlet)
            return
        self._close_recording()
        if wanted.path:
            self._recording = Recording(self._node, outlet, command_topic, self.configuration)

    def _close_recording(self) -> None:
        if self._recording is not None:
            recording, self._recording = self._recording, None
            if self._outlet is not None:
                self._outlet.trace = None
            recording.close(CLOSE_S)
            self.last_recording = recording.report()

    def _close_topics(self) -> None:
        self._prepared = None
        if self._commands is not None:
            self._node.destroy_subscription(self._commands)
            self._commands = None
        if self._outlet is not None:
            self._outlet.destroy()
            self._outlet = None
            self._unsent = 0

    def _on_command(self, data: bytes, received_ns: int, published_ns: int) -> None:
        if self._recording is not None:
            self._recording.put_command(data, received_ns, published_ns)
        try:
            message = decode(data, topics.EXCITER_COMMAND.type_name)
        except SerdeError as error:
            reason = f"message of {len(data)} bytes: is no ExciterCommand ({error})"
            self._refuse(Refusal.DAMAGED, f"command refused: {reason}", reason)
            return
        try:
            if self._pacer is None:
                raise CommandRefused(
                    Refusal.NOT_ACTIVE,
                    f"frequency {message.frequency:g} Hz, amplitude {message.amplitude:g} m: "
                    "the roller is not active",
                )
            command = ExciterCommand(message.vibrate, message.frequency, message.amplitude)
            self._obey(self._pacer, command)
        except CommandRefused as error:
            self._refuse(error.code, f"command refused: {error}", str(error))
        else:
            self._input.accepted()

    def _obey(self, pacer: Pacer, command: ExciterCommand) -> None:
        values = (command.vibrate, command.frequency_hz, command.amplitude_m)
        pacer.emulator.command(
            vibrate=command.vibrate,
            frequency_hz=command.frequency_hz,
            amplitude_m=command.amplitude_m,
        )
        self.configuration = self.configuration.changed(dict(zip(COMMANDED, values, strict=True)))

    def _refuse(self, code: Refusal, line: str, reason: str) -> None:
        """Say that a command was refused, or missed: log, exciter/state, diagnostics."""
        if self._input.refuse(code, reason):
            self._node.get_logger().warning(line)
        if self._pacer is not None:
            self._pacer.emulator.refuse(code, reason)
        elif self._outlet is not None:
            exciter = self.configuration.exciter
            status = ExciterStatus(
                vibrating=False,
                commanded_frequency_hz=exciter.frequency_hz,
                commanded_amplitude_m=exciter.amplitude_m,
                frequency_hz=0.0,
                amplitude_m=0.0,
                force_amplitude_n=0.0,
                applied_sample=0,
            )
            stamp_ns = self._node.get_clock().now().nanoseconds
            self._outlet.send([messages.exciter_state(status, stamp_ns, code, reason)])


def _structure(configuration: Configuration) -> dict[str, Value]:
    """Return the parameters that cannot change while the roller runs."""
    flat = configuration.flat()
    return {name: value for name, value in flat.items() if not PARAMETERS[name][0].live}


def _drive(emulator: Emulator) -> Drive | None:
    block = emulator.block
    if block is None:
        return None
    return Drive(
        simulated_s=block.time_s + len(block) * block.sample_period_s,
        samples=block.first_sample + len(block),
        sample_period_s=block.sample_period_s,
        shear_modulus_pa=block.shear_modulus_pa,
        plastic_parameter_m=block.plastic_parameter_m,
        exciter=emulator.session.exciter_status(),
        meter=emulator.meter_value,
        unsettled_steps=emulator.session.unsettled_steps,
        finite=bool(np.isfinite(block.acceleration_vertical).all()),
    )
