# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The parser that commands begin with."""

from __future__ import annotations

import argparse
from typing import NoReturn


def command_parser(
    command: str, description: str, epilog: str, usage: str | None = None
) -> argparse.ArgumentParser:
    """Return the parser of ``roller-sim COMMAND``; its texts are shown as they are written."""
    return argparse.ArgumentParser(
        prog=f"roller-sim {command}",
        usage=usage,
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def terse_parser(
    command: str, description: str, epilog: str, usage: str
) -> argparse.ArgumentParser:
    """Return such a parser for a command of many flags: it refuses in one line and takes no abbreviations."""
    return _TerseParser(
        prog=f"roller-sim {command}",
        usage=usage,
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )


class _TerseParser(argparse.ArgumentParser):
    """Refuses in one line."""

    def error(self, message: str) -> NoReturn:
        """Show what is wrong and leave."""
        self.exit(2, f"{self.prog}: error: {message}\n")
