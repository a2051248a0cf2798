"""Tags of a recording over time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from plcsim.core.errors import TagError
from plcsim.core.tag import find_tag
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.journal.record import CYCLE
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from plcsim.core.tag import Tag
    from plcsim.recorder.bag.head import Head
    from plcsim.recorder.journal.record import Record


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
    head: Head, records: Iterable[tuple[int, Record]], paths: Sequence[str]
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


def _place(head: Head, path: str) -> tuple[Tag, int]:
    """Return a tag and where it begins in the variables of a record."""
    try:
        tag = find_tag(path, head.areas)
    except TagError as err:
        raise RecordingError(str(err)) from None
    for area, start in head.starts().items():
        place = tag.address - area.address
        if 0 <= place < area.data_type.size:
            _number(tag, bytes(tag.data_type.size))
            return tag, start + place
    raise RecordingError(f"{path} was not recorded")


def _number(tag: Tag, data: bytes) -> bool | float:
    value = decode(tag.data_type, data)
    if isinstance(value, bool | int | float):
        return value
    raise RecordingError(f"{tag.path} is a {tag.data_type}, no number")
