# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim sweep``: what the roller settles on over a grid of parameters."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roller_sim_ros.commands.axis_flags import add_axis_flags, axis_of_flag, given_axes
from roller_sim_ros.commands.flags import add_params_flag
from roller_sim_ros.commands.numbers import whole
from roller_sim_ros.commands.parser import terse_parser
from roller_sim_ros.commands.progress import add_progress_flag
from roller_sim_ros.commands.soil_flags import add_soil_flags, soil_from, with_presets
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.parameters.file import read_parameters
from roller_sim_ros.sweep.errors import AxisError, SweepFileError
from roller_sim_ros.sweep.grid import Grid
from roller_sim_ros.sweep.plan import DEFAULT_REVOLUTIONS, DOWN, UP, Continuation, Plan

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from roller_sim_ros.sweep.results import Results
    from roller_sim_ros.sweep.task import Outcome

DESCRIPTION = """\
Run the roller at every point of a grid of parameters and write what it settles on into one labelled file (netCDF-4):
period, mode, greatest soil force over the static one and its mean over the blows, share of the time in the air, extreme
accelerations and meter values over the last 64 revolutions, with units and all parameters inside.
"""

EPILOG = """\
examples:
  roller-sim sweep --frequency-hz 15:40:101 --amplitude-mm 0.1:2.5:101 --shear-modulus-mpa 80 --plastic-mm 0.5 \\
      --half-space two-pole --out map.nc
  roller-sim sweep --frequency-hz 28,30 --shear-modulus-mpa 15:120:22 --out cmv.nc
  roller-sim sweep --amplitude-mm 0.1:2.5:101 --continue up --out up.nc

Flags with [,…|:…:N] take one value, a list 28,30 or a range 15:40:101: first, last, how many. Each point has the
numbers of roller-sim run with the same parameters. Read the file with xarray.open_dataset("map.nc").
"""

Progress = Callable[[int], None]
"""Told how many more points are done."""

_SAVE_EVERY_S = 10.0
_SAVING_SHARE = 0.05
"""Most of the time that may go into saving what is done."""

