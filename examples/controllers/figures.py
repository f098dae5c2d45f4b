# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The figures and the tables of docs/controllers.md: each controller in a scenario, and the scenario without one.

python -m examples.controllers.figures --write            # docs/figures/controller_*.png, and the tables of the page
python -m examples.controllers.figures --only jump_guard --scenario soft_to_stiff --seed 7 --frequency-hz 30
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from examples.controllers.force_limiter import ForceLimiter
from examples.controllers.jump_guard import JumpGuard
from examples.controllers.measurement import Law
from examples.controllers.model_based import ModelBased
from examples.controllers.offline import alone, best_constant_mm, drive, jumping
from examples.controllers.phase_tracker import PhaseTracker
from roller_sim_ros.analysis.panels import BLUE, GREY, LIGHT, drawn_figure
from roller_sim_ros.scenario import Scenario, SiteMap, read_scenario
from roller_sim_ros.scenario.shipped import scenario_path
from tools.markdown_table import table
from tools.sections import write_section

PAGE = Path(__file__).resolve().parents[2] / "docs" / "controllers.md"
SCENARIO = "soft_to_stiff"
GUARD_HZ = (25.0, 28.0, 32.0)

LAWS: dict[str, Callable[[], Law]] = {
    "jump_guard": JumpGuard,
    "phase_tracker": PhaseTracker,
    "force_limiter": ForceLimiter,
    "model_based": ModelBased,
}

Pick = Callable[[SiteMap], NDArray[np.float64]]
PANELS: tuple[tuple[str, Pick], ...] = (
    ("(a) Amplitude of the exciter, mm", lambda it: it.amplitude_m * 1e3),
    ("(b) Frequency of the exciter, Hz", lambda it: it.frequency_hz),
    ("(c) True RMV", lambda it: it.rmv),
    ("(d) True F_max/F_stat", lambda it: it.force_ratio_max),
)


def draw(name: str, scenario: Scenario, without: SiteMap, under: SiteMap, path: Path) -> None:
    """Draw amplitude, frequency, RMV and F_max/F_stat over the chainage, with and without a controller."""
    with drawn_figure(path) as figure:
        figure.suptitle(
            f"{name} in {scenario.title}; G {_range(under.shear_modulus_pa * 1e-6)} MPa; seed {scenario.seed}",
            fontsize=8.0,
            color=GREY,
        )
        panels = figure.subplots(2, 2, sharex=True)
        for axes, (title, pick) in zip(panels.flat, PANELS, strict=True):
            axes.set_title(title)
            axes.plot(without.chainage_m, pick(without), color=GREY, label="without", zorder=1)
            axes.plot(under.chainage_m, pick(under), color=BLUE, label=f"with {name}", zorder=2)
            _shade_jumps(axes, without)
        panels[0, 0].set_ylim(bottom=0.0)
        panels[0, 0].legend(loc="lower left")
        panels[0, 1].set_yticks(range(15, 36, 5))
        panels[1, 0].set_yscale("log")
        panels[1, 0].set_ylim(0.1, 400.0)
        panels[1, 1].set_ylim(bottom=0.0)
        for axes in panels[1]:
            axes.set_xlabel("chainage, m (shaded: double jump without the controller)")
        panels[0, 0].set_xlim(0.0, float(under.chainage_m.max()))


def _shade_jumps(axes: Axes, site_map: SiteMap) -> None:
    axes.fill_between(
        site_map.chainage_m,
        0,
        1,
        where=list(jumping(site_map.mode, site_map.rmv)),
        transform=axes.get_xaxis_transform(),
        color=LIGHT,
        linewidth=0,
        zorder=0,
    )


def _range(values: NDArray[np.float64]) -> str:
    return f"{values.min():.0f} to {values.max():.0f}"


def row(name: str, site_map: SiteMap) -> tuple[str, ...]:
    """Return what came out as a row of the table."""
    known = np.isfinite(site_map.force_ratio_max)
    return (
        name,
        _jumps(site_map),
        _mean_amplitude(site_map),
        f"{_range(site_map.frequency_hz)} Hz",
        f"{site_map.force_ratio_max[known].max():.1f}",
    )


def guard_row(scenario: Scenario) -> tuple[str, ...]:
    """Return what the jump guard does at one frequency, beside the best constant amplitude."""
    under = drive(scenario, JumpGuard())
    return (
        f"{scenario.exciter.frequency_hz:.0f} Hz",
        _jumps(alone(scenario)),
        _jumps(under),
        _mean_amplitude(under),
        f"{best_constant_mm(scenario):.2f} mm",
    )


def _jumps(site_map: SiteMap) -> str:
    return f"{100.0 * jumping(site_map.mode, site_map.rmv).mean():.1f} %"


def _mean_amplitude(site_map: SiteMap) -> str:
    return f"{1e3 * site_map.amplitude_m.mean():.2f} mm"


def at_frequency(scenario: Scenario, frequency_hz: float) -> Scenario:
    """Return the scenario at another frequency, Hz."""
    return replace(scenario, exciter=replace(scenario.exciter, frequency_hz=frequency_hz))


def main() -> None:
    """Draw the figures and print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--out", type=Path, default=Path("docs/figures"), help="folder of the figures (%(default)s)"
    )
    parser.add_argument(
        "--only", choices=tuple(LAWS), help="one of the controllers; all when left out"
    )
    parser.add_argument("--scenario", default=SCENARIO, help="name or file (%(default)s)")
    parser.add_argument("--seed", type=int, help="another seed than the scenario's")
    parser.add_argument(
        "--frequency-hz", type=float, help="another frequency, Hz, than the scenario's"
    )
    parser.add_argument(
        "--write",
        action="store_true",
        help=f"put the table, and that of the jump guard's frequencies, into {PAGE.parent.name}/{PAGE.name}",
    )
    arguments = parser.parse_args()
    others = (arguments.only, arguments.seed, arguments.frequency_hz)
    if arguments.write and (arguments.scenario, *others) != (SCENARIO, None, None, None):
        parser.error(
            "--write: the page has all controllers in the scenario as it is; leave the other options out"
        )
    scenario = read_scenario(scenario_path(arguments.scenario))
    if arguments.seed is not None:
        scenario = replace(scenario, seed=arguments.seed)
    if arguments.frequency_hz is not None:
        scenario = at_frequency(scenario, arguments.frequency_hz)
    arguments.out.mkdir(parents=True, exist_ok=True)
    without = alone(scenario)
    print(f"largest constant amplitude that never jumps: {best_constant_mm(scenario):.2f} mm")
    rows = [row("none", without)]
    for name in [arguments.only] if arguments.only else LAWS:
        under = drive(scenario, LAWS[name]())
        rows.append(row(name, under))
        draw(name, scenario, without, under, arguments.out / f"controller_{name}.png")
    head = ("controller", "double jump", "mean amplitude", "frequency", "largest F_max/F_stat")
    text = table(head, rows)
    print(text)
    if arguments.write:
        write_section(PAGE, "controllers", text)
        head = (
            "",
            "double jump without",
            "with",
            "mean amplitude",
            "largest constant without jump",
        )
        rows = [guard_row(at_frequency(scenario, frequency_hz)) for frequency_hz in GUARD_HZ]
        write_section(PAGE, "jump_guard", table(head, rows))


if __name__ == "__main__":
    main()
