"""The tape: makes a record of every cycle of a controller and hands it on."""

from __future__ import annotations

from marshal import dumps
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.control import Step
from plcsim.core.system import State
from plcsim.core.task import HIGHEST_CLASS
from plcsim.recorder.journal.record import LIMITS, NO_CLASS
from plcsim.shared_image.events import EventKind
from plcsim.shared_image.force_list import encode_forces

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass, Violation
    from plcsim.recorder.journal.journal import Journal

TOPICS_EVERY: Final = 1000
"""Cycles of a class after which all topics are described again."""

_RECORD: Final = EventKind.RECORD.value

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
        write: takes each record (`record_of`) as `StreamWriter.write` does: kind, time, bytes.

    Attributes:
        write: as above; may be replaced.
    """

    __slots__ = (
        "_clear_clock",
        "_clear_latches",
        "_clear_messages",
        "_clear_network",
        "_clear_writes",
        "_controller",
        "_described",
        "_gathered",
        "_journal",
        "_scan",
        "_topics",
        "_violations",
        "write",
    )

    def __init__(
        self, controller: Controller, journal: Journal, write: Callable[[int, int, bytes], object]
    ) -> None:
        self._controller = controller
        self._journal = journal
        self.write = write
        self._scan = controller.scan
        self._violations = [0] * (HIGHEST_CLASS + 1)  # by number: to add up causes takes longer
        memory = controller.memory
        views = [memory.view(a.address, a.data_type.size) for a in controller.areas]
        if sum(map(len, views)) > MOST_VARIABLES:
            views = []
        # Always the same objects, so that they are named and looked up once and not in each cycle.
        self._gathered = journal.clock, journal.network, journal.writes, journal.messages, views
        self._clear_clock = journal.clock.clear
        self._clear_network = journal.network.clear
        self._clear_writes = journal.writes.clear
        self._clear_messages = journal.messages.clear
        self._clear_latches = journal.latches.clear
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
        traffic.followers.append(journal.messages.append)
        traffic.hand_in_followers.append(journal.handed_in)

    def _forced(self) -> None:
        self._journal.wrote(0, encode_forces(list(self._controller.forces)))

    def _violated(self, violation: Violation) -> None:
        self._violations[violation.task_class] += 1

    def take(self, task_class: TaskClass) -> None:
        """Make a record of a cycle in its PUBLISH, and begin the next.

        It is one function, and marshal is one call, for after each sleep the caches are cold: a
        function more costs every cycle some microseconds.
        """
        number, cycles, time_ns = task_class.number, task_class.cycles, task_class.release_ns
        topics: Sequence[object] = _NONE
        if len(self._topics) != self._described or not cycles % TOPICS_EVERY:
            topics = self._descriptions(all_of_them=not cycles % TOPICS_EVERY)
        record: Any = (
            number,
            cycles,
            time_ns,
            task_class.missed,
            self._violations[number],
            task_class.lateness.last_ns,
            task_class.execution.last_ns,
            self._scan.halted,
            topics,
            self._gathered,
        )
        data = dumps(record, _FORMAT)
        self._clear_clock()  # the lists stay the same: clock and network hold on to them
        self._clear_network()
        self._clear_writes()
        self._clear_messages()
        self._clear_latches()
        self.write(_RECORD, time_ns, data)

    def take_step(
        self, step: int, time_ns: int, given: bytes = b"", timings: Sequence[tuple[int, ...]] = ()
    ) -> None:
        """Make a record of what was gathered before a step, and begin the next.

        Args:
            step: as of `plcsim.recorder.journal.record.JournalRecord`; the others too.
            time_ns: see there.
            given: the variables.
            timings: see there, each a plain tuple.
        """
        topics = self._descriptions(all_of_them=False)
        record: Any = NO_CLASS, step, time_ns, given, timings, topics, self._gathered
        data = dumps(record, _FORMAT)
        for gathered in (*self._gathered[:-1], self._journal.latches):
            gathered.clear()
        self.write(_RECORD, time_ns, data)

    def _descriptions(self, *, all_of_them: bool) -> list[tuple[int, tuple[object, ...]]]:
        """Return the topics that are new; now and then all, for a recorder that came later."""
        first = 0 if all_of_them else self._described
        self._described = len(self._topics)
        return [(n, tuple(topic)) for n, topic in enumerate(self._topics)][first:]

    def _timings(self) -> list[tuple[int, ...]]:
        """Return a `plcsim.recorder.journal.record.ClassTiming` of each class that has run."""
        is_service = self._controller.state is State.SERVICE
        return [
            (
                each.number,
                each.cycles,
                each.cycles,
                each.missed,
                self._violations[each.number],
                each.lateness.last_ns,
                each.execution.last_ns,
                is_service,
            )
            for each in self._controller.classes
            if each.cycles
        ]

    def _stepped(self, step: Step, until_ns: int, cycles: int) -> None:
        given = b""
        if step is Step.RUN:
            given = LIMITS.pack(until_ns, cycles)
        elif step is Step.BOOT:
            given = self._controller.retained.to_bytes()
        timings = self._timings() if step in (Step.BOOT, Step.CLOSE) else ()
        self.take_step(step.value, self._controller.clock.stamp_ns(), given, timings)
