"""``plcsim``: one command with a sub-command for each act; for exit codes see `exit_codes`."""

from __future__ import annotations

import os
import sys

from plcsim.cli.exit_codes import ExitCode


def main(arguments: list[str] | None = None) -> int:
    """Run ``plcsim`` with ``arguments``, by default those of the process."""
    _open_standard_streams()
    try:
        # Imported here, so that Ctrl-C while the modules are being loaded shows no traceback.
        from plcsim.cli.command import run_command  # noqa: PLC0415

        return run_command(arguments)
    except KeyboardInterrupt:
        return ExitCode.INTERRUPTED


def _open_standard_streams() -> None:
    """Put /dev/null where a descriptor of 0 to 2 was closed, as ``>&-`` in a shell does.

    The next file that is opened would get its number, and what is printed would be written to it.
    """
    while (fd := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(fd)
    sys.stdin = sys.stdin or open(0, closefd=False)  # noqa: SIM115  # is open until the end
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115  # likewise
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115  # likewise


if __name__ == "__main__":
    sys.exit(main())
