# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The fixtures for users' tests: used here, and by pytest in processes of its own as a user would."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from roller_sim_ros.errors import RollerSimError
from tests.integration.harness import recorded

if TYPE_CHECKING:
    # pytest wants to be the first to import it.
    from roller_sim_ros.testing import Roller

pytest_plugins = ["roller_sim_ros.testing"]

ROOT = Path(__file__).resolve().parents[2]
PATIENCE_S = 200.0


def samples(roller: Roller) -> np.ndarray:
    return np.concatenate([block.vertical for block in roller.received("drum/acceleration")])


def test_all_that_a_test_can_do(roller: Roller) -> None:
    assert roller.step(revolutions=2) == 256
    assert roller.step(samples=10) == 266
    assert len(samples(roller)) == 266
    assert roller.step(samples=118) == 384
    assert len(roller.received("meter")) == len(roller.received("site/state")) == 3
    roller.command(frequency_hz=31.0, amplitude_m=1e-3)
    roller.drive(0.5)
    roller.step(revolutions=2)
    assert roller.last("exciter/state").commanded_frequency == 31.0
    assert roller.last("site/state").speed == 0.5
    roller.command(frequency_hz=-1.0, amplitude_m=1e-3)
    roller.step(revolutions=1)
    assert "frequency -1 Hz" in roller.last("exciter/state").refusal_reason
    roller.release()
    handle = roller.inject("bias_step", bias_m_s2=3.0)
    roller.set_parameters(soil__shear_modulus_pa=80e6)
    roller.step(revolutions=1)
    assert roller.last("truth").shear_modulus == 80e6
    assert [fault.id for fault in roller.last("faults").faults] == ["bias_step"]
    assert roller.last("site/state").speed == 0.0
    roller.clear(handle)
    before = len(samples(roller))
    after = roller.step(seconds=0.1)
    assert after == len(samples(roller))
    assert after - before == pytest.approx(128, abs=4)  # at the sampling's floor of 10 Hz
    roller.step(revolutions=1)
    assert roller.last("faults").faults == []
    refusals(roller)


def refusals(roller: Roller) -> None:
    with pytest.raises(RollerSimError, match="give one of them"):
        roller.step()
    with pytest.raises(RollerSimError, match="give one of them"):
        roller.step(revolutions=1, samples=1)
    with pytest.raises(
        RollerSimError, match=r"step\(revolutions=0, seconds=inf, samples=0\): give"
    ):
        roller.step(seconds=float("inf"))
    with pytest.raises(RollerSimError, match="revolutions 999999: must be at most"):
        roller.step(revolutions=999_999)
    with pytest.raises(RollerSimError, match="soil.density_kg_m3 = 1.0: must be at least"):
        roller.set_parameters(soil__density_kg_m3=1.0)
    with pytest.raises(RollerSimError, match="there is no fault 'spikes'; did you mean spike"):
        roller.inject("spikes")
    with pytest.raises(RollerSimError, match="no fault with the handle 7"):
        roller.clear(7)
    with pytest.raises(RollerSimError, match="topic nothing: is not listened to"):
        roller.last("nothing")
    with pytest.raises(RollerSimError, match="topic tacho: nothing has come yet"):
        roller.last("tacho")
    ended = roller.start("program", sys.executable, "-c", "print('not today'); raise SystemExit(3)")
    assert ended.wait(PATIENCE_S) == 3
    with pytest.raises(RollerSimError, match="the program ended with 3; .*not today"):
        roller.wait_for(lambda: False)


def test_two_rollers_get_the_same_samples_and_do_not_hear_each_other(
    start_roller: Callable[..., Roller],
) -> None:
    rollers = [start_roller("--scenario", "sensor_failure_campaign") for _ in range(2)]
    assert rollers[0].domain != rollers[1].domain
    for roller in rollers:
        roller.step(revolutions=20)
    first, second = map(samples, rollers)
    assert first.tobytes() == second.tobytes()
    assert len(first) > 0
    assert len(rollers[0].received("truth")) == 20 * 8
    # What was recorded is what came.
    assert len(recorded(rollers[0].trace, "/meter")) <= len(rollers[0].received("meter"))


def test_arguments_that_the_roller_refuses(start_roller: Callable[..., Roller]) -> None:
    with pytest.raises(RollerSimError, match="the roller ended with 1; .*no file and no scenario"):
        start_roller("--scenario", "no_such_scenario")


def test_a_test_that_gets_no_processor_still_gets_all_messages(tmp_path: Path) -> None:
    # Stopped, it fetches nothing: in one request the step would send far more than shared memory keeps for it.
    script = """
        from pathlib import Path
        from roller_sim_ros.testing import Roller
        from roller_sim_ros.wire import topics

        per_revolution = [topics.METER, topics.CMV, *topics.FURTHER_METERS, topics.SITE_STATE]
        with Roller(Path("run")) as roller:
            for _ in range(6):
                print("steps", flush=True)
                revolutions = roller.step(seconds=3.0) // 128
                print(revolutions, *(len(roller.received(topic.name)) for topic in per_revolution))
        """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(script)],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    with process:
        for _ in range(6):
            assert process.stdout.readline() == "steps\n"
            time.sleep(0.1)
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.5)
            process.send_signal(signal.SIGCONT)
            revolutions, *received = map(int, process.stdout.readline().split())
            assert received == [revolutions] * len(received)
    assert revolutions > 300


def test_as_a_user_runs_it(tmp_path: Path) -> None:
    # The page's own files, each with its name in the first line.
    page = (ROOT / "docs" / "testing.md").read_text(encoding="utf-8")
    files = re.findall(r"```python\n# (\S+)\n(.*?)```", page, flags=re.DOTALL)
    assert [name for name, _ in files] == ["conftest.py", "test_ground.py"]
    for name, text in files:
        (tmp_path / name).write_text(text)
    for name in ("test_my_meter.py", "meter_client.py"):
        shutil.copy(ROOT / "examples" / name, tmp_path)
    (tmp_path / "test_other.py").write_text(
        textwrap.dedent(
            """
            def test_that_fails(roller):
                assert roller.step(revolutions=1) == 129
            """
        )
    )
    done = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "--strict-markers", "-p", "no:cacheprovider"),
            *("--basetemp", str(tmp_path / "base"), "--roller-traces", str(tmp_path / "kept")),
        ],
        cwd=tmp_path,
        env={**os.environ, "PYTEST_ADDOPTS": ""},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert "1 failed, 2 passed" in done.stdout, done.stdout + done.stderr
    assert "assert 128 == 129" in done.stdout
    (kept,) = (tmp_path / "kept").iterdir()
    assert f"test_other.py::test_that_fails: roller's trace {kept}" in done.stdout
    assert len(recorded(kept, "/truth")) == 8
    # Of those that passed none is left.
    traces = [path.parent.parent.name for path in (tmp_path / "base").rglob("*.mcap")]
    assert traces == ["test_that_fails0"]
