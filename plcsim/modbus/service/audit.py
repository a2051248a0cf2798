"""The audit log: one line of JSON for every write that the scan has applied.

Writes that were refused stand in a file of their own, so many for each host, so that nobody who may
not write can push out the lines of those who may.
"""

from __future__ import annotations

import errno
import json
import math
import os
import sys
import time
from collections import OrderedDict
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Self

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.modbus.map.changes import Change
    from plcsim.modbus.service.device import Origin

LARGEST: Final = 10 * 1024 * 1024
"""Bytes of a file; then it is renamed to end in ``.1``, that one in ``.2``, and so on."""

FILES: Final = 10
"""Of applied writes: the file and nine older ones."""

FILES_OF_REFUSED: Final = 2

BURST: Final = 50
"""Refused writes of one host that are noted at once."""

PAUSE_NS: Final = 1_000_000_000
"""Then one line of it for so much time; the others are counted."""

HOSTS: Final = 1000
"""Hosts whose lines are counted; beyond, the one that was quiet for longest is forgotten."""


class _Lines:
    """A file of lines; while it cannot be written, those that are missing are counted."""

    def __init__(self, file: Path, largest: int, files: int) -> None:
        self._file = file
        self._largest = largest
        self._files = files
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
        sys.stderr.write(f"modbus: the audit log cannot be written: {err}\n")

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


class _Allowance:
    """How many refused writes of a host are noted yet."""

    def __init__(self, now_ns: int) -> None:
        self.left = float(BURST)
        self.since_ns = now_ns
        self.held_back = 0


class AuditLog:
    """`plcsim.modbus.service.device.Audit` in files.

    Args:
        file: to append to, "" for no log; refused writes go to its name with ``-refused``.
        largest: bytes at which a new file starts.
        now_ns: a clock that does not jump.
    """

    def __init__(
        self,
        file: str,
        largest: int = LARGEST,
        now_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self._now_ns = now_ns
        self._hosts: OrderedDict[str, _Allowance] = OrderedDict()
        self._applied: _Lines | None = None
        self._refused: _Lines | None = None
        if file:
            path = Path(file)
            refused = path.with_name(f"{path.stem}-refused{path.suffix}")
            self._applied = _Lines(path, largest, FILES)
            self._refused = _Lines(refused, largest, FILES_OF_REFUSED)
            self._applied.open()

    def applied(self, origin: Origin, changed: Sequence[Change]) -> None:
        """Note a write: UTC time, peer, role, unit, function, and what it changed.

        Tags that had the value already are counted as ``unchanged``.
        """
        if self._applied is None:
            return
        tags = [_shown(change) for change in changed if change.value != change.before]
        line = {**_head(origin), "tags": tags}
        if len(tags) < len(changed):
            line["unchanged"] = len(changed) - len(tags)
        self._applied.write(line)

    def refused(self, origin: Origin, pdu: bytes, exception: int) -> None:
        """Note a refused write: as above, the PDU as hexadecimal, the exception code.

        Of a host that is refused much, the lines that are left out are counted as ``held_back``.
        """
        if self._refused is None:
            return
        allowance = self._allowance(origin.peer.rpartition(":")[0])
        if allowance.left < 1:
            allowance.held_back += 1
            return
        allowance.left -= 1
        line = {**_head(origin), "pdu": pdu.hex(), "exception": exception}
        if allowance.held_back:
            line["held_back"], allowance.held_back = allowance.held_back, 0
        self._refused.write(line)

    def _allowance(self, host: str) -> _Allowance:
        now_ns = self._now_ns()
        allowance = self._hosts.pop(host, None) or _Allowance(now_ns)
        self._hosts[host] = allowance
        if len(self._hosts) > HOSTS:
            self._hosts.popitem(last=False)
        passed_ns = now_ns - allowance.since_ns
        allowance.left = min(float(BURST), allowance.left + passed_ns / PAUSE_NS)
        allowance.since_ns = now_ns
        return allowance

    def close(self) -> None:
        """Close the files."""
        for lines in (self._applied, self._refused):
            if lines is not None:
                lines.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _head(origin: Origin) -> dict[str, Any]:
    time_text = datetime.now(UTC).isoformat(timespec="microseconds")
    return {"time": time_text, **origin._asdict()}


def _shown(change: Change) -> dict[str, Any]:
    """Return a change for JSON, which knows neither infinity nor NaN."""
    return {
        name: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in change._asdict().items()
    }
