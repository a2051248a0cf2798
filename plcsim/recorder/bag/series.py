"""Tags of a recording over time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from plcsim.core.errors import TagError
from plcsim.core.tag import find_tag, leaves
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.record import CYCLE
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from plcsim.core.tag import Tag
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import JournalRecord


@dataclass
class Series:
    """The values of one tag, wherever it changed.

    Attributes:
        tag: whose values.
        points: (nanoseconds since the first cycle, value), the first and the last cycle always.
    """

    tag: Tag
    points: list[tuple[int, bool | float]] = field(default_factory=list)


def series_of(
    head: Head, records: Iterable[tuple[int, JournalRecord]], paths: Sequence[str]
) -> list[Series]:
    """Return the values of tags with a number, an enumeration or a BOOL.

    Raises:
        RecordingError: there is no such tag, it has no number, or the variables were not recorded.
    """
    places = [_place(head, path) for path in paths]
    made = [Series(tag) for tag, _ in places]
    last = [b""] * len(places)
    first_ns: int | None = None
    time_ns = 0
    for _, record in records:
        if record.step != CYCLE or not record.variables:
            continue
        first_ns = record.time_ns if first_ns is None else first_ns
        time_ns = record.time_ns - first_ns
        for number, (tag, start) in enumerate(places):
            data = record.variables[start : start + tag.data_type.size]
            if data != last[number]:
                last[number] = data
                made[number].points.append((time_ns, _number(tag, data)))
    if first_ns is None:
        raise RecordingError("no variables were recorded")
    for each in made:
        each.points.append((time_ns, each.points[-1][1]))
    return made


def columns_of(head: Head, paths: Sequence[str]) -> list[Tag]:
    """Return the tags of `rows_of`; STRUCTs and ARRAYs are as many columns as they have leaves.

    Raises:
        RecordingError: there is no such tag.
    """
    return [leaf for path in paths for leaf in leaves(_find(head, path))]


def rows_of(
    head: Head, records: Iterable[tuple[int, JournalRecord]], paths: Sequence[str]
) -> Iterator[list[object]]:
    """Return a row for every cycle: seconds since the first, task class, cycle, then the values.

    Args:
        head: of the recording.
        records: of the recording.
        paths: of the tags, see `columns_of`.

    Yields:
        the names of the columns first.

    Raises:
        RecordingError: there is no such tag, or the variables were not recorded.
    """
    found = columns_of(head, paths)
    places = [(leaf, _start(head, leaf)) for leaf in found]
    yield ["time_s", "task_class", "cycle", *(leaf.path for leaf in found)]
    first_ns: int | None = None
    for _, record in records:
        if record.step != CYCLE:
            continue
        if not record.variables:
            raise RecordingError("no variables were recorded")
        first_ns = record.time_ns if first_ns is None else first_ns
        yield [
            (record.time_ns - first_ns) / 1e9,
            record.task_class,
            record.cycle,
            *(
                decode(leaf.data_type, record.variables[at : at + leaf.data_type.size])
                for leaf, at in places
            ),
        ]


def _find(head: Head, path: str) -> Tag:
    try:
        return find_tag(path, head.areas)
    except TagError as err:
        raise RecordingError(str(err)) from None


def _start(head: Head, tag: Tag) -> int:
    """Return where a tag begins in the variables of a record."""
    for area, start in head.starts().items():
        place = tag.address - area.address
        if 0 <= place < area.data_type.size:
            return start + place
    raise RecordingError(f"{tag.path} was not recorded")


def _place(head: Head, path: str) -> tuple[Tag, int]:
    """Return a tag and where it begins in the variables of a record."""
    tag = _find(head, path)
    _number(tag, bytes(tag.data_type.size))
    return tag, _start(head, tag)


def _number(tag: Tag, data: bytes) -> bool | float:
    value = decode(tag.data_type, data)
    if isinstance(value, bool | int | float):
        return value
    raise RecordingError(f"{tag.path} is a {tag.data_type}, no number")
