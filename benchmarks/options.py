"""What the command line gives to the benchmarks."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Options:
    """Lengths of the measurements in real time.

    Attributes
    ----------
    seconds : float
        Of lateness, at each frequency.
    minutes : float
        Of counting lost samples.
    """

    seconds: float = 60.0
    minutes: float = 5.0
