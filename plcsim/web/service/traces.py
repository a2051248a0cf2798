"""Traces: variables in every cycle, from the stream of samples to a browser, none left out.

Each sample is kept until the browser has taken it. Where a browser is so slow that what waits for
it is more than `MOST_WAITING`, the oldest are dropped and counted: the page says how many.
"""

from __future__ import annotations

import struct
from collections import deque
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from plcsim.core.errors import PlcError
from plcsim.web.service.trace_bag import KeptSamples
from st_types.types.derived import EnumerationType, SubrangeType
from st_types.types.elementary import ElementaryType

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from plcsim.core.tag import Tag
    from plcsim.shared_image.samples import Sample
    from st_types.types.elementary import DataType

MOST_TAGS: Final = 32
MOST_WAITING: Final = 100_000
"""Samples of one trace."""

AT_ONCE: Final = 20_000
"""Samples in one message."""

_HEAD: Final = struct.Struct("<IIII")
"""Number of the trace, samples, columns beside time and cycle, samples lost so far."""


def code_of(data_type: DataType[Any]) -> str:
    """Return how numpy reads a variable that can be drawn.

    Raises:
        PlcError: it has no number.
    """
    base: DataType[Any] = data_type
    if isinstance(data_type, SubrangeType | EnumerationType):
        base = data_type.base
    if isinstance(base, ElementaryType):
        return f"<{base.code}"
    raise PlcError(f"{data_type} cannot be traced; name its parts")


class LiveTrace:
    """One trace of one browser.

    Args:
        number: of the request for samples.
        tags: what is drawn, in this order.

    Attributes:
        number: as given.
        key: by which a browser asks for it later; numbers are given again, keys are not.
        tags: what is drawn.
        spans: what is to be sampled.
        kept: samples for a bag.
        lost: samples that this browser was too slow for, or that were lost on the way here.

    Raises:
        PlcError: there are too many tags, or one has no number.
    """

    def __init__(self, number: int, tags: Sequence[Tag]) -> None:
        if not 0 < len(tags) <= MOST_TAGS:
            raise PlcError(f"a trace has 1 to {MOST_TAGS} variables")
        self.number = number
        self.key = 0
        self.tags = tuple(tags)
        self.kept = KeptSamples(sum(tag.data_type.size for tag in tags))
        self.spans = [(tag.address, tag.data_type.size) for tag in tags]
        self.lost = 0
        codes = [(f"f{at}", code_of(tag.data_type)) for at, tag in enumerate(tags)]
        self._row = np.dtype(codes)
        self._waiting: deque[tuple[int, int, bytes]] = deque()
        self._last = 0

    def take(self, sample: Sample, time_ns: int) -> None:
        """Keep a sample until it is sent."""
        if self._last and sample.cycle > self._last + 1:
            self.lost += sample.cycle - self._last - 1
        self._last = sample.cycle
        if len(self._waiting) >= MOST_WAITING:
            self._waiting.popleft()
            self.lost += 1
        self._waiting.append((time_ns, sample.cycle, sample.data))
        self.kept.add(time_ns, sample.cycle, sample.data)

    def message(self) -> bytes | None:
        """Return what waits, as one message, None where nothing does.

        After the head come columns of numbers of 8 bytes (little-endian): seconds since the start
        of the controller, the cycle, and each variable.
        """
        count = min(AT_ONCE, len(self._waiting))
        if not count:
            return None
        taken = [self._waiting.popleft() for _ in range(count)]
        rows = np.frombuffer(b"".join(data for _, _, data in taken), self._row)
        names: Iterable[str] = self._row.names or ()
        columns = [
            np.array([time_ns for time_ns, _, _ in taken], np.float64) / 1e9,
            np.array([cycle for _, cycle, _ in taken], np.float64),
            *(rows[name].astype(np.float64) for name in names),
        ]
        head = _HEAD.pack(self.number, count, len(self._row.fields or ()), self.lost)
        return head + b"".join(column.astype("<f8").tobytes() for column in columns)
