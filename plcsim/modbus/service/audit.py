"""The audit log: one line of JSON for every write that the scan has applied.

Writes that were refused stand in a file of their own, so many for each host, so that nobody who may
not write can push out the lines of those who may.
"""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Self

from plcsim.access.line_file import LineFile

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.modbus.map.changes import TagChange
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
        self._applied: LineFile | None = None
        self._refused: LineFile | None = None
        if file:
            path = Path(file)
            refused = path.with_name(f"{path.stem}-refused{path.suffix}")
            self._applied = LineFile(path, largest, FILES, "modbus")
            self._refused = LineFile(refused, largest, FILES_OF_REFUSED, "modbus")
            self._applied.open()

    def applied(self, origin: Origin, changed: Sequence[TagChange]) -> None:
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


def _shown(change: TagChange) -> dict[str, Any]:
    """Return a change for JSON, which knows neither infinity nor NaN."""
    return {
        name: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in change._asdict().items()
    }
