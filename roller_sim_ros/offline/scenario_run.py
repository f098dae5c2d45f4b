# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A run of a scenario from its start to its end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from roller_sim_ros.emulation.instruments import Instruments
from roller_sim_ros.offline.run import Progress, Step
from roller_sim_ros.scenario import Journal, Scenario, SiteMap, Start
from roller_sim_ros.session import Block, Session


@dataclass(frozen=True)
class ScenarioRun:
    """What came of a run.

    Attributes
    ----------
    site_map : SiteMap
        What was true along the lane, revolution by revolution.
    finished : bool
        Whether all was driven; else the run was cut short.
    duration_s : float
        Simulated time.
    unsettled_steps : int
        Of the session; 0 in all sound runs.
    """

    site_map: SiteMap
    finished: bool
    duration_s: float
    unsettled_steps: int


def step_with_faults(session: Session, start: Start) -> Step:
    """Return what steps a session of a scenario by whole revolutions, with the faults of its exciter.

    Parameters
    ----------
    session : Session
        Made from `start`, at its beginning.
    start : Start
        For sensors and faults.
    """
    samples = session.samples_per_revolution
    if not start.faults:
        return lambda: session.advance(samples)
    instruments = Instruments(session, start.sensors, start.faults, start.seed)

    def step() -> Block:
        block = session.advance(samples)
        instruments.read(block)
        return block

    return step


def run_scenario(
    scenario: Scenario,
    session: Session,
    step: Step,
    progress: Progress,
    most_revolutions: int | None = None,
    on_revolution: Callable[[], None] = lambda: None,
) -> ScenarioRun:
    """Step until all is driven.

    Parameters
    ----------
    scenario : Scenario
        For the share that is done.
    session : Session
        At its start.
    step : callable
        Steps it over the next block; blocks are divisors of the revolution.
    progress : callable
        Told the share that is done, once a revolution.
    most_revolutions : int, optional
        After which the run is cut short.
    on_revolution : callable
        Called after each revolution.
    """
    journal = Journal(session)
    samples = session.samples_per_revolution
    done = 0
    while not session.site.position.finished and done != most_revolutions:
        end = session.next_sample + samples
        while session.next_sample < end:
            block = step()
            journal.feed(block)
        done += 1
        on_revolution()
        progress(_share(scenario, session))
    return ScenarioRun(
        site_map=journal.map(),
        finished=session.site.position.finished,
        duration_s=0.0 if not done else block.time_s + len(block) * block.sample_period_s,
        unsettled_steps=session.unsettled_steps,
    )


def _share(scenario: Scenario, session: Session) -> float:
    if scenario.duration_s is not None:
        return min(1.0, session.moment.time_s / scenario.duration_s)
    position, length_m = session.site.position, scenario.lane.length_m
    forward = (position.pass_number % 2 == 1) == (scenario.travel.direction == "forward")
    along = position.chainage_m if forward else length_m - position.chainage_m
    return min(1.0, (position.pass_number - 1 + along / length_m) / scenario.travel.passes)
