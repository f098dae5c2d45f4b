# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Files of a report; what was at a path stays until the new file is complete."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roller_sim_ros.errors import RollerSimError


@contextmanager
def replaced(path: Path) -> Iterator[Path]:
    """Yield the path of a file to be written, which then takes the place of the one at `path`.

    It lies in a folder of its own beside `path`, which is gone afterwards, with whatever else was put there.

    Raises
    ------
    RollerSimError
        If the file cannot be written, or what is there is a folder, a pipe or a device.
    """
    try:
        real = path.resolve()
        if real.exists() and not real.is_file():
            raise RollerSimError(f"{path}: cannot be written: it is no ordinary file; name another")
        # Not hidden: a browser that comes as a snap sees no hidden folder of the home folder.
        with tempfile.TemporaryDirectory(
            prefix=f"{real.name}.", suffix=".part", dir=real.parent
        ) as folder:
            part = Path(folder) / real.name
            yield part
            part.replace(real)
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None


def write(text: str, path: Path) -> None:
    """Write a text.

    Raises
    ------
    RollerSimError
        If the file cannot be written.
    """
    if path.exists() and not path.is_file():
        # A pipe or a device is written into, and not replaced.
        try:
            path.write_text(text, encoding="utf-8")
        except OSError as error:
            raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None
        return
    with replaced(path) as part:
        part.write_text(text, encoding="utf-8")
