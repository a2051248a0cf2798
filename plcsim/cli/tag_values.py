"""Live values of tags: from the snapshot where it holds them, else from samples asked for."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import PlcError
from plcsim.shared_image import SampleCommand
from plcsim.shared_image.command import MAX_OPERATIONS
from plcsim.shared_image.layout import GUEST_STREAM_SIZE
from plcsim.shared_image.samples import MOST, sample_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.core.tag import Tag
    from plcsim.shared_image import ImageReader

PERIOD_NS: Final = 100_000_000
"""Samples are taken so often; on the virtual clock that is soon over, on the real one often
enough to look at."""

LARGEST: Final = GUEST_STREAM_SIZE // 8
"""Bytes of one sample."""

NEAR: Final = 16
"""Bytes. Tags that lie closer together are sampled in one piece."""


class TagValue(NamedTuple):
    """A tag with its value.

    Attributes:
        tag: as it was asked for.
        data: its bytes, None where they are not known yet.
        is_forced: it is forced, or a part of it.
    """

    tag: Tag
    data: bytes | None
    is_forced: bool


class TagValues:
    """Reads tags of a controller that runs in another process.

    Args:
        reader: of its image; with a ring where the snapshot does not hold all tags.
        tags: in the order in which they are read.

    Raises:
        PlcError: too much would have to be sampled.
    """

    def __init__(self, reader: ImageReader, tags: Sequence[Tag]) -> None:
        self._reader = reader
        self._tags = tags
        self._samples: dict[int, bytes] = {}
        self._requests: list[SampleCommand] = []
        missing = [i for i, tag in enumerate(tags) if not reader.directory.holds(tag)]
        if missing:
            self._stream = reader.samples()
        self._offsets = dict(self._ask(missing))

    def _ask(self, missing: Sequence[int]) -> Iterator[tuple[int, tuple[int, int]]]:
        """Ask for samples; give for each tag the number of its sample and its offset in it."""
        spans: list[tuple[int, int]] = []
        size = 0
        for index in sorted(missing, key=lambda index: self._tags[index].address):
            tag = self._tags[index]
            end = tag.address + tag.data_type.size
            first, length = spans[-1] if spans else (0, 0)
            if spans and tag.address - first - length <= NEAR and size < LARGEST:
                size += max(0, end - first - length)
                spans[-1] = (first, max(length, end - first))
            else:
                if size >= LARGEST or len(spans) >= MAX_OPERATIONS:
                    self._send(spans)
                    spans, size = [], 0
                spans.append((tag.address, tag.data_type.size))
                size += tag.data_type.size
            first, length = spans[-1]
            yield index, (len(self._requests) + 1, size - length + tag.address - first)
        if spans:
            self._send(spans)

    def _send(self, spans: list[tuple[int, int]]) -> None:
        if len(self._requests) >= MOST:
            raise PlcError("too many tags are not in the snapshot; name fewer")
        self._requests.append(SampleCommand(len(self._requests) + 1, 0, PERIOD_NS, spans))
        self._reader.send(self._requests[-1])

    def await_all(self, patience_s: float) -> None:
        """Wait until there is a value of every tag, at most so many seconds."""
        deadline = time.monotonic() + patience_s
        while len(self._samples) < len(self._requests) and time.monotonic() < deadline:
            self._collect()
            time.sleep(0.005)

    def _collect(self) -> None:
        if self._requests:
            for record in self._stream.read():
                sample = sample_of(record.data)
                self._samples[sample.number] = sample.data

    def read(self) -> tuple[int, list[TagValue]]:
        """Return the number of the latest snapshot, and all tags with their values."""
        self._collect()
        directory = self._reader.directory
        number, snapshot = self._reader.copy(0, directory.bank_size)
        forces = [(f.address, f.address + len(f.data)) for f in self._reader.forces()]
        rows = []
        for index, tag in enumerate(self._tags):
            size = tag.data_type.size
            data: bytes | None
            if index in self._offsets:
                request, offset = self._offsets[index]
                sample = self._samples.get(request)
                data = None if sample is None else sample[offset : offset + size]
            else:
                offset = directory.offset_of(tag.address, size)
                data = snapshot[offset : offset + size]
            is_forced = any(a < tag.address + size and tag.address < b for a, b in forces)
            rows.append(TagValue(tag, data, is_forced))
        return number, rows
