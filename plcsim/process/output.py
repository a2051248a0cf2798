"""What the processes of a run print, on its way to the parent's stdout and stderr.

The scan process and the services print into pipes; the parent empties them while it watches, and
hands everything to a `Sink`: a thread that writes to stdout or stderr, or the live table of a
terminal, above which it stands. So nobody who reads slowly, or not at all, holds up the scan or the
watchdog: what a sink has no room for is lost, counted and told. On the virtual clock there is time
to wait: the pipes are left full, and the scan waits in ``print``.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import threading
from collections import deque
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

ROOM = 1 << 20
"""Bytes that wait for a reader at most; a pipe is as large where the system allows it."""

LONGEST_LINE = 8_192
"""Bytes of a line that are held back until its end comes, where lines are kept whole."""

PATIENCE_S = 2.0
"""At the end a reader who takes nothing is waited for so long."""

PIECE = 4_096
"""Bytes written at once: a longer write to a pipe may be half done while it waits."""

RETRY_S = 0.01
"""Between attempts to write to a stdout that was handed to us as non-blocking."""


class Sink(Protocol):
    """Takes what is printed; never waits.

    Attributes:
        whole_lines: it is given whole lines only.
    """

    whole_lines: bool

    @property
    def room(self) -> int:
        """Bytes that it takes now."""

    def put(self, data: bytes) -> None:
        """Take bytes, at most ``room``."""

    def flush(self, patient: Callable[[], bool]) -> int:
        """Wait until everything has been taken.

        Args:
            patient: says whether to go on waiting where nothing has been taken for `PATIENCE_S`.

        Returns:
            bytes that could not be handed on, now and before.
        """


class StreamSink:
    """A stream that a thread writes to, as bytes come.

    Args:
        fd: stdout or stderr.
    """

    whole_lines = False

    def __init__(self, fd: int) -> None:
        self._fd = fd
        self._waiting: deque[bytes] = deque()
        self._size = 0
        self._lost = 0
        self._has_gone = False
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None

    @property
    def room(self) -> int:
        """Bytes that it takes now."""
        return ROOM - self._size

    def put(self, data: bytes) -> None:
        """Take bytes."""
        with self._changed:
            self._waiting.append(data)
            self._size += len(data)
            self._changed.notify_all()
        if self._thread is None:
            self._thread = threading.Thread(target=self._write_all, daemon=True)
            self._thread.start()

    def flush(self, patient: Callable[[], bool]) -> int:
        """Wait until everything has been written; see `Sink`."""
        with self._changed:
            before = -1
            while self._size and (self._size != before or patient()):
                before = self._size
                self._changed.wait(PATIENCE_S)
            return self._lost + self._size

    def _write_all(self) -> None:
        while True:
            with self._changed:
                while not self._waiting:
                    self._changed.wait()
                data = self._waiting[0]
            self._write(data)
            with self._changed:
                self._waiting.popleft()

    def _write(self, data: bytes) -> None:
        view = memoryview(data)
        while view:
            written = self._attempt(view[:PIECE])
            view = view[written:]
            with self._changed:
                self._size -= written
                self._changed.notify_all()

    def _attempt(self, piece: memoryview) -> int:
        """Return how many bytes are done with: written, lost, or wanted by nobody any more."""
        if self._has_gone:
            return len(piece)
        try:
            return os.write(self._fd, piece)
        except BlockingIOError:
            threading.Event().wait(RETRY_S)
            return 0
        except BrokenPipeError:  # the reader has seen enough, as `head` has
            self._has_gone = True
        except OSError:  # a disk is full, a terminal has gone
            self._lost += len(piece)
        return len(piece)


class _Pipe:
    """One stream of a child: it writes at one end, the parent reads at the other."""

    def __init__(self) -> None:
        self.read_fd, self.write_fd = os.pipe2(os.O_CLOEXEC)
        os.set_blocking(self.read_fd, False)
        with contextlib.suppress(OSError):  # a limit of the system for ordinary users
            fcntl.fcntl(self.write_fd, fcntl.F_SETPIPE_SZ, ROOM)
        self._begun = b""

    def chunks(self, most: int, *, whole_lines: bool) -> Iterator[bytes]:
        """Iterate over what was printed, until there is nothing more or ``most`` bytes came."""
        while most > 0:
            try:
                data = os.read(self.read_fd, most)
            except BlockingIOError:
                return
            most -= len(data)
            yield self._lines(data) if whole_lines else data

    def _lines(self, data: bytes) -> bytes:
        """Return the lines that are whole by now; the rest is kept."""
        lines, end, rest = (self._begun + data).rpartition(b"\n")
        self._begun = rest if len(rest) <= LONGEST_LINE else b""
        return lines + end + (b"" if self._begun else rest and rest + b"\n")

    def rest(self) -> bytes:
        """Return the line that was never ended, with an end."""
        rest, self._begun = self._begun, b""
        return rest and rest + b"\n"

    def close(self) -> None:
        os.close(self.read_fd)
        os.close(self.write_fd)


class ChildOutput:
    """stdout and stderr of one child, or of those that are started one after another.

    Attributes:
        fds: for its stdout and its stderr.
    """

    def __init__(self) -> None:
        self._pipes = _Pipe(), _Pipe()
        self.fds = self._pipes[0].write_fd, self._pipes[1].write_fd

    def __iter__(self) -> Iterator[_Pipe]:
        return iter(self._pipes)


class Output:
    """Carries what children print to the sinks.

    Args:
        stdout: takes what they print to stdout.
        stderr: takes what they print to stderr.
        patient: a child waits where a sink has no room; nothing is lost.

    Attributes:
        lost: bytes for which a sink had no room.
        waits_for_reader: a child may be waiting in ``print`` for somebody to read.
    """

    def __init__(
        self, stdout: Sink | None = None, stderr: Sink | None = None, *, patient: bool = False
    ) -> None:
        self._sinks = stdout or StreamSink(1), stderr or StreamSink(2)
        self._patient = patient
        self._children: list[ChildOutput] = []
        self.lost = 0
        self.waits_for_reader = False

    def child(self) -> ChildOutput:
        """Return the streams of one more child."""
        child = ChildOutput()
        self._children.append(child)
        return child

    def carry(self) -> None:
        """Hand on what the children have printed; waits for nobody."""
        self.waits_for_reader = False
        for child in self._children:
            for pipe, sink in zip(child, self._sinks, strict=True):
                self._carry(pipe, sink)

    def _carry(self, pipe: _Pipe, sink: Sink) -> None:
        left = sink.room if self._patient else ROOM
        for data in pipe.chunks(left, whole_lines=sink.whole_lines):
            left -= len(data)
            self._put(sink, data)
        self.waits_for_reader |= self._patient and left <= 0

    def _put(self, sink: Sink, data: bytes) -> None:
        taken = data[: max(0, sink.room)]
        self.lost += len(data) - len(taken)
        if taken:
            sink.put(taken)

    def say(self, line: str) -> None:
        """Print a line of the parent's own to stderr, among what the children print there."""
        self._put(self._sinks[1], f"{line}\n".encode("utf-8", "backslashreplace"))

    def flush(self, patient: Callable[[], bool] = lambda: False) -> int:
        """Hand everything on that was printed so far, and wait for those who read it.

        Args:
            patient: see `Sink.flush`.

        Returns:
            bytes lost since the beginning.
        """
        self.carry()
        while self.waits_for_reader and patient():
            self._flush_sinks(patient)
            self.carry()
        for child in self._children:
            for pipe, sink in zip(child, self._sinks, strict=True):
                self._put(sink, pipe.rest())
        return self.lost + self._flush_sinks(patient)

    def _flush_sinks(self, patient: Callable[[], bool]) -> int:
        return sum(sink.flush(patient) for sink in set(self._sinks))

    def close(self) -> None:
        """Give the pipes back."""
        for child in self._children:
            for pipe in child:
                pipe.close()
        self._children.clear()
