"""Timing of the task classes as diagnostic_msgs/DiagnosticArray, about once a second each."""

from __future__ import annotations

import struct
from enum import IntEnum
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.duration import format_duration
from plcsim.recorder.bag.types import text_message
from plcsim.recorder.journal.record import CYCLE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import ClassTiming, JournalRecord

PERIOD_NS: Final = 1_000_000_000
"""Of the controller's time, from one message of a class to the next."""

_U32: Final = struct.Struct("<I")
_HEADER: Final = struct.Struct("<IIII")
"""std_msgs/Header: number, seconds, nanoseconds, length of an empty frame."""

_PERCENTILES: Final = (("p50", 50), ("p99", 99), ("max", 100))


class DiagnosticLevel(IntEnum):
    """Levels of diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2


class DiagnosticStatus(NamedTuple):
    """A diagnostic_msgs/DiagnosticStatus."""

    level: DiagnosticLevel
    name: str
    message: str
    hardware_id: str
    values: Sequence[tuple[str, str]]

    def to_bytes(self) -> bytes:
        """Return the status as ROS 1 writes it."""
        texts = [self.name, self.message, self.hardware_id]
        pairs = [text for pair in self.values for text in pair]
        return b"".join(
            (
                bytes([self.level]),
                *map(text_message, texts),
                _U32.pack(len(self.values)),
                *map(text_message, pairs),
            )
        )


class ClassDiagnostics:
    """What is told of one task class.

    Args:
        cycle_ns: its cycle time.
        project: name of the project.
        first: the first that is known of its timing; what was before it is told by nobody.
        time_ns: of that, on the controller's clock.
    """

    def __init__(self, cycle_ns: int, project: str, first: ClassTiming, time_ns: int) -> None:
        self._cycle = format_duration(cycle_ns)
        self._project = project
        self._told = self._latest = first
        self._cycles = first.cycles - 1
        self._executed = first.executed - 1 if first.executed else 0
        self._lateness_ns: list[int] = []
        self._execution_ns: list[int] = []
        self.due_ns = time_ns + PERIOD_NS

    def take(self, timing: ClassTiming) -> None:
        """Take what has come."""
        self._latest = timing
        if timing.cycles > self._cycles:
            self._cycles = timing.cycles
            self._lateness_ns.append(timing.lateness_ns)
        if timing.executed > self._executed:
            self._executed = timing.executed
            self._execution_ns.append(timing.execution_ns)

    def tell(self, time_ns: int) -> DiagnosticStatus:
        """Return the status since the last one, and begin the next."""
        timing = self._latest
        level, message = self._judge()
        values = [
            ("cycles", str(timing.cycles)),
            ("missed grid points", str(timing.missed)),
            ("cycle time violations", str(timing.violations)),
            *_figures("execution", self._execution_ns),
            *_figures("lateness", self._lateness_ns),
        ]
        self._told = timing
        self._lateness_ns.clear()
        self._execution_ns.clear()
        self.due_ns = time_ns + PERIOD_NS
        name = f"task class #{timing.task_class}"
        return DiagnosticStatus(level, name, message, self._project, values)

    def _judge(self) -> tuple[DiagnosticLevel, str]:
        timing, told = self._latest, self._told
        message = f"{self._cycle}, {_counted(timing.cycles, 'cycle')}"
        violations, missed = timing.violations - told.violations, timing.missed - told.missed
        since = [(violations, "cycle time violation"), (missed, "missed grid point")]
        new = ", ".join(_counted(count, what) for count, what in since if count)
        if new:
            message = f"{message}; since the last message {new}"
        if timing.is_service:
            return DiagnosticLevel.ERROR, f"controller in SERVICE; {message}"
        return DiagnosticLevel.WARN if new else DiagnosticLevel.OK, message


class TimingDiagnostics:
    """Makes messages of the timing in records.

    Args:
        head: what is recorded.
    """

    def __init__(self, head: Head) -> None:
        self._project = head.project
        self._cycles_ns = dict(head.classes)
        self._classes: dict[int, ClassDiagnostics] = {}
        self._number = 0

    def message(self, record: JournalRecord, bag_ns: int) -> bytes:
        """Return the message that is due, b"" where none is.

        Args:
            record: the next one.
            bag_ns: its time in the bag.
        """
        due = []
        for timing in record.timings:
            found = self._class_of(timing, record.time_ns)
            found.take(timing)
            if timing.is_service or record.step != CYCLE or record.time_ns >= found.due_ns:
                due.append(found.tell(record.time_ns))
        return self._array(due, bag_ns) if due else b""

    def _class_of(self, timing: ClassTiming, time_ns: int) -> ClassDiagnostics:
        number = timing.task_class
        if number not in self._classes:
            cycle_ns = self._cycles_ns[number]
            self._classes[number] = ClassDiagnostics(cycle_ns, self._project, timing, time_ns)
        return self._classes[number]

    def _array(self, statuses: Sequence[DiagnosticStatus], bag_ns: int) -> bytes:
        """Return a diagnostic_msgs/DiagnosticArray as ROS 1 writes it."""
        header = _HEADER.pack(self._number & 0xFFFF_FFFF, *divmod(bag_ns, 1_000_000_000), 0)
        self._number += 1
        return b"".join((header, _U32.pack(len(statuses)), *(s.to_bytes() for s in statuses)))


def _counted(count: int, what: str) -> str:
    return f"{count:,} {what}" if count == 1 else f"{count:,} {what}s"


def _figures(what: str, durations_ns: Sequence[int]) -> list[tuple[str, str]]:
    """Return percentiles in microseconds; nothing where nothing was measured."""
    if not durations_ns:
        return []
    ordered = sorted(durations_ns)
    return [
        (f"{what} {name} (us)", f"{ordered[_rank(len(ordered), percent)] / 1000:.3f}")
        for name, percent in _PERCENTILES
    ]


def _rank(count: int, percent: int) -> int:
    """Return the place of the value that ``percent`` of all do not exceed (nearest rank)."""
    return -(-count * percent // 100) - 1
