"""What the stack that ``faulthandler`` wrote tells: where in a project a process was stuck.

``python -I -S stack_reader.py`` is a process beside one that may have to be ended
(`plcsim.host.last_resort`). On its standard input come orders, each a line of JSON,
``[folder, text]``, and perhaps a stack after the last; then it prints "plcsim: FILE:LINE: text".
"""

from __future__ import annotations

import json
import os
import re
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

_FRAME = re.compile(r'  File "(.+)", line (\d+)')
_STACK = "Timeout ("


def location_in(stack: Iterable[str], folder: str) -> str:
    """Return "file:line" of the innermost frame whose file lies in a folder, "" where none does.

    Args:
        stack: lines of ``faulthandler``, the most recent call first; it escapes what is not ASCII.
        folder: the whole path.
    """
    prefix = f"{folder}{os.sep}"
    written = "".join(map(_escaped, prefix))
    for line in stack:
        frame = _FRAME.match(line)
        if frame and frame[1].startswith(written):
            return f"{prefix}{frame[1].removeprefix(written)}:{frame[2]}"
    return ""


def _escaped(character: str) -> str:
    """Return a character of a path as ``faulthandler`` writes it."""
    if " " <= character < "\x7f":
        return character
    code = ord(character)
    return f"\\x{code:02x}" if code < 1 << 8 else ascii(character)[1:-1]


def message(lines: Iterable[str]) -> str:
    """Return what is to be told at the end of the orders, "" where the process ended by itself."""
    lines = iter(lines)
    order = ""
    for line in lines:
        if line.startswith(_STACK):
            folder, text = json.loads(order)
            return f"plcsim: {location_in(lines, folder) or folder}: {text}"
        order = line
    return ""


def main() -> None:
    """Read until the process beside is stuck in a project, or has ended."""
    text = message(sys.stdin)
    if text:
        sys.stderr.write(f"{text}\n")


if __name__ == "__main__":
    main()
