"""The tape: makes a record of every cycle of a controller and hands it on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.control import Step
from plcsim.core.system import State
from plcsim.core.task import HIGHEST_CLASS
from plcsim.recorder.journal.record import CYCLE, LIMITS
from plcsim.shared_image.force_list import encode_forces

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass, Violation
    from plcsim.recorder.journal.journal import Journal

MOST_VARIABLES: Final = 256 * 1024
"""Bytes; a record of a project with more has no variables."""


class Tape:
    """Hooks into a controller before its boot.

    Args:
        controller: that is recorded; its clock and network write into the journal.
        journal: what they write into.
        write: takes the time and the bytes of each record (`record_of`).
    """

    def __init__(
        self, controller: Controller, journal: Journal, write: Callable[[int, bytes], None]
    ) -> None:
        self._controller = controller
        self._journal = journal
        self._write = write
        self._scan = controller.scan
        self._violations = [0] * (HIGHEST_CLASS + 1)  # by number: to add up causes takes longer
        memory = controller.memory
        self._views = [memory.view(a.address, a.data_type.size) for a in controller.areas]
        if sum(map(len, self._views)) > MOST_VARIABLES:
            self._views = []
        controller.image.inputs.insert(0, self._latch)
        controller.image.watchers.insert(0, self._publish)  # as in a replay, whoever else is there
        controller.image.followers.append(journal.wrote)
        controller.forces.follow(self._forced)
        controller.follow_steps(self._stepped)
        controller.follow_endings(journal.asked_to_end)
        controller.follow_violations(self._violated)
        traffic = controller.context.traffic
        journal.topics = traffic.topics
        traffic.followers.append(journal.messages.append)
        traffic.hand_in_followers.append(journal.handed_in)

    def _latch(self, _task_class: TaskClass) -> None:
        self._journal.latched()

    def _forced(self) -> None:
        self._journal.wrote(0, encode_forces(list(self._controller.forces)))

    def _violated(self, violation: Violation) -> None:
        self._violations[violation.task_class] += 1

    def _publish(self, task_class: TaskClass) -> None:
        time_ns, views = self._controller.context.release_ns, self._views
        number, cycles = task_class.number, task_class.cycles
        timing = self._timing(task_class, cycles - 1, is_service=self._scan.halted)
        self._write(time_ns, self._journal.take(CYCLE, number, cycles, time_ns, views, (timing,)))

    def _timing(self, task_class: TaskClass, executed: int, *, is_service: bool) -> tuple[int, ...]:
        """Return a `plcsim.recorder.journal.record.ClassTiming` as marshal takes it."""
        number = task_class.number
        return (
            number,
            task_class.cycles,
            executed,
            task_class.missed,
            self._violations[number],
            task_class.lateness.last_ns,
            task_class.execution.last_ns,
            is_service,
        )

    def _timings(self) -> list[tuple[int, ...]]:
        """Return the timing of all classes that have run."""
        is_service = self._controller.state is State.SERVICE
        ran = [each for each in self._controller.classes if each.cycles]
        return [self._timing(each, each.cycles, is_service=is_service) for each in ran]

    def _stepped(self, step: Step, until_ns: int, cycles: int) -> None:
        time_ns = self._controller.clock.stamp_ns()
        given = b""
        if step is Step.RUN:
            given = LIMITS.pack(until_ns, cycles)
        elif step is Step.BOOT:
            given = self._controller.retained.to_bytes()
        timings = self._timings() if step in (Step.BOOT, Step.CLOSE) else ()
        self._write(time_ns, self._journal.take(step.value, 0, 0, time_ns, (given,), timings))
