# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Printing, with browsers that do what real ones do only in bad surroundings."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest

from roller_sim_ros import processes
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.report import pdf
from roller_sim_ros.report.files import write

PATIENCE_S = 30.0

PRINTS = """\
for argument in "$@"; do case $argument in --print-to-pdf=*) printf '%%PDF-1.4 new' >"${argument#*=}" ;; esac; done
"""

NEEDS_NONE = """\
case "$*" in *--no-sandbox*) ;; *) echo "[1:1:FATAL] No usable sandbox! If this is …" >&2; exit 1 ;; esac
"""


@pytest.fixture
def target(tmp_path: Path) -> Path:
    """A PDF of before, alone in a folder."""
    folder = tmp_path / "out"
    folder.mkdir()
    path = folder / "page.pdf"
    path.write_text("before", encoding="utf-8")
    return path


def browser(tmp_path: Path, script: str) -> str:
    """A program that keeps what it was called with in ``calls``."""
    path = tmp_path / "browser"
    path.write_text(f'#!/bin/sh\necho "$*" >>"{tmp_path}/calls"\n{script}', encoding="utf-8")
    path.chmod(0o755)
    return str(path)


def calls(tmp_path: Path) -> list[str]:
    return (tmp_path / "calls").read_text(encoding="utf-8").splitlines()


def refused(target: Path, program: str) -> str:
    """The error, after which nothing has changed."""
    with pytest.raises(RollerSimError) as caught:
        pdf.write_pdf("<p>page</p>", target, program)
    assert [path.name for path in target.parent.iterdir()] == ["page.pdf"]
    assert target.read_text(encoding="utf-8") == "before"
    assert "\n" not in str(caught.value)
    return str(caught.value)


def runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text(encoding="ascii").rpartition(")")[2][1] != "Z"
    except FileNotFoundError:
        return False


def test_a_browser_that_hangs_is_ended_with_what_it_started(
    target: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pdf, "LONGEST_S", 1.0)
    monkeypatch.setattr(processes, "GRACE_S", 0.2)
    script = f"trap '' TERM\nsleep 600 &\necho $! >{tmp_path}/child\necho $$ >{tmp_path}/own\nwait\nsleep 600\n"
    error = refused(target, browser(tmp_path, script))
    assert "not printed it within 1 s" in error
    assert "print the HTML page" in error
    deadline = time.monotonic() + PATIENCE_S
    for name in ("child", "own"):
        while runs(int((tmp_path / name).read_text(encoding="ascii"))):
            assert time.monotonic() < deadline
            time.sleep(0.01)


def test_what_a_browser_says_when_it_fails_is_told(target: Path, tmp_path: Path) -> None:
    script = "echo 'it is broken' >&2\necho '[1:2:ERROR:dbus/bus.cc:405] no desktop' >&2\nexit 3\n"
    assert refused(target, browser(tmp_path, script)).endswith("printed nothing: it is broken")
    assert refused(target, browser(tmp_path, "exit 0\n")).endswith("it does not say why")


def test_what_is_no_program_is_said(target: Path, tmp_path: Path) -> None:
    path = tmp_path / "browser"
    path.write_bytes(b"\0\0\0\0")
    path.chmod(0o755)
    assert "cannot be started" in refused(target, str(path))


@pytest.mark.parametrize(
    ("user", "script", "sandboxes"),
    [(1000, "", [True]), (1000, NEEDS_NONE, [True, False]), (0, NEEDS_NONE, [False])],
    ids=["sandbox", "none can be made", "root"],
)
def test_the_sandbox_is_left_out_only_where_there_can_be_none(
    target: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    user: int,
    script: str,
    sandboxes: list[bool],
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: user)
    pdf.write_pdf("<p>page</p>", target, browser(tmp_path, script + PRINTS))
    assert ["--no-sandbox" not in call for call in calls(tmp_path)] == sandboxes
    assert target.read_text(encoding="utf-8") == "%PDF-1.4 new"
    assert [path.name for path in target.parent.iterdir()] == ["page.pdf"]


def test_a_device_is_not_replaced(tmp_path: Path) -> None:
    with pytest.raises(RollerSimError, match="/dev/null: cannot be written: it is no ordinary"):
        pdf.write_pdf("<p>page</p>", Path("/dev/null"), browser(tmp_path, PRINTS))
    assert Path("/dev/null").is_char_device()


def test_folded_parts_are_printed_unfolded(target: Path, tmp_path: Path) -> None:
    script = f'for last; do :; done\ncp "${{last#file://}}" {tmp_path}/printed.html\n{PRINTS}'
    pdf.write_pdf("<details><summary>more</summary></details>", target, browser(tmp_path, script))
    printed = (tmp_path / "printed.html").read_text(encoding="utf-8")
    assert printed == "<details open><summary>more</summary></details>"


def test_browsers_are_found_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("google-chrome", "mine"):
        (tmp_path / name).write_text("#!/bin/sh\n", encoding="utf-8")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CHROMIUM", raising=False)
    assert pdf.find_browser() == str(tmp_path / "google-chrome")
    monkeypatch.setenv("CHROMIUM", str(tmp_path / "mine"))
    assert pdf.find_browser() == str(tmp_path / "mine")
    (tmp_path / "google-chrome").unlink()
    monkeypatch.delenv("CHROMIUM")
    with pytest.raises(RollerSimError, match="apt-get install chromium.*CHROMIUM=/path.*HTML page"):
        pdf.find_browser()


def test_a_page_takes_the_place_of_the_one_before(tmp_path: Path) -> None:
    path, link = tmp_path / "page.html", tmp_path / "link.html"
    path.write_text("before", encoding="utf-8")
    link.symlink_to(path)
    write("after", link)
    assert link.is_symlink()
    assert path.read_text(encoding="utf-8") == "after"
    assert sorted(tmp_path.iterdir()) == [link, path]
    write("nowhere", Path("/dev/null"))
    assert Path("/dev/null").is_char_device()
    for bad in (Path("/proc/page.html"), Path("/dev/full")):
        with pytest.raises(RollerSimError, match=f"{bad}: cannot be written"):
            write("page", bad)
