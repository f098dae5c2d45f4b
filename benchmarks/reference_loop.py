# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""reference_loop.c, compiled on the spot and called with the arrays of our kernels."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from benchmarks.errors import BenchmarkError
from benchmarks.kernel_call import KernelCall
from benchmarks.machine import COMPILER

FLAGS = ("-O3", "-march=native")
_SOURCE = Path(__file__).parent / "reference_loop.c"

# In the order of the functions in C.
_ARRAYS = {
    "two-pole": ("state", "constants", "sine", "cosine", "out"),
    "exact": (
        *("state", "constants", "sine", "cosine"),
        *("middle", "ramp_2", "ramp", "step", "chord", "chord_rate", "bulge_rate"),
        *("free", "free_rate", "out"),
    ),
}
_FUNCTIONS = {"two-pole": "two_pole", "exact": "exact"}


def reference(model: str, call: KernelCall) -> Callable[[], None]:
    """Return the loop in C that does what the kernel call does, on its arrays."""
    function = getattr(compiled(_SOURCE), _FUNCTIONS[model])
    function.restype = None
    arguments: list[object] = [ctypes.c_long(call.samples), ctypes.c_long(0)]
    for name in _ARRAYS[model]:
        if name not in call.arrays:
            raise BenchmarkError(
                f"the {model} kernel has no argument {name!r} any more: "
                "bring benchmarks/reference_loop.c up to date"
            )
        if name == "middle":
            arguments.append(ctypes.c_long(len(call.arrays["chord"])))
        array = call.arrays[name]
        arguments.append(array.ctypes.data_as(ctypes.POINTER(ctypes.c_double)))

    def run() -> None:
        function(*arguments)

    return run


@lru_cache(maxsize=4)
def compiled(source: Path) -> ctypes.CDLL:
    """Return the library that a source in C gives."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / f"{source.stem}.so"
        command = [COMPILER, *FLAGS, "-shared", "-fPIC", "-o", str(library), str(source), "-lm"]
        try:
            found = subprocess.run(command, capture_output=True, text=True, check=False)
        except OSError as error:
            raise BenchmarkError(f"no C compiler: {error}") from error
        if found.returncode:
            raise BenchmarkError(f"{' '.join(command)} failed:\n{found.stderr}")
        return ctypes.CDLL(str(library))
