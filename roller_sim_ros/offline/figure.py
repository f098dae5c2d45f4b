# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The plot of a run: acceleration, force against displacement, spectrum in orders."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from roller_sim_ros.analysis.panels import (
    GREY,
    draw_acceleration,
    draw_force,
    draw_spectrum,
    drawn_figure,
    say_nothing,
)
from roller_sim_ros.offline.run import Tail
from roller_sim_ros.parameters import Configuration

SHOWN_REVOLUTIONS = 6


def write_figure(configuration: Configuration, tail: Tail, revolutions: int, path: Path) -> None:
    """Draw the last revolutions of a run; the file's ending chooses the format (png, pdf, svg).

    Raises
    ------
    RollerSimError
        If the file cannot be written or the format is none that there is.
    """
    with drawn_figure(path) as figure:
        panels = figure.subplot_mosaic([["acceleration"] * 2, ["force", "spectrum"]])
        exciter, soil = configuration.exciter, configuration.soil
        figure.suptitle(
            f"{tail.excitation_hz[-1]:.4g} Hz, {exciter.amplitude_m * 1e3:g} mm; "
            f"G {soil.shear_modulus_pa / 1e6:g} MPa, p {soil.plastic_parameter_m * 1e3:g} mm; "
            f"half space {configuration.half_space.model}",
            fontsize=8.0,
            color=GREY,
        )
        shown = min(tail.revolutions, SHOWN_REVOLUTIONS)
        count = shown * tail.samples_per_revolution
        axes = panels["acceleration"]
        axes.set_title("(a) Vertical drum acceleration (shaded: in the air)")
        turns = np.arange(count) / tail.samples_per_revolution
        draw_acceleration(axes, turns, tail.vertical[-count:], tail.contact_state[-count:])
        stretches = f"stretches of {tail.samples_per_revolution} samples"
        of = "revolutions of the eccentric" if tail.synchronous else stretches
        axes.set_xlabel(f"{of}, the last {shown} of {revolutions}")
        axes = panels["force"]
        axes.set_title("(b) Soil force against drum displacement")
        draw_force(axes, tail.drum_height[-count:], tail.soil_force[-count:])
        axes = panels["spectrum"]
        axes.set_title("(c) Spectrum in orders of the excitation")
        if tail.synchronous:
            draw_spectrum(axes, tail.vertical, tail.samples_per_revolution)
        else:
            say_nothing(axes, "no revolutions at one frequency")
