"""What the processes of a test were doing when it failed: so that one failure in CI is enough."""

import gc
import os
import subprocess
from contextlib import suppress
from pathlib import Path

MOST_CHARACTERS = 20_000
"""Of one stream."""


def told_by(error: BaseException | None) -> str:
    """Return what a process wrote that an error is about."""
    streams = ((name, getattr(error, name, None)) for name in ("stdout", "stderr"))
    return "".join(f"-- its {name}:\n{_text(data)}\n" for name, data in streams if data)


def _text(data: str | bytes) -> str:
    text = data if isinstance(data, str) else data.decode("utf-8", "replace")
    return text[-MOST_CHARACTERS:]


def processes() -> str:
    """Return the processes below this one, and what those that it started have left in its pipes.

    What is read here nobody else gets any more.
    """
    tree = "".join(_lines(os.getpid(), 0))
    return f"{tree}{''.join(map(_left, _started()))}"


def _lines(pid: int, depth: int) -> list[str]:
    """Return a line for each process below one: its state, where it waits, and its command."""
    lines = []
    for child in _children(pid):
        with suppress(OSError):
            folder = Path(f"/proc/{child}")
            state = folder.joinpath("stat").read_text().rpartition(")")[2].split()[0]
            waits = folder.joinpath("wchan").read_text()
            command = folder.joinpath("cmdline").read_text().replace("\0", " ")
            lines.append(f"{'  ' * depth}{child} {state} {waits} {command[:300]}\n")
        lines += _lines(child, depth + 1)
    return lines


def _children(pid: int) -> list[int]:
    found: list[int] = []
    for file in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(OSError):
            found += map(int, file.read_text().split())
    return found


def _started() -> list[subprocess.Popen[str] | subprocess.Popen[bytes]]:
    """Return the processes of tests that still have a pipe to here."""
    kinds = [each for each in gc.get_objects() if type(each) is subprocess.Popen]
    return [each for each in kinds if each.stdout or each.stderr]


def _left(process: subprocess.Popen[str] | subprocess.Popen[bytes]) -> str:
    head = f"-- {process.pid}, exit code {process.poll()}, {process.args!s:.300}\n"
    text = ""
    for name in ("stdout", "stderr"):
        stream = getattr(process, name)
        if stream is not None and not stream.closed and (left := _read(stream.fileno())):
            text += f"-- its {name}:\n{_text(left)}\n"
    return f"{head}{text}" if text else ""


def _read(fd: int) -> bytes:
    """Return what is in a pipe, without waiting for more."""
    blocks, pieces = os.get_blocking(fd), []
    os.set_blocking(fd, False)
    with suppress(OSError):
        while piece := os.read(fd, 65536):
            pieces.append(piece)
    os.set_blocking(fd, blocks)
    return b"".join(pieces)
