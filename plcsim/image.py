"""The process image: values come in only in LATCH and go out only in PUBLISH.

This is the image inside one process. Commands (writes of tags) wait in a bounded queue and are
drained in LATCH; watchers see the tags in PUBLISH.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from plcsim.scan import Phase

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.scan import Scan
    from plcsim.tag import Tag, TagTable
    from plcsim.task import TaskClass

QUEUE_LENGTH = 1024
"""Commands that may wait; one more is refused."""

DRAINED_PER_CYCLE = 64
"""Commands applied in one LATCH at most, so that a flood of them cannot stretch a cycle."""


class ProcessImage:
    """Commands in, observations out, at the right moments of the scan.

    Attributes:
        inputs: called in LATCH with the task class; here a plant model sets inputs.
        watchers: called in PUBLISH with the task class; here a recorder reads tags.
        refused: commands that found the queue full.
    """

    def __init__(self, tags: TagTable) -> None:
        self.inputs: list[Callable[[TaskClass], None]] = []
        self.watchers: list[Callable[[TaskClass], None]] = []
        self.refused = 0
        self._tags = tags
        self._commands: deque[tuple[Tag, bytes]] = deque()
        self._scan: Scan | None = None

    def attach(self, scan: Scan) -> None:
        """Tell the image whose phases it must keep to."""
        self._scan = scan

    def _require(self, phase: Phase) -> None:
        if self._scan is not None:
            self._scan.require(phase)

    def command(self, path: str, value: object) -> bool:
        """Ask for a tag to be written in a LATCH; return False where the queue is full.

        It is the next one, in the order of the commands, that is not in the middle of a cycle of
        the tag's own class: inputs stand still in RUN.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        tag = self._tags.find(path)
        data = self._tags.encode(tag, value)
        if len(self._commands) >= QUEUE_LENGTH:
            self.refused += 1
            return False
        self._commands.append((tag, data))
        return True

    def latch(self, task_class: TaskClass) -> None:
        """Apply waiting commands, at most `DRAINED_PER_CYCLE`, then let the inputs be set.

        Raises:
            PhaseError: the scan is not in LATCH.
        """
        self._require(Phase.LATCH)
        for _ in range(min(len(self._commands), DRAINED_PER_CYCLE)):
            if self._is_in_cycle(self._commands[0][0]):
                break
            self._tags.store(*self._commands.popleft())
        for bring_in in self.inputs:
            bring_in(task_class)

    def _is_in_cycle(self, tag: Tag) -> bool:
        """Return whether the tag belongs to a class that is preempted in the middle of a cycle."""
        preempted = self._scan.in_cycle[:-1] if self._scan is not None else ()
        owner = tag.path.partition(".")[0].upper()
        return any(task.name.upper() == owner for c in preempted for task in c.tasks)

    def publish(self, task_class: TaskClass) -> None:
        """Let the watchers see the tags.

        Raises:
            PhaseError: the scan is not in PUBLISH.
        """
        self._require(Phase.PUBLISH)
        for watch in self.watchers:
            watch(task_class)