_CONNECTING_S = 5.0


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0 when all points are done, 130 when interrupted; what is done is then in the file.

    Raises
    ------
    RollerSimError
        If a parameter or the grid is refused, the file exists, or it cannot be read or written.
    """
    arguments = _parser().parse_args(argv)
    plan = _plan(arguments)
    path: Path = arguments.out
    _check_place(path, resume=arguments.resume, force=arguments.force)
    # What takes long to import comes after everything that can be refused.
    from roller_sim_ros.sweep.file import write
    from roller_sim_ros.sweep.filling import fill

    results = _results(plan, path, resume=arguments.resume)
    before, began = results.points_done, time.monotonic()
    try:
        with ExitStack() as stack:
            executor = stack.enter_context(_executor(arguments.scheduler, arguments.workers))
            progress = stack.enter_context(_progress(results, always=arguments.progress))
            fill(results, executor, _Keeper(results, path, progress).take)
    except (KeyboardInterrupt, RollerSimError) as stop:
        if results.points_done > before:
            write(results, path)
            print(
                f"roller-sim sweep: {results.points_done} of {plan.grid.size} points are in {path}; "
                "go on with --resume",
                file=sys.stderr,
            )
        if isinstance(stop, RollerSimError):
            raise
        return 130
    write(results, path)
    print(_summary(results, path, time.monotonic() - began))
    return 0


class _Keeper:
    """Saves what is done from time to time.

    Parameters
    ----------
    results : Results
        What is filled in.
    path : pathlib.Path
        Where it is saved.
    progress : callable
        Told of the points that were done.
    """

    def __init__(self, results: Results, path: Path, progress: Progress) -> None:
        self._results = results
        self._path = path
        self._progress = progress
        self._next_save = time.monotonic() + _SAVE_EVERY_S

    def take(self, outcome: Outcome) -> None:
        """Note that some points are filled in."""
        from roller_sim_ros.sweep.file import write

        self._progress(len(outcome.points))
        began = time.monotonic()
        if began < self._next_save:
            return
        write(self._results, self._path)
        ended = time.monotonic()
        self._next_save = ended + max(_SAVE_EVERY_S, (ended - began) / _SAVING_SHARE)


def _plan(arguments: argparse.Namespace) -> Plan:
    """Return what is asked for: the defaults, changed by the file, the presets and the flags, and the axes."""
    axes, given = given_axes(arguments)
    base = Configuration()
    if arguments.params is not None:
        base = base.changed(read_parameters(arguments.params))
    base = with_presets(base, arguments, given)
    if any(axis.name.startswith("machine.") for axis in axes) and soil_from(
        arguments, base.machine
    ):
        raise AxisError(
            "a ground given by --soil or its state has another p under each machine: give "
            "--shear-modulus-mpa and --plastic-mm when the machine is an axis"
        )
    grid = Grid(axes, base)
    continuation = None
    if arguments.direction is not None:
        continuation = Continuation(_along(grid, arguments.along), arguments.direction)
    elif arguments.along is not None:
        raise AxisError(f"--along {arguments.along}: say --continue {UP} or --continue {DOWN} too")
    return Plan(grid, arguments.revolutions, continuation, early_stop=not arguments.all_revolutions)


def _along(grid: Grid, flag: str | None) -> str:
    """Return the axis to continue along: the one that is named, or the only one."""
    if flag is not None:
        return axis_of_flag(flag)
    if len(grid.axes) > 1:
        flags = ", ".join(axis.quantity.flag.removeprefix("--") for axis in grid.axes)
        raise AxisError(f"--continue: say along which axis, as in --along NAME; there are {flags}")
    return grid.axes[0].name


def _check_place(path: Path, *, resume: bool, force: bool) -> None:
    """Refuse a place at which the file could not be written, or should not."""
    if path.is_dir():
        raise SweepFileError(path, "is a folder")
    if not path.parent.is_dir():
        raise SweepFileError(path, "its folder does not exist")
    if path.exists() and not (resume or force):
        raise SweepFileError(path, "exists; go on with it by --resume or replace it by --force")


def _results(plan: Plan, path: Path, *, resume: bool) -> Results:
    """Return empty results, or those in the file to go on with."""
    from roller_sim_ros.sweep.file import read
    from roller_sim_ros.sweep.results import Results

    if not (resume and path.exists()):
        return Results.none_of(plan)
    results = read(path)
    difference = plan.difference(results.plan)
    if difference:
        raise SweepFileError(
            path, f"is another sweep, which --resume cannot go on with: {difference}"
        )
    return results


@contextmanager
def _executor(scheduler: str | None, workers: int | None) -> Iterator[Executor]:
    """Yield who computes: threads here, or the workers of a scheduler of dask.distributed."""
    from roller_sim_ros.sweep.filling import executor_or_threads

    if scheduler is None:
        with executor_or_threads(None, workers) as threads:
            yield threads
        return
    # It has no types.
    distributed: Any = import_module("distributed")
    try:
        client = distributed.Client(scheduler, timeout=_CONNECTING_S)
    except (OSError, ValueError) as error:
        raise RollerSimError(f"--scheduler {scheduler}: cannot be reached: {error}") from None
    with client:
        yield client.get_executor(pure=False)


@contextmanager
def _progress(results: Results, *, always: bool) -> Iterator[Progress]:
    """Yield what shows a bar with the remaining time on the standard error, where somebody looks."""
    from tqdm import tqdm

    with tqdm(
        total=results.plan.grid.size,
        initial=results.points_done,
        unit="point",
        disable=not (always or sys.stderr.isatty()),
        dynamic_ncols=True,
    ) as bar:

        def show(points: int) -> None:
            bar.update(points)

        yield show


def _summary(results: Results, path: Path, took_s: float) -> str:
    """Return what was done, and how the points divide into modes."""
    import numpy as np

    from roller_sim_ros.meters.mode import Mode

    grid = results.plan.grid
    axes = " × ".join(f"{len(axis)} {axis.dimension}" for axis in grid.axes)
    modes = results.arrays["mode"].reshape(-1)
    shares = [
        f"{100.0 * share:.1f} % {item.label}"
        for item in Mode
        if (share := np.count_nonzero(modes == item) / grid.size) > 0.0
    ]
    return f"{path}: {grid.size} points, {axes}, {took_s:.1f} s\n{', '.join(shares)}"


def _parser() -> argparse.ArgumentParser:
    parser = terse_parser("sweep", DESCRIPTION, EPILOG, "roller-sim sweep --out FILE [OPTION ...]")
    parser.add_argument(
        "--out", metavar="FILE", type=Path, required=True, help="file to write, as in map.nc"
    )
    exists = parser.add_mutually_exclusive_group()
    exists.add_argument(
        "--resume",
        action="store_true",
        help="go on with the file, which must be of the same sweep; begin it if there is none",
    )
    exists.add_argument("--force", action="store_true", help="replace the file if there is one")
    parser.add_argument(
        "--revolutions",
        metavar="N",
        type=whole(1),
        default=DEFAULT_REVOLUTIONS,
        help="revolutions at each point, at least 2 (default: %(default)s)",
    )
    parser.add_argument(
        "--all-revolutions",
        action="store_true",
        help="compute also revolutions that repeat those before to rounding; changes no result beyond 1e-9",
    )
    parser.add_argument(
        "--continue",
        dest="direction",
        choices=(UP, DOWN),
        help="start each point from the final state of its neighbour, going up or down an axis; "
        "otherwise each point starts at rest",
    )
    parser.add_argument(
        "--along",
        metavar="AXIS",
        help="the axis of --continue by its flag, as in amplitude-mm (default: the only one)",
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=whole(1),
        help="threads (default: one for each core); the results are the same",
    )
    parser.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="compute on the workers of a dask.distributed scheduler, as in tcp://10.0.0.1:8786",
    )
    add_progress_flag(parser)
    add_params_flag(parser)
    add_soil_flags(parser)
    add_axis_flags(parser, exclude=("recording.path",))
    return parser
