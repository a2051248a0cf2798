"""Who wrote a tag: a recorded run again, and the bytes of the tag looked at after every program.

The first pass finds the cycles in which it changed and the program, LATCH or step that did it. The
second traces the Python programs in these cycles line by line.
"""

from __future__ import annotations

import sys
from collections import deque
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.errors import TagError
from plcsim.recorder.bag.values import text_of
from plcsim.recorder.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from types import FrameType

    from plcsim.core.task import Task, TaskClass
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
        location: "file:line" where the program is in Python, else "".
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
        self._line = ""
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
        """Look after every line of the project's Python."""
        self._line = ""

        def trace(frame: FrameType, _event: str, _value: Any) -> Any:
            self._look(task.name, self._line)
            file = frame.f_code.co_filename
            if file.startswith(self._folder):
                self._line = f"{file[len(self._folder) + 1 :]}:{frame.f_lineno}"
            return trace

        before = sys.gettrace()
        sys.settrace(trace)
        try:
            yield
        finally:
            sys.settrace(before)
            self._look(task.name, self._line)


def writers(
    make: Callable[[], Replay], path: str, folder: Path, task_class: int, cycle: int
) -> list[Written]:
    """Return who wrote a tag last, the latest write at the end.

    Args:
        make: makes the replay; the run is repeated twice.
        path: of the tag.
        folder: of the project.
        task_class: number of the class whose cycles are counted, 0 for the first one.
        cycle: up to and with this one, 0 for the end.

    Raises:
        RecordingError: there is no such tag, or the run cannot be repeated.
    """
    traced: frozenset[tuple[int, int]] = frozenset()
    found: list[Written] = []
    for _ in range(2):
        again = make()
        number = task_class or again.controller.classes[0].number
        why = Why(again, path, folder, traced)

        def is_there(each: TaskClass, number: int = number) -> bool:
            return bool(cycle) and each.number == number and each.cycles >= cycle

        difference = again.run(is_there)
        if difference is not None:
            raise RecordingError(f"the run cannot be repeated: it differs in {difference}")
        found = list(why.found)
        traced = frozenset((each.task_class, each.cycle) for each in found)
    return found
