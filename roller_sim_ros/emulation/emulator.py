# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The one place where a block of samples becomes messages: what is published is what is recorded."""

from __future__ import annotations

import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from roller_sim_ros.emulation.inputs import Input, InputKind
from roller_sim_ros.emulation.instruments import Instruments
from roller_sim_ros.faults import Scheduled, Span, make_fault
from roller_sim_ros.meters import CompactionMeter, MeterValue, TruthMeter, TruthValue
from roller_sim_ros.meters.drum import Drum
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration, ParameterError, Value
from roller_sim_ros.sensors import Choice, Reading
from roller_sim_ros.session import (
    Block,
    CommandRefused,
    ExciterStatus,
    Programme,
    Refusal,
    Session,
)
from roller_sim_ros.site import Site
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.imu import imu
from roller_sim_ros.wire.messages import Message

STATE_HZ = 10
"""How often ``exciter/state`` comes at least, per simulated second."""


class Emulator:
    """The roller as its network sees it: session → sensor → meters → messages. Knows no clock and no ROS.

    One thread may advance it while others command it.

    Parameters
    ----------
    configuration : Configuration
        What is emulated; 128 samples per revolution.
    start_ns : int
        Stamp of the first sample, ns since the epoch.
    run_up : bool
        Start the exciter from standstill; otherwise at once at full frequency and amplitude.
    site : Site, optional
        Where the roller is and what ground is there; the configured ground everywhere when not given.
    programme : Programme, optional
        What the exciter is to do while nobody commands it.
    sensors : sequence of Choice
        The sensors; an ideal accelerometer where none is chosen.
    faults : sequence of Scheduled
        Faults and when they are active.
    seed : int
        Of all random numbers of sensors and faults.
    scenario : str
        Text of the scenario file that site, programme and faults are made from, for ``inputs``; a run with such parts
        and without it cannot be replayed.

    Attributes
    ----------
    session : Session
        The roller; to be advanced, commanded and changed through the emulator only.
    start_ns : int
        As given.
    instruments : Instruments
        Its sensors and faults.
    block : Block or None
        The last block.
    meter_value : MeterValue or None
        The last meter value; None before the first revolution is complete.

    Raises
    ------
    ParameterError
        If the configuration has another number of samples per revolution, or a sensor or a fault cannot be.

    Examples
    --------
    >>> emulator = Emulator(Configuration(), start_ns=0)
    >>> [message.topic for message in emulator.advance(16)]
    ['inputs', 'drum/acceleration', 'truth', 'faults', 'exciter/state', 'machine', 'soil']
    >>> [message.topic for message in emulator.advance(16)]
    ['drum/acceleration', 'truth']
    """

    def __init__(
        self,
        configuration: Configuration,
        *,
        start_ns: int,
        run_up: bool = False,
        site: Site | None = None,
        programme: Programme | None = None,
        sensors: Sequence[Choice] = (),
        faults: Sequence[Scheduled] = (),
        seed: int = 0,
        scenario: str = "",
    ) -> None:
        samples = configuration.sampling.samples_per_revolution
        if samples != SAMPLES_PER_REVOLUTION:
            raise ParameterError(
                "sampling.samples_per_revolution",
                samples,
                f"messages and traces need {SAMPLES_PER_REVOLUTION} samples per revolution",
            )
        self.session = Session(configuration, run_up=run_up, site=site, programme=programme)
        self.start_ns = start_ns
        self.block: Block | None = None
        self.meter_value: MeterValue | None = None
        meter = configuration.meter
        self.instruments = Instruments(self.session, sensors, faults, seed)
        self._readings: list[Reading] = []
        self._meter = CompactionMeter(
            meter.window_revolutions,
            meter.noise_floor_m_s2,
            drum=Drum.of(configuration.machine, configuration.exciter),
            period_tolerance=meter.period_tolerance,
        )
        self._truth = TruthMeter(
            meter.window_revolutions,
            configuration.machine.static_load_n,
            period_tolerance=meter.period_tolerance,
        )
        self._status: ExciterStatus | None = None
        self._refusal = (Refusal.NONE, "")
        self._refusal_told = True
        self._tick = -1
        self._configuration_told: Configuration | None = None
        self._facts: dict[str, bytes] = {}
        self._lock = threading.Lock()
        parts = {"site": site, "programme": programme, "faults": faults}
        self._inputs: list[Input] = []
        self._note(
            InputKind.BEGIN,
            start_ns=start_ns,
            run_up=run_up,
            seed=seed,
            parameters=configuration.flat(),
            sensors=[[choice.name, dict(choice.parameters)] for choice in sensors],
            scenario=scenario,
            parts=[name for name, part in parts.items() if part and not scenario],
        )

    @property
    def truth_value(self) -> TruthValue:
        """The last true values; unknown (NaN) before the first window is full."""
        return self._truth.value

    @property
    def refusal(self) -> tuple[Refusal, str]:
        """Why the last command was refused, as code and reason; NONE when it was not."""
        return self._refusal

    def advance(self, samples: int) -> list[Message]:
        """Step over the next samples and return what is to be published, in that order.

        ``inputs`` where something came in; ``drum/acceleration``, as it arrives, and ``truth``; where a revolution
        ends ``meter``, ``cmv``, ``meters/…`` and ``site/state``; where one begins ``applied`` for all that took
        effect; ``tacho``, ``odom`` and ``fix`` where such sensors are chosen; ``exciter/state`` on change and 10 times
        a simulated second; ``faults``, ``machine`` and ``soil`` at the start and on change.

        Parameters
        ----------
        samples : int
            At least 1, at most what is left of the current 128 samples.

        Raises
        ------
        RollerSimError
            If `samples` would reach over a multiple of 128 samples.
        """
        with self._lock:
            block = self.session.advance(samples)
            self.block, self._readings = block, self.instruments.read(block)
            truth = self._truth.feed(block)
            stamp_ns = messages.sample_stamp(block, 0, self.start_ns)
            out = self._taken_inputs(stamp_ns)
            out += [messages.drum_acceleration(it, self.start_ns) for it in self._readings]
            out.append(messages.drum_soil_state(block, truth, self.start_ns))
            for reading in self._readings:
                self._add_meter(out, reading)
            begins = block.first_sample % SAMPLES_PER_REVOLUTION == 0
            if (block.first_sample + len(block)) % SAMPLES_PER_REVOLUTION == 0:
                out.append(self._site_state(block, truth))
            if begins:
                out += [messages.applied_change(it, stamp_ns) for it in self.session.applied()]
            out += self.instruments.messages(block, self.start_ns)
            self._add_state(out, block, stamp_ns, begins=begins)
            if begins:
                self._add_facts(out, stamp_ns)
            return out

    def imu_messages(self) -> list[Message]:
        """Return ``drum/imu`` of the last block, decimated as the pacing says."""
        decimation = self.session.configuration.pacing.imu_decimation
        return [it for reading in self._readings for it in imu(reading, self.start_ns, decimation)]

    def command(self, *, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
        """Command the exciter; takes effect at the next multiple of 128 samples, unless a fault loses it.

        Raises
        ------
        CommandRefused
            If a value is refused; the roller carries on as before and ``exciter/state`` says why.
        """
        try:
            with self._lock:
                if self.instruments.faults.link_frozen:
                    return
                self.session.command_exciter(
                    vibrate=vibrate, frequency_hz=frequency_hz, amplitude_m=amplitude_m
                )
                self._note(
                    InputKind.COMMAND,
                    vibrate=bool(vibrate),
                    frequency_hz=float(frequency_hz),
                    amplitude_m=float(amplitude_m),
                )
                self._refusal_told &= self._refusal[0] is Refusal.NONE
                self._refusal = (Refusal.NONE, "")
        except CommandRefused as error:
            self.refuse(error.code, str(error))
            raise

    def command_travel(self, speed_m_s: float) -> None:
        """Command the travel speed, forward positive; takes effect at the next multiple of 128 samples.

        Raises
        ------
        CommandRefused
            If the speed is refused; the roller carries on as before.
        """
        with self._lock:
            if not self.instruments.faults.link_frozen:
                self.session.command_travel(speed_m_s)
                self._note(InputKind.TRAVEL, speed_m_s=float(speed_m_s))

    def release(self) -> None:
        """Hand exciter and travel back to the scenario; without one the roller stops travelling."""
        with self._lock:
            self.session.release()
            self._note(InputKind.RELEASE)

    def change(self, values: Mapping[str, Value]) -> None:
        """Change live parameters; takes effect at the next multiple of 128 samples.

        Parameters
        ----------
        values : mapping
            {dotted name: SI value}. All are taken or none.

        Raises
        ------
        ParameterError
            If a name is unknown, a parameter is not live, or a value is refused.
        """
        with self._lock:
            taken = self.session.change(values)
            self._note(InputKind.CHANGE, values=taken)

    def inject(
        self,
        fault_id: str,
        parameters: Mapping[str, Value] | None = None,
        *,
        span: Span | None = None,
    ) -> int:
        """Let a fault be active from the next multiple of 128 samples on, and return its handle.

        Parameters
        ----------
        fault_id : str
            Of the catalogue, as in ``bias_step``.
        parameters : mapping
            What differs from the fault's defaults.
        span : Span
            How long: time, revolutions or way; until it is cleared when not given.

        Raises
        ------
        FaultRefused
            If there is no such fault, nothing that it acts on, or another one that excludes it.
        ParameterError
            If a parameter is unknown or its value refused.
        """
        with self._lock:
            handle = self.instruments.faults.inject(fault_id, parameters, span)
            self._note(
                InputKind.INJECT,
                fault_id=fault_id,
                parameters=dict(vars(make_fault(fault_id, parameters))),
                span=dict(vars(span or Span())),
            )
            return handle

    def clear(self, handle: int | None = None) -> None:
        """End a fault at the next multiple of 128 samples, a scheduled one for good.

        Parameters
        ----------
        handle : int or None
            Which; None: all that were injected.

        Raises
        ------
        FaultRefused
            If there is none of this handle.
        """
        with self._lock:
            if handle is None:
                self.instruments.faults.clear_all()
            else:
                self.instruments.faults.clear(handle)
            self._note(InputKind.CLEAR, handle=handle)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Keep all other threads from advancing, commanding and changing it."""
        with self._lock:
            yield

    def refuse(self, code: Refusal, reason: str) -> None:
        """Let ``exciter/state`` say, from the next block to the next accepted command, what was refused.

        Parameters
        ----------
        code : Refusal
            Why, as a code.
        reason : str
            The same in words: field, value and bound.
        """
        with self._lock:
            self._refusal = (code, reason)
            self._refusal_told = False
            self._note(InputKind.REFUSE, code=int(code), reason=reason)

    def tell_all_again(self) -> None:
        """Let the next blocks say what is else said on change only, for a trace that begins with them."""
        with self._lock:
            self._status = None
            self._configuration_told = None
            self._facts = {}
            self.instruments.tell_again()

    def note_restored(self, state: bytes) -> None:
        """Let ``inputs`` say that the run goes on from a saved state, so that a trace from here on can be replayed.

        Parameters
        ----------
        state : bytes
            As it was saved.
        """
        with self._lock:
            # What came in just before the state was saved has had its effect on it.
            self._inputs = [Input(self.session.next_sample, InputKind.RESTORE, state=state)]

    def _note(self, kind: InputKind, **arguments: Any) -> None:
        self._inputs.append(Input(self.session.next_sample, kind, arguments))

    def _taken_inputs(self, stamp_ns: int) -> list[Message]:
        taken, self._inputs = self._inputs, []
        return [
            messages.run_input(it.sample, it.kind.value, it.text, it.state, stamp_ns)
            for it in taken
        ]

    def _add_meter(self, out: list[Message], reading: Reading) -> None:
        for value in self._meter.feed(
            reading.first_sample,
            reading.vertical,
            reading.sample_period_s,
            reading.excitation_hz,
            reading.eccentric_phase_rad,
            reading.phase_increment_rad,
            self.session.amplitude_m,
            int(reading.clipped.sum()),
        ):
            self.meter_value = value
            index = value.last_sample - reading.first_sample
            stamp_ns = messages.sample_stamp(reading, index, self.start_ns)
            out.append(messages.compaction_meter(value, stamp_ns))
            out.append(messages.cmv(value, stamp_ns))
            out += messages.further_meters(value, stamp_ns)

    def _site_state(self, block: Block, truth: TruthValue) -> Message:
        masters = self.session.masters
        return messages.site_state(
            block,
            self.session.site.position,
            truth,
            (masters.exciter, masters.travel),
            self.start_ns,
        )

    def _add_state(self, out: list[Message], block: Block, stamp_ns: int, *, begins: bool) -> None:
        """Add ``exciter/state`` if something changed or a tenth of a second began since the last block."""
        tick = int(STATE_HZ * block.time_s)
        due = tick != self._tick or not self._refusal_told
        # Between two beginnings of a revolution nothing changes.
        if begins:
            status = self.session.exciter_status()
            due |= status != self._status
            self._status = status
        if due and self._status is not None:
            out.append(messages.exciter_state(self._status, stamp_ns, *self._refusal))
            self._refusal_told = True
            self._tick = tick

    def _add_facts(self, out: list[Message], stamp_ns: int) -> None:
        configuration = self.session.configuration
        if configuration == self._configuration_told:
            return
        self._configuration_told = configuration
        for message in (
            messages.machine_facts(configuration, stamp_ns),
            messages.soil_facts(configuration, stamp_ns),
        ):
            if self._facts.get(message.topic) != message.data:
                self._facts[message.topic] = message.data
                out.append(message)
