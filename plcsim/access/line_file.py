"""A file of lines, such as an audit log: appended to, and renamed when it is full."""

from __future__ import annotations

import errno
import json
import os
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pathlib import Path


class LineFile:
    """A file of lines of JSON; while it cannot be written, those that are missing are counted.

    Args:
        file: to append to; a full one is renamed to end in ``.1``, that one in ``.2``, and so on.
        largest: bytes of a file.
        files: kept, this one included.
        owner: the table of plc.toml, named where a fault is printed.
    """

    def __init__(self, file: Path, largest: int, files: int, owner: str) -> None:
        self._file = file
        self._largest = largest
        self._files = files
        self._owner = owner
        self._fd = -1
        self._size = 0
        self._lost = 0
        self._is_told = False

    def open(self) -> None:
        """Make the file; a fault is printed."""
        try:
            self._open()
        except OSError as err:
            self._say(err)

    def _open(self) -> None:
        self._file.parent.mkdir(parents=True, exist_ok=True)
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC
        self._fd = os.open(self._file, flags, 0o640)
        self._size = os.fstat(self._fd).st_size

    def _say(self, err: OSError) -> None:
        """Print the fault, once until it is over."""
        if self._is_told:
            return
        self._is_told = True
        sys.stderr.write(f"{self._owner}: the audit log cannot be written: {err}\n")

    def write(self, values: dict[str, Any]) -> None:
        """Append a line; after some that could not be written, it has their number as ``lost``."""
        if self._lost:
            values["lost"] = self._lost
        try:
            self._append(json.dumps(values, ensure_ascii=False).encode() + b"\n")
        except OSError as err:
            self.close()
            self._say(err)
            self._lost += 1
        else:
            self._lost, self._is_told = 0, False

    def _append(self, data: bytes) -> None:
        """Write a line, whole or not at all."""
        if self._fd < 0:
            self._open()
        if self._size and self._size + len(data) > self._largest:
            self._shift()
            self.close()
            self._open()
        if os.write(self._fd, data) < len(data):  # the disk was full in the middle of it
            os.ftruncate(self._fd, self._size)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        self._size += len(data)

    def _shift(self) -> None:
        """Give each file the name of the next older one."""
        name = self._file.name
        for number in range(self._files - 1, 0, -1):
            newer = self._file.with_name(f"{name}.{number - 1}") if number > 1 else self._file
            if newer.exists():
                newer.replace(self._file.with_name(f"{name}.{number}"))

    def close(self) -> None:
        """Close the file."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1
