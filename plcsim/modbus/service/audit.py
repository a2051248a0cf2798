"""The audit log: one line of JSON for every write that was answered."""

from __future__ import annotations

import errno
import json
import os
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final, Self

if TYPE_CHECKING:
    from plcsim.modbus.service.connection import WriteRecord

LARGEST: Final = 10 * 1024 * 1024
"""Bytes of the file; then it is renamed to end in ``.1``, and a new one starts."""


class AuditLog:
    """The file; while it cannot be written, the service goes on and counts what is missing.

    Args:
        file: to append to, "" for no log.
        largest: bytes at which a new file starts.
    """

    def __init__(self, file: str, largest: int = LARGEST) -> None:
        self._file = Path(file) if file else None
        self._largest = largest
        self._fd = -1
        self._size = 0
        self._lost = 0
        self._is_told = False
        if self._file is not None:
            try:
                self._open(self._file)
            except OSError as err:
                self._say(err)

    def _open(self, file: Path) -> None:
        file.parent.mkdir(parents=True, exist_ok=True)
        flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC
        self._fd = os.open(file, flags, 0o640)
        self._size = os.fstat(self._fd).st_size

    def _say(self, err: OSError) -> None:
        """Print the fault, once until it is over."""
        if self._is_told:
            return
        self._is_told = True
        sys.stderr.write(f"modbus: the audit log cannot be written: {err}\n")

    def write(self, peer: str, role: str, record: WriteRecord) -> None:
        """Append a line: UTC time, peer, its role, unit, PDU as hexadecimal, exception code.

        After lines that could not be written, the next one has their number as ``lost``.
        """
        if self._file is None:
            return
        line = {
            "time": datetime.now(UTC).isoformat(timespec="microseconds"),
            "peer": peer,
            "role": role,
            "unit": record.unit,
            "function": record.pdu[0],
            "pdu": record.pdu.hex(),
            "exception": record.result,
        }
        if self._lost:
            line["lost"] = self._lost
        try:
            self._append(self._file, json.dumps(line).encode() + b"\n")
        except OSError as err:
            self.close()
            self._say(err)
            self._lost += 1
        else:
            self._lost, self._is_told = 0, False

    def _append(self, file: Path, data: bytes) -> None:
        """Write a line, whole or not at all."""
        if self._fd < 0:
            self._open(file)
        if self._size + len(data) > self._largest:
            file.replace(file.with_name(file.name + ".1"))
            self.close()
            self._open(file)
        if os.write(self._fd, data) < len(data):  # the disk was full in the middle of it
            os.ftruncate(self._fd, self._size)
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        self._size += len(data)

    def close(self) -> None:
        """Close the file."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
