# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Limits: defaults, files, and mistakes told by file and line."""

from __future__ import annotations

from pathlib import Path

import pytest

from roller_sim_ros.parameters import ParameterError
from roller_sim_ros.score.limits import Limits, LimitsError, read_limits


def file(folder: Path, text: str) -> Path:
    path = folder / "limits.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_file_says_what_differs_from_the_defaults(tmp_path: Path) -> None:
    limits = read_limits(file(tmp_path, "# ours\nbias_percent: 1.5\nleast_values: 10\n"))
    assert limits == Limits(bias_percent=1.5, least_values=10)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("bias_percent: 1\nrms_procent: 2\n", "2: unknown limit 'rms_procent'; did you mean rms_"),
        ("latency_s: -1\n", "1: latency_s = -1: must be at least 0 s"),
        ("\n\nleast_values: 2.5\n", "3: least_values = 2.5: must be a whole number"),
        ("gap_s: soon\n", "1: gap_s = 'soon': must be a number of s"),
        ("gap_s: .inf\n", "1: gap_s = inf: must be finite"),
        ("gap_s: [1, 2]\n", "1: gap_s: must be a single number"),
        ("gap_s:\n", "1: gap_s: must be a single number"),
        ("gap_s: 1\ngap_s: 2\n", "2: key 'gap_s' is there already, in line 1"),
        ("- 1\n", "1: holds no limits"),
        ("", "1: holds no"),
        ("{bias_percent: 1", "is no YAML"),
    ],
)
def test_mistakes_are_told_by_file_and_line(tmp_path: Path, text: str, said: str) -> None:
    path = file(tmp_path, text)
    with pytest.raises(LimitsError) as error:
        read_limits(path)
    assert str(error.value).startswith(f"{path}:")
    assert said in str(error.value)


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(LimitsError, match=r"none\.yaml: cannot be read"):
        read_limits(tmp_path / "none.yaml")


def test_limits_are_checked_in_code_too() -> None:
    with pytest.raises(ParameterError, match=r"limits\.alarm_rmv = 0"):
        Limits(alarm_rmv=0.0)
