"""What the exit codes of ``plcsim`` mean; README.md lists them."""

from __future__ import annotations

from enum import IntEnum


class ExitCode(IntEnum):
    """How a command ended."""

    DONE = 0
    FAILED = 1
    WRONG_USAGE = 2
    SERVICE = 3
    DIFFERENT = 4
    INTERRUPTED = 130


MEANINGS = {
    ExitCode.DONE: "done",
    ExitCode.FAILED: "a project, a file or the host is wrong",
    ExitCode.WRONG_USAGE: "wrong usage",
    ExitCode.SERVICE: "the controller ended in SERVICE",
    ExitCode.DIFFERENT: "a comparison found a difference",
    ExitCode.INTERRUPTED: "ended by Ctrl-C",
}
"""Of all commands; one that uses a code for something else says so in its help."""


def epilog(**meanings: str) -> str:
    """Return the line about exit codes at the end of a command's help.

    Args:
        meanings: of the codes that the command gives, by their names in `ExitCode`; "" for what the
            code always means.
    """
    codes = {ExitCode[name]: text for name, text in meanings.items()}
    told = ", ".join(
        f"{code.value} {text or MEANINGS[code]}" for code, text in sorted(codes.items())
    )
    return f"Exit codes: {told}."
