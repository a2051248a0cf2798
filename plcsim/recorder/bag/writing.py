"""Writes a recording: records, the logbook, timing and chosen tags, into one bag after another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.tag import find_tag
from plcsim.recorder.bag.changes import changes
from plcsim.recorder.bag.diagnostics import TimingDiagnostics
from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.head import head_text
from plcsim.recorder.bag.names import active
from plcsim.recorder.bag.tag_block import TagBlock, equally_long
from plcsim.recorder.bag.types import (
    CYCLE_TYPE,
    CYCLES,
    DIAGNOSTIC_TYPE,
    DIAGNOSTICS,
    HEAD,
    LOG_TYPE,
    LOGBOOK,
    TEXT_TYPE,
    CycleMessage,
    TagMessages,
    log_message,
    messages_of,
    text_message,
)
from plcsim.recorder.journal.record import CYCLE

if TYPE_CHECKING:
    from pathlib import Path

    from plcsim.core.logbook import Entry
    from plcsim.core.tag import Tag
    from plcsim.core.traffic import Topic
    from plcsim.recorder.bag.files import Bag
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import JournalRecord

FIRST_NS: Final = 1
"""ROS takes 0 for "no time"."""

WHOLE_EVERY: Final = 10_000
"""Records after which all variables are written again, so that one can begin in the middle."""


@dataclass(frozen=True)
class Limits:
    """When the next file begins.

    Attributes:
        size: bytes of a file, 0 for any.
        duration_ns: of a file, 0 for any.
        files: the oldest is deleted when there are more, 0 for any.
    """

    size: int = 0
    duration_ns: int = 0
    files: int = 0


class Writing:
    """A recording that is being written.

    Args:
        path: of the first file; the next ones have a number before the ending.
        head: what is recorded.
        limits: when the next file begins.
        beside_others: where a file is there already, take the next number.

    Attributes:
        files: those written and the one being written.
        lost: records that never came.
        lost_messages: whose topic was described in one of those.

    Raises:
        RecordingError: the file is there already or cannot be made.
    """

    def __init__(
        self, path: Path, head: Head, limits: Limits, *, beside_others: bool = False
    ) -> None:
        self._path = path
        self._head = head
        self._limits = limits
        self._tags = tag_messages(head)
        self._diagnostics = TimingDiagnostics(head)
        self._number = 0
        self._next = 0
        self._before = b""
        self._since_whole = 0
        self._logged = 0
        self._topics: dict[int, Topic] = {}
        self.lost = self.lost_messages = 0
        self.files: list[Path] = []
        self._latest_ns = max(FIRST_NS, head.epoch_ns + head.origin_ns)
        while beside_others and (self._file.exists() or active(self._file).exists()):
            self._number += 1
        self._open()

    @property
    def _file(self) -> Path:
        path = self._path
        return path.with_name(f"{path.stem}_{self._number}{path.suffix}") if self._number else path

    def _open(self) -> None:
        path = self._file
        self._bag: Bag = create(path)
        self.files.append(path)
        self._cycles = self._bag.add(CYCLES, CYCLE_TYPE)
        self._logbook = self._bag.add(LOGBOOK, LOG_TYPE)
        self._timing = self._bag.add(DIAGNOSTICS, DIAGNOSTIC_TYPE)
        self._blocks = [TagBlock(tags) for tags in equally_long(self._tags)]
        self._borders: dict[int, Any] = {}
        self._before = b""
        self._since_ns = self._latest_ns
        head = self._bag.add(HEAD, TEXT_TYPE, latching=True)
        self._bag.write(self._latest_ns, [(head, text_message(head_text(self._head)))])

    def _bag_ns(self, time_ns: int) -> int:
        """Return the time in the bag for one of the controller's clock, never going back."""
        self._latest_ns = max(self._latest_ns, self._head.epoch_ns + time_ns)
        return self._latest_ns

    def record(self, number: int, record: JournalRecord, *, with_tags: bool = True) -> None:
        """Write a record, and what has changed of the chosen tags.

        Args:
            number: of the record, from 0; those left out are lost.
            record: the record.
            with_tags: write the chosen tags that have changed as messages of their own.
        """
        self._turn_over()
        if number > self._next:
            self.lost += number - self._next
            self._before = b""
        self._next = number + 1
        bag_ns = self._bag_ns(record.time_ns)
        self._since_whole += 1
        is_cycle = record.step == CYCLE
        whole = is_cycle and (not self._before or self._since_whole >= WHOLE_EVERY)
        variables = record.variables
        if whole:
            self._since_whole = 0
        elif is_cycle:
            variables = changes(self._before, variables)
        message = CycleMessage(
            record.step,
            record.task_class,
            number,
            record.cycle,
            record.time_ns,
            record.clock,
            record.network,
            record.writes,
            whole,
            variables,
        )
        for topic_number, topic in record.topics:
            self._describe(topic_number, topic)
        crossings = [self._crossing(*each) for each in record.messages]
        written = [(self._cycles, message.to_bytes()), *[each for each in crossings if each]]
        if told := self._diagnostics.message(record, bag_ns):
            written.append((self._timing, told))
        self._bag.write(bag_ns, written)
        if is_cycle and record.variables:
            self._before = record.variables
            if with_tags:
                self._write_tags(bag_ns, record.variables)

    def _describe(self, number: int, topic: Topic) -> None:
        """Note what the messages of a number go over."""
        if self._topics.get(number) != topic:
            self._topics[number] = topic
            self._borders.pop(number, None)

    def _crossing(self, number: int, data: bytes) -> tuple[Any, bytes] | None:
        """Return a message with its connection; None where its topic is not known."""
        if number not in self._topics:  # described in a record that was lost
            self.lost_messages += 1
            return None
        if number not in self._borders:
            self._borders[number] = self._bag.add_foreign(self._topics[number])
        return self._borders[number], data

    def _write_tags(self, bag_ns: int, variables: bytes) -> None:
        for block in self._blocks:
            block.write(self._bag, bag_ns, variables)

    def entry(self, entry: Entry) -> None:
        """Write an entry of the logbook."""
        bag_ns = self._bag_ns(self._head.origin_ns + entry.time_ns)
        self._bag.write(bag_ns, [(self._logbook, log_message(self._logged, bag_ns, entry))])
        self._logged += 1

    def flush(self) -> None:
        """Bring what was written into the file."""
        self._bag.flush()

    def _turn_over(self) -> None:
        """Begin the next file where this one has reached a limit."""
        limits = self._limits
        is_large = limits.size and self._bag.size >= limits.size
        is_long = limits.duration_ns and self._latest_ns - self._since_ns >= limits.duration_ns
        if not (is_large or is_long):
            return
        self._bag.close()
        self._number += 1
        self._open()
        while limits.files and len(self.files) > limits.files:
            self.files.pop(0).unlink(missing_ok=True)

    def close(self) -> None:
        """End the file that is being written."""
        self._bag.close()

    def abandon(self, err: OSError) -> str:
        """End where nothing can be written any more; return what to tell of it."""
        self._bag.abandon()
        left = active(self.files[-1])
        hint = f"; plcsim bag reindex {left} makes readable what is there" if left.is_file() else ""
        return f"{self._path}: cannot be written: {err}{hint}"


def tag_messages(head: Head) -> list[TagMessages]:
    """Return how the chosen tags become messages.

    Raises:
        TagError: there is no such tag.
    """
    starts = head.starts()
    found: dict[str, TagMessages] = {}
    for path in head.tags:
        tags = head.areas if path == "*" else [_find(head, path.removesuffix(".*"))]
        for tag in tags:
            area = next(a for a in head.areas if _holds(a, tag))
            place = starts[area] + tag.address - area.address
            for each in messages_of(tag, place):
                found.setdefault(each.topic, each)
    return list(found.values())


def _find(head: Head, path: str) -> Tag:
    area = next((a for a in head.areas if a.path.upper() == path.upper()), None)
    return area or find_tag(path, head.areas)


def _holds(area: Tag, tag: Tag) -> bool:
    end = area.address + area.data_type.size
    return area.address <= tag.address and tag.address + tag.data_type.size <= end
