"""Runs a project on what was recorded, and compares every cycle.

The controller is assembled as for a run, but its clock and its network answer from the recording,
and what was written from outside is written again in the same LATCH. So the same programs do the
same; where they do not, the first difference is told.
"""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.control import Step
from plcsim.core.tag import Tag
from plcsim.project.assembly import VIRTUAL_IP, assemble
from plcsim.recorder.bag.values import first_difference
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.clock import ReplayClock
from plcsim.recorder.journal.feed import Diverged, EndOfRecord, Feed
from plcsim.recorder.journal.network import ReplayNetwork
from plcsim.recorder.journal.record import CYCLE, HAND_IN, LIMITS, handed_in
from plcsim.shared_image.directory import describe_type

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from plcsim.core.task import TaskClass
    from plcsim.machine import Frame
    from plcsim.project.assembly import Application
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import JournalRecord, JournalStore

TABLE = "record"


class ReplayDifference(NamedTuple):
    """Where a replay differs from the recorded run.

    Attributes:
        task_class: number of the class.
        cycle: of that class.
        text: how.
    """

    task_class: int
    cycle: int
    text: str

    def __str__(self) -> str:
        return f"cycle {self.cycle} of task class {self.task_class}: {self.text}"


class _Reached(BaseException):
    """The replay has come as far as it was asked to."""


