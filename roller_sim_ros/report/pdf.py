# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A page as PDF, printed by the Chromium or Chrome that is installed."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.processes import Process
from roller_sim_ros.report.files import replaced

NAMES = ("chromium", "chromium-browser", "google-chrome")
"""Programs that are looked for, after the one that the environment variable CHROMIUM names."""

LONGEST_S = 120.0
"""How long printing may take; it takes some seconds."""

ALONE = "--no-sandbox"
WITHOUT_SANDBOX = "No usable sandbox"
"""What Chromium says where neither its helper nor the kernel lets it make one, as in many containers."""


def find_browser() -> str:
    """Return the path of the browser.

    Raises
    ------
    RollerSimError
        If there is none.
    """
    for name in filter(None, (os.environ.get("CHROMIUM"), *NAMES)):
        found = shutil.which(name)
        if found:
            return found
    raise RollerSimError(
        f"no Chromium or Chrome is found ({', '.join(NAMES)}), which a PDF needs: install one (Debian: apt-get "
        "install chromium; Ubuntu: snap install chromium), name it with CHROMIUM=/path, or print the HTML page from "
        "a browser"
    )


def write_pdf(page: str, path: Path, browser: str) -> None:
    """Print a page.

    Parameters
    ----------
    page : str
        The page as HTML; its ``<details>`` are printed unfolded.
    path : Path
        File to write.
    browser : str
        Path of a Chromium.

    Raises
    ------
    RollerSimError
        If the browser fails or takes too long, or the file cannot be written.
    """
    with replaced(path) as part, tempfile.TemporaryDirectory() as temporary:
        source = part.with_name("page.html")
        source.write_text(page.replace("<details>", "<details open>"), encoding="utf-8")
        command = [
            browser,
            "--headless",
            f"--user-data-dir={part.with_name('profile')}",
            # It is there to print a file, and loads nothing from elsewhere.
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            # In a container /dev/shm is too small for it.
            "--disable-dev-shm-usage",
            "--no-pdf-header-footer",
            "--generate-pdf-document-outline",
            f"--print-to-pdf={part}",
        ]
        said = ""
        # Chromium makes no sandbox for root. For others it is left out only where there can be none; then the page,
        # which holds no script and is from here, is printed without.
        for sandbox in ([ALONE],) if os.geteuid() == 0 else ([], [ALONE]):
            said = _run([*command, *sandbox, source.as_uri()], path, part.parent, temporary)
            if part.is_file() or WITHOUT_SANDBOX not in said:
                break
        if not part.is_file():
            # That there is no desktop, which it goes on about, is not why.
            lines = [line for line in said.splitlines() if line.strip() and ":dbus/" not in line]
            why = lines[-1][:300] if lines else "it does not say why"
            raise RollerSimError(f"{path}: {browser} printed nothing: {why}")


def _run(command: list[str], path: Path, folder: Path, temporary: str) -> str:
    """Run the browser to its end and return what it said; whatever it started has ended then, too."""
    # What it would put into the home folder goes with the profile; its socket needs a short path.
    environment = {
        "XDG_CONFIG_HOME": str(folder),
        "XDG_CACHE_HOME": str(folder),
        "TMPDIR": temporary,
    }
    process = Process("browser", command, folder / "log", environment)
    try:
        if process.wait(LONGEST_S) is None:
            raise RollerSimError(
                f"{path}: {command[0]} has not printed it within {LONGEST_S:g} s and was ended: try again on a "
                "machine that is less busy, or print the HTML page from a browser"
            )
    finally:
        process.end()
    return process.log.read_text(encoding="utf-8", errors="replace")
