"""The parser that commands begin with."""

from __future__ import annotations

import argparse


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