class Replay:
    """A run that is repeated.

    Args:
        application: the project, loaded.
        head: of the recording.
        records: of the recording, with their numbers.
        watch: told of the stores of compiled programs, see `plcsim.machine.Machine`.

    Attributes:
        controller: that runs again.
        cycles: repeated so far.
        difference: the first one, None while there is none.
        after_cycle: called in PUBLISH of every cycle with the task class and the record.

    Raises:
        RecordingError: the recording is not of this project, or it begins in the middle.
    """

    def __init__(
        self,
        application: Application,
        head: Head,
        records: Iterable[tuple[int, JournalRecord]],
        watch: Callable[[Frame], None] | None = None,
    ) -> None:
        self._head = head
        self._feed = feed = Feed(_without_gaps(records))
        if feed.current is None or feed.current.step != Step.BOOT.value:
            raise RecordingError("the recording does not begin with the start of the controller")
        extensions = {k: v for k, v in application.extensions.items() if k != TABLE}
        application = replace(application, extensions=extensions)
        if head.is_virtual:
            application = application.in_process(VIRTUAL_IP)
        clock = ReplayClock(feed, is_virtual=head.is_virtual)
        try:
            self.controller = assemble(
                application, clock=clock, network=ReplayNetwork(feed), watch=watch
            )
        except (Diverged, EndOfRecord):
            raise RecordingError(
                "the project is not the recorded one: before its first cycle it asks for more"
            ) from None
        _check_areas(head.areas, self.controller.areas)
        self.cycles = 0
        self.difference: ReplayDifference | None = None
        self.after_cycle: list[Callable[[TaskClass, JournalRecord], None]] = []
        self._last: tuple[int, int] = (0, 0)
        self._until: Callable[[TaskClass], bool] | None = None
        self._views = [
            self.controller.memory.view(a.address, a.data_type.size) for a in self.controller.areas
        ]
        self._retained = b""
        self.controller.follow_steps(self._stepped)
        feed.end_run = self.controller.end_run
        self.controller.image.inputs.append(self._latch)
        self.controller.image.watchers.insert(0, self._publish)

    def run(self, until: Callable[[TaskClass], bool] | None = None) -> ReplayDifference | None:
        """Repeat the run to its end; return the first difference, None where there is none.

        Args:
            until: stops after a cycle for which it returns True; it is asked in PUBLISH.

        Raises:
            RecordingError: records are missing from here on.
        """
        self._until = until
        with suppress(_Reached):
            while self._feed.current is not None and self.difference is None:
                self._step(self._feed.current)
        return self.difference

    def _step(self, record: JournalRecord) -> None:
        """Do the step that a record ends with."""
        if record.step == CYCLE:
            return self._differs("the run ended before this cycle")
        step = Step(record.step)
        limits = LIMITS.unpack(record.variables) if step is Step.RUN else (0, 0)
        self._retained = record.variables
        self._next()
        with suppress(EndOfRecord, Diverged):
            self._do(step, *limits)
        if self._feed.reason:
            self._differs(self._feed.reason)
        return None

    def _do(self, step: Step, until_ns: int, cycles: int) -> None:
        controller = self.controller
        match step:
            case Step.BOOT:
                controller.boot()
            case Step.START:
                controller.start()
            case Step.RUN:
                controller.run(until_ns or None, cycles or None)
            case Step.RESUME:
                controller.resume()
            case Step.SHUTDOWN:
                controller.shutdown()
            case Step.CLOSE:
                controller.close()

    def _stepped(self, step: Step, _until_ns: int, _cycles: int) -> None:
        """Give retained variables what the recorded boot gave them."""
        if step is Step.BOOT:
            self.controller.retained.from_bytes(self._retained)

    def _next(self) -> None:
        self._feed.advance()
        self._write(self._feed.written(0))

    def _latch(self, _task_class: TaskClass) -> None:
        self._write(self._feed.latch())

    def _write(self, entries: Iterable[JournalStore]) -> None:
        for entry in entries:
            if entry.address == HAND_IN:
                self.controller.context.traffic.hand_in(*handed_in(entry.data))
            elif entry.address:
                self.controller.memory.write(entry.address, entry.data)
            else:
                self._force(entry.data)

    def _force(self, text: bytes) -> None:
        forces = self.controller.forces
        forces.clear()
        for path, address, data, source in json.loads(text):
            kind = self.controller.tags.find(path).data_type
            forces.force(Tag(path, kind, address), bytes.fromhex(data), source)

    def _publish(self, task_class: TaskClass) -> None:
        record = self._feed.current
        if record is None or record.step != CYCLE:
            raise EndOfRecord
        self._compare(task_class, record)
        if self.difference is not None:
            raise _Reached
        self.cycles += 1
        self._last = task_class.number, task_class.cycles
        for told in self.after_cycle:
            told(task_class, record)
        self._next()
        if self._until is not None and self._until(task_class):
            raise _Reached

    def _compare(self, task_class: TaskClass, record: JournalRecord) -> None:
        """Note the first thing that is otherwise than recorded."""
        ran = task_class.number, task_class.cycles, self.controller.context.release_ns
        if ran != (record.task_class, record.cycle, record.time_ns):
            return self._differs(f"now it is cycle {ran[1]} of task class {ran[0]}")
        variables = b"".join(self._views)
        if record.variables and variables != record.variables:
            tag, now, then = first_difference(self._head, variables, record.variables)
            return self._differs(f"{tag} is {now}, and was {then}")
        if left := self._feed.left:
            return self._differs(left)
        return None

    def _differs(self, text: str) -> None:
        record = self._feed.current
        if self.difference is not None:
            return
        if record is not None and record.step == CYCLE:
            self.difference = ReplayDifference(record.task_class, record.cycle, text)
        else:
            self.difference = ReplayDifference(*self._last, f"after it, {text}")


def _check_areas(recorded: Sequence[Tag], here: Sequence[Tag]) -> None:
    """Raise a RecordingError where the variables are not those of the recording."""
    for then, now in zip(recorded, here, strict=False):
        if then.path != now.path or describe_type(then.data_type) != describe_type(now.data_type):
            name = now.path or "the global variables"
            raise RecordingError(f"the variables of {name} are not those that were recorded")
    if len(recorded) != len(here):
        raise RecordingError("the programs are not those that were recorded")


def _without_gaps(records: Iterable[tuple[int, JournalRecord]]) -> Iterator[JournalRecord]:
    """Return the records.

    Raises:
        RecordingError: some are missing.
    """
    for expected, (number, record) in enumerate(records):
        if number != expected:
            raise RecordingError(
                f"records {expected} to {number - 1} were lost while it was recorded: "
                "the run cannot be repeated beyond"
            )
        yield record
