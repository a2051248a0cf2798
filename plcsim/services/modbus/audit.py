"""The audit log: one line of JSON for every write that was answered."""

from __future__ import annotations

import json
import os
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Final, Self

if TYPE_CHECKING:
    from plcsim.services.modbus.connection import WriteRecord

LARGEST: Final = 10 * 1024 * 1024
"""Bytes of the file; then it is renamed to end in ``.1``, and a new one starts."""


class AuditLog:
    """The file; where it cannot be written, that is said once and the service goes on.

    Args:
        file: to append to, "" for no log.
        largest: bytes at which a new file starts.
    """

    def __init__(self, file: str, largest: int = LARGEST) -> None:
        self._file = Path(file) if file else None
        self._largest = largest
        self._fd = -1
        self._size = 0
        if self._file is not None:
            self._try_open(self._file)

    def _try_open(self, file: Path) -> None:
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            flags = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC
            self._fd = os.open(file, flags, 0o640)
            self._size = os.fstat(self._fd).st_size
        except OSError as err:
            self._give_up(err)

    def _give_up(self, err: OSError) -> None:
        self.close()
        self._file = None
        sys.stderr.write(f"modbus: the audit log cannot be written any more: {err}\n")

    def write(self, peer: str, role: str, record: WriteRecord) -> None:
        """Append a line: UTC time, peer, its role, unit, PDU as hexadecimal, exception code."""
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
        data = json.dumps(line).encode() + b"\n"
        try:
            if self._size + len(data) > self._largest:
                self._start_anew(self._file)
            self._size += os.write(self._fd, data)
        except OSError as err:
            self._give_up(err)

    def _start_anew(self, file: Path) -> None:
        file.replace(file.with_name(file.name + ".1"))
        self.close()
        self._try_open(file)

    def close(self) -> None:
        """Close the file."""
        if self._fd >= 0:
            os.close(self._fd)
            self._fd = -1

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
