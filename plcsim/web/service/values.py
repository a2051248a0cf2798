"""Live values: what the pages watch, read once for all of them.

A tag that the snapshot holds is read there; any other is sampled ten times a second. A value is
turned into JSON only when its bytes have changed, however many pages show it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.errors import PlcError
from plcsim.shared_image import Cancel, ImageNotReady, SampleCommand
from plcsim.shared_image.command import MAX_OPERATIONS
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    StringType,
    StructType,
    WStringType,
)
from st_types.types.elementary import DATE, DATE_AND_TIME, TIME, TIME_OF_DAY
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.tag import Tag
    from plcsim.shared_image import ImageReader
    from st_types.types.elementary import DataType

SAMPLES: Final = 16
"""Numbers of samples that watched tags may take; those above are for traces."""

PERIOD_NS: Final = 100_000_000
LARGEST: Final = 512 * 1024
"""Bytes of one sample."""

LONGEST: Final = 300
"""Characters of a STRUCT or an ARRAY shown as one."""

EXACT: Final = 1 << 53
"""Integers beyond are told as text: a number of JavaScript cannot hold them."""

_TEXTS = (TIME, DATE, TIME_OF_DAY, DATE_AND_TIME)


def json_value(data_type: DataType[Any], data: bytes) -> object:
    """Return a value as the pages show it: a number, a truth value, or text."""
    value = decode(data_type, data)
    if isinstance(data_type, StringType | WStringType):
        return value
    if isinstance(data_type, StructType | ArrayType):
        text = value_text(data_type, value)
        return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."
    if isinstance(data_type, EnumerationType) or data_type in _TEXTS:
        return value_text(data_type, value)
    if isinstance(value, float):
        return float(value_text(data_type, value)) if math.isfinite(value) else str(value)
    if isinstance(value, int) and abs(value) > EXACT:
        return str(value)
    return value


class Watched:
    """A tag that somebody watches.

    Attributes:
        tag: as it was asked for.
        value: for JSON, None while it is not known.
        version: grows with every new value.
        watchers: how many watch it.
    """

    def __init__(self, tag: Tag) -> None:
        self.tag = tag
        self.value: object = None
        self.version = 0
        self.watchers = 0
        self._data = b""

    def show(self, data: bytes) -> None:
        """Take the present bytes."""
        if data != self._data:
            self._data = data
            self.value = json_value(self.tag.data_type, data)
            self.version += 1


class LiveValues:
    """The tags that somebody watches, and their values.

    Args:
        image: the shared image, with a ring and a stream.
    """

    def __init__(self, image: ImageReader) -> None:
        self._image = image
        self._watched: dict[tuple[int, str, str], Watched] = {}
        self._sampled: dict[int, list[tuple[Watched, int]]] = {}
        self._is_changed = False
        self.snapshot = 0

    def watch(self, tags: Sequence[Tag]) -> list[Watched]:
        """Watch tags; each call has its `leave`."""
        found = []
        for tag in tags:
            key = tag.address, tag.path, str(tag.data_type)
            watched = self._watched.get(key)
            if watched is None:
                watched = self._watched[key] = Watched(tag)
                self._is_changed |= not self._image.directory.holds(tag)
            watched.watchers += 1
            found.append(watched)
        return found

    def leave(self, watched: Sequence[Watched]) -> None:
        """Watch no more what `watch` returned."""
        for one in watched:
            one.watchers -= 1
            if not one.watchers:
                tag = one.tag
                del self._watched[tag.address, tag.path, str(tag.data_type)]
                self._is_changed |= not self._image.directory.holds(tag)

    def refresh(self) -> None:
        """Read all values from the latest snapshot, and ask for those that it does not hold."""
        if self._is_changed:
            self._is_changed = False
            self._ask()
        directory = self._image.directory
        try:
            self.snapshot, data = self._image.copy(0, directory.bank_size if self._watched else 0)
        except ImageNotReady:
            return
        for one in self._watched.values():
            if directory.holds(one.tag):
                size = one.tag.data_type.size
                at = directory.offset_of(one.tag.address, size)
                one.show(data[at : at + size])

    def sampled(self, number: int, data: bytes) -> None:
        """Take a sample of tags that the snapshot does not hold."""
        for one, at in self._sampled.get(number, ()):
            one.show(data[at : at + one.tag.data_type.size])

    def _ask(self) -> None:
        """Ask for samples of all that the snapshot does not hold."""
        for number in self._sampled:
            self._image.send(Cancel(number))
        self._sampled.clear()
        wanted = [w for w in self._watched.values() if not self._image.directory.holds(w.tag)]
        spans: list[tuple[int, int]] = []
        members: list[tuple[Watched, int]] = []
        size = 0
        for one in wanted:
            length = one.tag.data_type.size
            if spans and (size + length > LARGEST or len(spans) >= MAX_OPERATIONS):
                self._send(spans, members)
                spans, members, size = [], [], 0
            spans.append((one.tag.address, length))
            members.append((one, size))
            size += length
        if spans:
            self._send(spans, members)

    def _send(self, spans: list[tuple[int, int]], members: list[tuple[Watched, int]]) -> None:
        number = len(self._sampled) + 1
        if number > SAMPLES:
            raise PlcError("too many tags are watched that are not in the snapshot")
        self._image.send(SampleCommand(number, 0, PERIOD_NS, spans))
        self._sampled[number] = members
