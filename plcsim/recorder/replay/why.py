"""Who wrote a tag: a recorded run again, and the bytes of the tag looked at after every program.

The first pass finds the cycles in which it changed and the program, LATCH or step that did it. The
second looks in these cycles after every line of Python, and after every store of compiled code,
which tells of them there (`plcsim.machine.watch`).
"""

from __future__ import annotations

import sys
from collections import deque
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.errors import TagError
from plcsim.core.system_area import WATCH
from plcsim.program.compiled import CompiledPrograms
from plcsim.recorder.bag.values import text_of
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

    from plcsim.core.task import Task, TaskClass
    from plcsim.machine import Frame
    from plcsim.recorder.journal.record import JournalRecord
    from plcsim.recorder.replay.replay import Replay

MOST: Final = 5
"""Writes that are told."""

LATCH: Final = "LATCH"
OUTSIDE: Final = "INIT, or a write between two cycles"


class Written(NamedTuple):
    """A change of a tag.

    Attributes:
        task_class: number of the class in whose cycle.
        cycle: of that class.
        by: the program, `LATCH` for what came from outside, or `OUTSIDE`.
        value: after it.
        location: "file:line" of the program's source, "" for what is none.
    """

    task_class: int
    cycle: int
    by: str
    value: str
    location: str = ""

    def __str__(self) -> str:
        place = f", {self.location}" if self.location else ""
        return f"cycle {self.cycle} of task class {self.task_class}: {self.by}{place}: {self.value}"


class Why:
    """Watches a tag in a replay.

    Args:
        again: the replay, not begun.
        path: of the tag.
        folder: of the project; lines of its files are told.
        traced: cycles whose programs are traced, by class and number.

    Attributes:
        found: the latest changes, at most `MOST`.

    Raises:
        RecordingError: there is no such tag.
    """

    def __init__(
        self, again: Replay, path: str, folder: Path, traced: frozenset[tuple[int, int]]
    ) -> None:
        controller = again.controller
        try:
            self._tag = controller.tags.find(path)
        except TagError as err:
            raise RecordingError(str(err)) from None
        self._view = controller.memory.view(self._tag.address, self._tag.data_type.size)
        self._last = b""
        self._folder = str(folder.resolve())
        self._traced = traced
        self._line = self._program = ""
        self._context = controller.context
        self._cells = controller.memory.system.cells
        self.found: deque[Written] = deque(maxlen=MOST)
        self._in_cycle = controller.scan.in_cycle
        controller.image.inputs.insert(0, self._begun)
        controller.image.inputs.append(self._latched)
        again.after_cycle.append(self._ended)
        for task_class in controller.classes:
            for task in task_class.tasks:
                task.cyclic = self._watched(task, task.cyclic)

    @property
    def _class(self) -> tuple[int, int]:
        """The class that is in its cycle, and the number of that."""
        running = self._in_cycle[-1]
        return running.number, running.cycles

    def stored(self, frame: Frame) -> None:
        """Look after a store of compiled code; one of a library counts where that was called."""
        if bytes(self._view) != self._last and (location := self._location_of(frame)):
            self._look(self._program, location)

    def _location_of(self, frame: Frame) -> str:
        compiled = self._context.settings(CompiledPrograms)
        file, _, line = (compiled.location_of(frame) if compiled else "").rpartition(":")
        if not file:
            return ""
        path = Path(file).resolve()
        if path.is_relative_to(self._folder):
            file = str(path.relative_to(self._folder))
        return f"{file}:{line}"

    def _look(self, by: str, location: str = "") -> None:
        data = bytes(self._view)
        if data != self._last:
            self._last = data
            self.found.append(Written(*self._class, by, text_of(self._tag, data), location))

    def _begun(self, _task_class: TaskClass) -> None:
        self._look(OUTSIDE)

    def _latched(self, _task_class: TaskClass) -> None:
        self._look(LATCH)

    def _ended(self, _task_class: TaskClass, _record: JournalRecord) -> None:
        self._look("PUBLISH, a force")

    def _watched(self, task: Task, cyclic: Callable[[], None]) -> Callable[[], None]:
        def run() -> None:
            if self._class in self._traced:
                with self._traced_lines(task):
                    cyclic()
            else:
                cyclic()
            self._look(task.name)

        return run

    @contextmanager
    def _traced_lines(self, task: Task) -> Iterator[None]:
        """Look after every line of the project's Python and every store of compiled code."""
        self._line, self._program = "", task.name

        def trace(frame: FrameType, _event: str, _value: Any) -> Any:
            if self._line:  # otherwise it is compiled, and `stored` knows more
                self._look(task.name, self._line)
            file = frame.f_code.co_filename
            if file.startswith(self._folder):
                self._line = f"{file[len(self._folder) + 1 :]}:{frame.f_lineno}"
            return trace

        before = sys.gettrace()
        sys.settrace(trace)
        self._cells[WATCH] = 1
        try:
            yield
        finally:
            self._cells[WATCH] = 0
            sys.settrace(before)
            self._look(task.name, self._line)


def writers(
    make: Callable[[Callable[[Frame], None] | None], Replay],
    path: str,
    folder: Path,
    task_class: int,
    cycle: int,
) -> list[Written]:
    """Return who wrote a tag last, the latest write at the end.

    Args:
        make: makes the replay with somebody who is told of stores; the run is repeated twice.
        path: of the tag.
        folder: of the project.
        task_class: number of the class whose cycles are counted, 0 for the first one.
        cycle: up to and with this one, 0 for the end.

    Raises:
        RecordingError: there is no such tag, or the run cannot be repeated.
    """
    traced: frozenset[tuple[int, int]] = frozenset()
    found: list[Written] = []
    asked: list[Why] = []

    def watch(frame: Frame) -> None:
        asked[-1].stored(frame)

    for watcher in (None, watch):
        again = make(watcher)
        number = task_class or again.controller.classes[0].number
        why = Why(again, path, folder, traced)
        asked.append(why)

        def is_there(each: TaskClass, number: int = number) -> bool:
            return bool(cycle) and each.number == number and each.cycles >= cycle

        difference = again.run(is_there)
        if difference is not None:
            raise RecordingError(f"the run cannot be repeated: it differs in {difference}")
        found = list(why.found)
        traced = frozenset((each.task_class, each.cycle) for each in found)
    return found
