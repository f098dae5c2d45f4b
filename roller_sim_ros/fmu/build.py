# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Builds the unit: this package's modules, a configuration, pythonfmu's binaries."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import Configuration

PACKAGE = Path(__file__).resolve().parents[1]
SLAVE = "roller_sim_slave.py"

COPY = "copy"
"""Folder of the unit's resources with this package's modules."""

SCRIPT = f"""\
# An installed package has its kernels compiled; the unit is unpacked anew each time.
import sys
from pathlib import Path

try:
    from {PACKAGE.name}.fmu.slave import Roller
except ModuleNotFoundError:
    sys.modules.pop("{PACKAGE.name}", None)
    sys.path.insert(0, str(Path(__file__).with_name("{COPY}")))
    from {PACKAGE.name}.fmu.slave import Roller
"""
"""What pythonfmu loads."""

CONFIGURATION = "configuration.json"
"""The configuration among the unit's resources: {dotted name: SI value}."""

_NEEDED = "errors.py", "jit.py", "share.py", "__init__.py", "py.typed"
_FOLDERS = (
    "parameters",
    "soil_mechanics",
    "site",
    "half_space",
    "exciter",
    "drum_soil",
    "sensors",
    "meters",
    "session",
    "fmu",
)
"""Layers that a session is made of."""


def build(configuration: Configuration, path: Path) -> None:
    """Write a unit for FMI 2.0 co-simulation.

    It brings along the modules that a session is made of, for where this package is not installed. There has to be a
    Python 3.10 or later with numpy and scipy; with numba it is a hundred times as fast, once compiled.

    Parameters
    ----------
    configuration : Configuration
        What is simulated; frequency, amplitude, G and p are the inputs' start values.
    path : pathlib.Path
        The file, ``.fmu``.

    Raises
    ------
    RollerSimError
        If pythonfmu is not installed, or the file cannot be written.
    """
    if find_spec("pythonfmu") is None:
        raise RollerSimError(
            "a unit is built by pythonfmu, which is not installed: python3 -m pip install pythonfmu"
        )
    if path.suffix != ".fmu":
        raise RollerSimError(f"{path}: the file's name has to end in .fmu")
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / SLAVE
        script.write_text(SCRIPT, encoding="utf-8")
        values = Path(folder) / CONFIGURATION
        values.write_text(json.dumps(configuration.flat(), indent=2) + "\n", encoding="utf-8")
        copy = Path(folder) / COPY
        package = copy / PACKAGE.name
        package.mkdir(parents=True)
        for name in _NEEDED:
            shutil.copy2(PACKAGE / name, package)
        for name in _FOLDERS:
            shutil.copytree(
                PACKAGE / name, package / name, ignore=shutil.ignore_patterns("__pycache__")
            )
        unit = Path(folder) / "unit.fmu"
        # In a process of its own: pythonfmu leaves its folder in the import path.
        command = [sys.executable, "-m", "pythonfmu", "build", "-f", str(script), "-d", str(unit)]
        built = subprocess.run(
            [*command, str(values), str(copy)], capture_output=True, text=True, check=False
        )
        if built.returncode or not unit.is_file():
            raise RollerSimError(f"{path}: pythonfmu failed: {built.stderr.strip()[-300:]}")
        try:
            part = path.with_name(f".{path.name}.part")
            try:
                shutil.copyfile(unit, part)
                part.replace(path)
            finally:
                part.unlink(missing_ok=True)
        except OSError as error:
            raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
