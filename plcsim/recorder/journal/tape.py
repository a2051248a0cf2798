"""The tape: makes a record of every cycle of a controller and hands it on."""

from __future__ import annotations

from marshal import dumps
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.control import Step
from plcsim.core.system import State
from plcsim.core.task import HIGHEST_CLASS
from plcsim.recorder.journal.record import CYCLE, LIMITS
from plcsim.shared_image.force_list import encode_forces

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass, Violation
    from plcsim.recorder.journal.journal import Journal

TOPICS_EVERY: Final = 1000
"""Records after which all topics are described again."""

_FORMAT: Final = 2
"""Of marshal; later ones look for what is the same twice."""

_NONE: Final = ()

MOST_VARIABLES: Final = 256 * 1024
"""Bytes; a record of a project with more has no variables."""


class Tape:
    """Hooks into a controller before its boot.

    Args:
        controller: that is recorded; its clock and network write into the journal.
        journal: what they write into.
        write: takes the time and the bytes of each record (`record_of`).

    Attributes:
        write: as above; may be replaced.
    """

    __slots__ = (
        "_controller",
        "_described",
        "_journal",
        "_left",
        "_scan",
        "_topics",
        "_views",
        "_violations",
        "write",
    )

    def __init__(
        self, controller: Controller, journal: Journal, write: Callable[[int, bytes], object]
    ) -> None:
        self._controller = controller
        self._journal = journal
        self.write = write
        self._scan = controller.scan
        self._violations = [0] * (HIGHEST_CLASS + 1)  # by number: to add up causes takes longer
        memory = controller.memory
        self._views = [memory.view(a.address, a.data_type.size) for a in controller.areas]
        if sum(map(len, self._views)) > MOST_VARIABLES:
            self._views = []
        controller.image.inputs.insert(0, journal.latches.append)
        controller.image.watchers.insert(0, self.take)  # as in a replay, whoever else is there
        controller.image.followers.append(journal.wrote)
        controller.forces.follow(self._forced)
        controller.follow_steps(self._stepped)
        controller.follow_endings(journal.asked_to_end)
        controller.follow_violations(self._violated)
        traffic = controller.context.traffic
        self._topics = traffic.topics
        self._described = 0
        self._left = TOPICS_EVERY
        traffic.followers.append(journal.messages.append)
        traffic.hand_in_followers.append(journal.handed_in)

    def _forced(self) -> None:
        self._journal.wrote(0, encode_forces(list(self._controller.forces)))

    def _violated(self, violation: Violation) -> None:
        self._violations[violation.task_class] += 1

    def take(
        self,
        task_class: TaskClass | None,
        step: int = CYCLE,
        time_ns: int = 0,
        variables: Sequence[bytes | memoryview] = _NONE,
        timings: Sequence[tuple[int, ...]] = _NONE,
    ) -> None:
        """Make a record of what was gathered, and begin the next.

        It is one function, and marshal is one call, for after each sleep the caches are cold: a
        function more costs every cycle some microseconds.

        Args:
            task_class: whose cycle ends; the others are then what they are. None for a step.
            step: as of `plcsim.recorder.journal.record.JournalRecord`; the others too.
            time_ns: see there.
            variables: see there, in pieces.
            timings: see there, each a plain tuple.
        """
        number = cycles = 0
        if task_class is not None:
            number, cycles, time_ns = task_class.number, task_class.cycles, task_class.release_ns
            variables = self._views
            timing = (  # as of `_timing`
                number,
                cycles,
                cycles - 1,
                task_class.missed,
                self._violations[number],
                task_class.lateness.last_ns,
                task_class.execution.last_ns,
                self._scan.halted,
            )
            timings = (timing,)
        topics: Sequence[object] = _NONE
        self._left -= 1
        if not self._left or len(self._topics) != self._described:
            topics = self._descriptions()
        journal = self._journal
        clock, network, messages = journal.clock, journal.network, journal.messages
        writes, latches = journal.writes, journal.latches
        head = step, number, cycles, time_ns
        record: Any = *head, clock, network, writes, topics, messages, variables, timings
        data = dumps(record, _FORMAT)
        clock.clear()  # the lists stay the same: clock and network hold on to them
        network.clear()
        writes.clear()
        messages.clear()
        latches.clear()
        self.write(time_ns, data)

    def _descriptions(self) -> list[tuple[int, tuple[object, ...]]]:
        """Return the topics that are new; now and then all, for a recorder that came later."""
        first = self._described if self._left else 0
        self._left = self._left or TOPICS_EVERY
        self._described = len(self._topics)
        return [(n, tuple(topic)) for n, topic in enumerate(self._topics)][first:]

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
        self.take(None, step.value, time_ns, (given,), timings)
