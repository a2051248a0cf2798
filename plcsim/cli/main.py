"""``plcsim``: one command with a sub-command for each act.

Exit codes: 0 done, 1 configuration error, 2 wrong usage, 3 the controller ended in SERVICE, 130
ended by Ctrl-C (`plcsim run` stops and gives 0).
"""

from __future__ import annotations

import sys

INTERRUPTED = 130
"""What shells give a command that Ctrl-C ended."""


def main(arguments: list[str] | None = None) -> int:
    """Run ``plcsim`` with ``arguments``, by default those of the process."""
    try:
        # Imported here, so that Ctrl-C while the modules are being loaded shows no traceback.
        from plcsim.cli.command import run_command  # noqa: PLC0415

        return run_command(arguments)
    except KeyboardInterrupt:
        return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
