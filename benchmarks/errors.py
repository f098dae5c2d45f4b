"""Why a benchmark gave no figures."""

from __future__ import annotations


class BenchmarkError(Exception):
    """What is missing or differs, in one line."""
