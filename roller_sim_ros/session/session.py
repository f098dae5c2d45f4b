# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The whole roller, stepped block by block."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from roller_sim_ros.drum_soil import GROUNDS
from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.exciter import ExciterDrive, Revolution
from roller_sim_ros.parameters import Configuration, ParameterError, Value, lookup
from roller_sim_ros.session.block import Block
from roller_sim_ros.session.command import (
    Applied,
    ExciterCommand,
    ExciterStatus,
    Master,
    checked_speed,
)
from roller_sim_ros.session.masters import Masters
from roller_sim_ros.session.programme import Moment, Programme
from roller_sim_ros.session.supervision import Supervision
from roller_sim_ros.site import Site, UniformSite

TWO_PI = 2.0 * math.pi
_COMMAND_PARAMETERS = ("exciter.vibrate", "exciter.frequency_hz", "exciter.amplitude_m")


class Session:
    """One run of the roller: site, exciter, drum and soil. Knows no clock and no ROS.

    Starts in static equilibrium, eccentric at phase zero.

    Parameters
    ----------
    configuration : Configuration
        What is simulated.
    run_up : bool
        Start the exciter from standstill, following its rate limits; otherwise at once at full frequency and
        amplitude.
    site : Site, optional
        Where the roller is and what ground is there; the configured ground everywhere when not given.
    programme : Programme, optional
        What the exciter is to do while nobody else commands it.

    Attributes
    ----------
    configuration : Configuration
        With all changes that took effect.
    site : Site
        As given.
    masters : Masters
        Whom exciter and travel obey.
    supervision : Supervision or None
        What may keep the exciter from obeying; none until it is set.
    """

    def __init__(
        self,
        configuration: Configuration,
        *,
        run_up: bool = False,
        site: Site | None = None,
        programme: Programme | None = None,
    ) -> None:
        self.configuration = configuration
        self.site: Site = UniformSite() if site is None else site
        self._soil = self.site.soil(configuration.soil)
        self._samples = configuration.sampling.samples_per_revolution
        self._drive = ExciterDrive(
            configuration.exciter,
            configuration.sampling.floor_hz,
            run_up=run_up,
            samples=self._samples,
        )
        self._ground = GROUNDS[configuration.half_space.model](
            configuration.machine,
            self._soil,
            configuration.half_space,
            configuration.exciter,
            self._samples,
        )
        self._next_sample = 0
        self._revolution_start_s = 0.0
        self._revolution: Revolution | None = None
        self._pending: dict[str, Value] = {}
        self._applied: list[Applied] = []
        self._command_sample = 0
        self._programme = programme
        self.masters = Masters(scenario=programme is not None)
        self.supervision: Supervision | None = None

    @property
    def next_sample(self) -> int:
        """Index of the sample that the next `advance` begins with."""
        return self._next_sample

    @property
    def moment(self) -> Moment:
        """When and where the revolution of the next sample begins, or began."""
        return Moment(
            self._revolution_start_s, self._next_sample // self._samples, self.site.position
        )

    @property
    def upcoming(self) -> Configuration:
        """The configuration with what waits for the next multiple of 128 samples."""
        return self.configuration.changed(self._pending) if self._pending else self.configuration

    @property
    def samples_per_revolution(self) -> int:
        """Samples between the points at which commands and changes take effect."""
        return self._samples

    @property
    def amplitude_m(self) -> float:
        """Nominal amplitude of the exciter at the end of the revolution that runs."""
        return self._drive.amplitude_m

    @property
    def unsettled_steps(self) -> int:
        """Steps whose phase changes did not settle; 0 in all sound runs."""
        return self._ground.unsettled_steps

    def command_exciter(self, *, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
        """Command the exciter; takes effect at the next multiple of 128 samples.

        Raises
        ------
        CommandRefused
            If a value is refused; the roller carries on as before.
        """
        command = ExciterCommand(vibrate, frequency_hz, amplitude_m)
        values = (command.vibrate, command.frequency_hz, command.amplitude_m)
        self._pending.update(zip(_COMMAND_PARAMETERS, values, strict=True))
        self.masters.command_exciter()

    def command_travel(self, speed_m_s: float) -> None:
        """Command the travel speed; takes effect at the next multiple of 128 samples.

        Parameters
        ----------
        speed_m_s : float
            Positive towards growing chainage.

        Raises
        ------
        CommandRefused
            If the speed is refused; the roller carries on as before.
        """
        self.masters.command_travel(checked_speed(speed_m_s))

    def release(self) -> None:
        """Hand exciter and travel back to the scenario, at the next multiple of 128 samples.

        Without a scenario the exciter keeps what was commanded, and the roller stops.
        """
        if self._programme is not None:
            for name in _COMMAND_PARAMETERS:
                self._pending.pop(name, None)
        self.masters.release()

    def change(self, values: Mapping[str, Value]) -> dict[str, Value]:
        """Change live parameters; takes effect at the next multiple of 128 samples.

        Parameters
        ----------
        values : mapping
            {dotted name: SI value}. All are taken or none.

        Returns
        -------
        dict
            The values as they were taken, of their declared types.

        Raises
        ------
        ParameterError
            If a name is unknown, a parameter is not live or decided by the site, or a value is refused.
        """
        for name, value in values.items():
            quantity, _ = lookup(name, value)
            if not quantity.live:
                raise ParameterError(name, value, "cannot change while the roller runs")
            if name in self.site.decides:
                raise ParameterError(name, value, "is what the scenario's ground makes it")
        checked = self.configuration.changed({**self._pending, **values}).flat()
        taken = {name: checked[name] for name in values}
        self._pending.update(taken)
        if any(name in _COMMAND_PARAMETERS for name in values):
            self.masters.command_exciter()
        return taken

    def applied(self) -> list[Applied]:
        """Return what took effect since the last call, in the order of effect."""
        taken, self._applied = self._applied, []
        return taken

    def exciter_status(self) -> ExciterStatus:
        """Return what the exciter does and what it was told."""
        exciter = self.configuration.exciter
        drive = self._drive
        return ExciterStatus(
            vibrating=exciter.vibrate,
            commanded_frequency_hz=exciter.frequency_hz,
            commanded_amplitude_m=exciter.amplitude_m,
            frequency_hz=drive.frequency_hz,
            amplitude_m=drive.amplitude_m,
            force_amplitude_n=self.configuration.machine.drum_mass_kg
            * drive.amplitude_m
            * (TWO_PI * drive.frequency_hz) ** 2,
            applied_sample=self._command_sample,
            master=self.masters.exciter,
        )

    def advance(self, samples: int) -> Block:
        """Step over the next samples.

        Parameters
        ----------
        samples : int
            At least 1, at most what is left of the current 128 samples.

        Returns
        -------
        Block
            The samples; the same ones whatever the sizes of the blocks.

        Raises
        ------
        RollerSimError
            If `samples` would reach over a multiple of 128 samples.
        """
        first = self._next_sample % self._samples
        left = self._samples - first
        if not 1 <= samples <= left:
            raise RollerSimError(
                f"advance({samples}): must be 1 … {left}, what is left until sample "
                f"{self._next_sample + left}, where frequency and soil may change"
            )
        if first == 0:
            self._begin_revolution()
        revolution = self._revolution
        assert revolution is not None  # set by _begin_revolution at the first sample
        out = self._ground.advance(first, samples)
        soil = self._soil
        block = Block(
            first_sample=self._next_sample,
            time_s=self._revolution_start_s + first * revolution.sample_period_s,
            sample_period_s=revolution.sample_period_s,
            excitation_hz=revolution.frequency_hz,
            eccentric_phase_rad=math.fmod(
                revolution.phase_rad + first * revolution.phase_increment_rad, TWO_PI
            ),
            phase_increment_rad=revolution.phase_increment_rad,
            acceleration_vertical=out[at.OUT_VERTICAL],
            acceleration_horizontal=out[at.OUT_HORIZONTAL],
            soil_force=out[at.OUT_FORCE],
            drum_height=-out[at.OUT_DEPTH],
            soil_displacement=-out[at.OUT_SURFACE],
            plastic_depth=out[at.OUT_PLASTIC],
            height_datum=out[at.OUT_DATUM],
            contact_state=out[at.OUT_PHASE].astype(np.uint8),
            shear_modulus_pa=soil.shear_modulus_pa,
            plastic_parameter_m=soil.plastic_parameter_m,
        )
        self._next_sample += samples
        return block

    def _begin_revolution(self) -> None:
        if self._revolution is not None:
            duration_s = self._samples * self._revolution.sample_period_s
            self._revolution_start_s += duration_s
            self.site.move(duration_s, self._force_ratio())
        for name, value, master in self.masters.take_effect(self.site):
            self._tell(name, value, master)
        if self._programme is not None and self.masters.exciter is Master.SCENARIO:
            self._follow(self._programme)
        if self._pending:
            self._apply_pending()
        if self.supervision is not None:
            self.supervision.begin_revolution(self.moment, self._drive)
        self._revolution = self._drive.next_revolution()
        self._soil = self.site.soil(self.configuration.soil)
        self._ground.begin(self._revolution, self._soil)

    def _apply_pending(self) -> None:
        before = self.configuration.flat()
        self.configuration = self.configuration.changed(self._pending)
        for name, value in self._pending.items():
            if name in _COMMAND_PARAMETERS:
                self._command_sample = self._next_sample
            if before[name] != value:
                self._tell(name, value, self._master_of(name))
        self._pending = {}
        exciter = self.configuration.exciter
        self._drive.target_frequency_hz = exciter.frequency_hz if exciter.vibrate else 0.0
        self._drive.target_amplitude_m = exciter.amplitude_m
        self._drive.frequency_rate_hz_per_s = exciter.frequency_rate_hz_per_s
        self._drive.amplitude_rate_m_per_s = exciter.amplitude_rate_m_per_s

    def _follow(self, programme: Programme) -> None:
        """Let the exciter do what the scenario has it do here and now."""
        command = programme.command(self.moment)
        exciter = self.configuration.exciter
        now = (exciter.vibrate, exciter.frequency_hz, exciter.amplitude_m)
        wanted = (command.vibrate, command.frequency_hz, command.amplitude_m)
        if wanted != now:
            self._pending.update(zip(_COMMAND_PARAMETERS, wanted, strict=True))

    def _master_of(self, name: str) -> Master:
        return self.masters.exciter if name in _COMMAND_PARAMETERS else Master.NONE

    def _tell(self, name: str, value: Value, master: Master) -> None:
        self._applied.append(Applied(self._next_sample, name, value, master))

    def _force_ratio(self) -> float:
        """Amplitude of the exciter's force over the static load."""
        machine = self.configuration.machine
        return (
            machine.drum_mass_kg
            * self._drive.amplitude_m
            * (TWO_PI * self._drive.frequency_hz) ** 2
            / machine.static_load_n
        )


def warm_up(configuration: Configuration) -> None:
    """Compile the kernels that a configuration needs, so that the first block of a run is not late.

    One revolution each with and without phase changes.
    """
    exciter = replace(configuration.exciter, vibrate=True, frequency_hz=28.0, amplitude_m=2e-3)
    session = Session(replace(configuration, exciter=exciter))
    for _ in range(2):
        session.advance(session.samples_per_revolution)
