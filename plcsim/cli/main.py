"""``plcsim``: one command with a sub-command for each act.

Exit codes: 0 done, 1 configuration error, 2 wrong usage, 3 the controller ended in SERVICE, 130
ended by Ctrl-C (`plcsim run` stops and gives 0).
"""

from __future__ import annotations

import argparse
import sys
from importlib.metadata import entry_points, version

from plcsim.cli import check, doctor, new, report, run, tags, types, watch
from plcsim.errors import PlcError
from st_types.errors import TypeSystemError

INTERRUPTED = 130
"""What shells give a command that Ctrl-C ended."""

COMMANDS = "plcsim.commands"
"""Entry point group: packages above plcsim bring commands of their own."""


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands, those of other packages included."""
    parser = argparse.ArgumentParser(
        prog="plcsim",
        description="Runs PLC programs on Linux the way a B&R controller runs them.",
        epilog="Exit codes: 0 done, 1 configuration error, 2 wrong usage, 3 ended in SERVICE.",
    )
    parser.add_argument("--version", action="version", version=f"plcsim {version('plcsim')}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in (run, check, doctor, new, report, tags, watch, types):
        command.register(subparsers)
    for entry in sorted(entry_points(group=COMMANDS), key=lambda e: e.name):
        try:
            entry.load()(subparsers)
        except ImportError as err:  # a package that is half installed costs its own command only
            print(f"plcsim: the command {entry.name} is not there: {err}", file=sys.stderr)
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Run ``plcsim`` with ``arguments``, by default those of the process."""
    options = build_parser().parse_args(arguments)
    try:
        code: int = options.func(options)
    except (PlcError, TypeSystemError) as err:
        print(f"plcsim: {err}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        sys.stderr.close()
        return 0
    except KeyboardInterrupt:
        return INTERRUPTED
    return code


if __name__ == "__main__":
    sys.exit(main())
