"""Parameter files, looked at before ROS 2 reads them, for what it would pass over in silence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

from roller_sim_ros.errors import RollerSimError

_PARAMETERS = "ros__parameters"


def check_parameter_file(path: Path) -> None:
    """Check that a file can be read and has parameters for this node.

    Their names and values are checked by the node, wherever they come from.

    Raises
    ------
    RollerSimError
        If not.
    """
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise RollerSimError(f"{path}: it cannot be read: {error.strerror or error}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        reason = " ".join(str(error).split())
        raise RollerSimError(f"{path}: it is no YAML: {reason}") from error
    nodes = list(_nodes(content, ""))
    if not any(name.rpartition("/")[2] in ("**", "*", "roller_sim") for name in nodes):
        found = f"; it has them for {', '.join(nodes)}" if nodes else ""
        raise RollerSimError(
            f"{path}: it has no parameters for roller_sim, which are wanted under /**: or roller_sim: "
            f"and there under {_PARAMETERS}:{found}"
        )


def _nodes(content: Any, name: str) -> Iterator[str]:
    """Yield the names of the nodes that have parameters."""
    if not isinstance(content, Mapping):
        return
    for key, value in content.items():
        if key == _PARAMETERS:
            yield name
        else:
            yield from _nodes(value, f"{name}/{key}".replace("//", "/"))
