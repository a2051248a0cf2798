"""Where two recordings differ first."""

from __future__ import annotations

from itertools import zip_longest
from typing import TYPE_CHECKING, Final

from plcsim.recorder.bag.types import CYCLES, DIAGNOSTICS, HEAD, LOGBOOK
from plcsim.recorder.bag.values import BETWEEN, MOST_NAMED, differences
from plcsim.recorder.journal.record import CYCLE
from plcsim.shared_image.directory import describe_type

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.bag.reading import BagReader
    from plcsim.recorder.journal.record import JournalRecord

_APART: Final = frozenset((CYCLES, DIAGNOSTICS, HEAD, LOGBOOK))
"""Topics whose messages are compared in another way, or not at all."""


def difference(first: BagReader, second: BagReader) -> str:
    """Return the first difference of two recordings as a line, "" where there is none.

    The variables of every cycle count, then the messages of all other topics; not the logbook,
    the timing, and what clock and network gave: on the real clock these are never the same twice.

    Raises:
        RecordingError: a bag is damaged, or plcsim has not recorded it.
    """
    heads = first.head(), second.head()
    return (
        _of_variables(*heads) or _of_cycles(heads[0], first, second) or _of_messages(first, second)
    )


def _of_variables(first: Head, second: Head) -> str:
    """Return how the programs differ."""
    kinds = [
        {area.path: describe_type(area.data_type) for area in head.areas}
        for head in (first, second)
    ]
    for name in [*kinds[0], *kinds[1]]:
        if kinds[0].get(name) != kinds[1].get(name):
            return f"the variables of {name or 'the project'} are others"
    return ""


def _of_cycles(head: Head, first: BagReader, second: BagReader) -> str:
    for one, other in zip_longest(_cycles(first), _cycles(second)):
        if one is None or other is None:
            path = (second if other is None else first).path
            missing = one or other
            assert missing is not None
            return f"{path} ends before {_name(missing)}"
        if text := _of_records(head, one, other):
            return text
    return ""


def _cycles(bag: BagReader) -> Iterator[JournalRecord]:
    return (record for _, record in bag.records() if record.step == CYCLE)


def _of_records(head: Head, one: JournalRecord, other: JournalRecord) -> str:
    if (one.task_class, one.cycle) != (other.task_class, other.cycle):
        return f"{_name(one)} against {_name(other)}"
    if one.variables != other.variables:
        found = differences(head, one.variables, other.variables)
        named = [f"{tag} is {here} against {there}" for tag, here, there in found[:MOST_NAMED]]
        more = ["more"] if len(found) > MOST_NAMED else []
        return f"{_name(one)}: {', '.join(named + more) or BETWEEN}"
    return ""


def _name(record: JournalRecord) -> str:
    return f"cycle {record.cycle} of task class {record.task_class}"


def _of_messages(first: BagReader, second: BagReader) -> str:
    """Return the first message of a topic that differs, by its bytes."""
    topics = {t.name for bag in (first, second) for t in bag.topics} - _APART
    for topic in sorted(topics):
        pairs = zip_longest(first.messages([topic]), second.messages([topic]))
        for number, (one, other) in enumerate(pairs, 1):
            if one is None or other is None:
                path = (second if other is None else first).path
                return f"{path} has only {number - 1} messages of {topic}"
            if (one.type_name, one.as_ros1) != (other.type_name, other.as_ros1):
                return f"message {number} of {topic} differs"
    return ""
