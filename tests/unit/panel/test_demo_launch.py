from __future__ import annotations

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


def assigned(path: Path) -> dict[str, object]:
    """Literal dictionaries that a module assigns, by name."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {
        node.targets[0].id: ast.literal_eval(node.value)  # type: ignore[attr-defined]
        for node in tree.body
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Dict)
    }


def test_its_arguments_are_those_of_roller_and_page() -> None:
    # launch itself is part of a ROS 2 installation and not among the wheels.
    path = ROOT / "launch" / "demo.launch.py"
    found = assigned(path)
    sim = (ROOT / "launch" / "sim.launch.py").read_text(encoding="utf-8")
    assert set(found["ROLLER"]) >= {"namespace", "params_file", "record"}  # type: ignore[call-overload]
    for name in found["ROLLER"]:  # type: ignore[attr-defined]
        assert f'"{name}"' in sim
    command = (ROOT / "roller_sim_ros" / "commands" / "panel.py").read_text(encoding="utf-8")
    for name in found["PAGE"]:  # type: ignore[attr-defined]
        assert f'"--{name}"' in command
    assert '"use_sim_time"' in path.read_text(encoding="utf-8")
