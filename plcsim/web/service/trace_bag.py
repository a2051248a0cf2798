"""A trace as a bag of ROS 1, written as recordings are: each variable a topic of std_msgs.

Every sample is a message at the time of its cycle; ``/plcsim/cycle`` has the numbers of the cycles.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

from plcsim.core.errors import PlcError
from plcsim.recorder.bag.files import create
from plcsim.recorder.bag.types import messages_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from plcsim.core.tag import Tag

HEAD: Final = struct.Struct("<qQ")
"""Before the variables of each sample: nanoseconds since the start of the controller, the cycle."""

CYCLE: Final = "/plcsim/cycle"

MOST_BYTES: Final = 16 * 1024 * 1024
"""Of one trace that are kept for a bag; of 8 REALs at 1 ms almost six minutes."""


class KeptSamples:
    """The last samples of a trace.

    Args:
        size: bytes of the variables of a sample.
    """

    def __init__(self, size: int) -> None:
        self._row = HEAD.size + size
        self._data = bytearray()

    def __len__(self) -> int:
        return len(self._data) // self._row

    def add(self, time_ns: int, cycle: int, data: bytes) -> None:
        """Keep a sample; the oldest quarter goes where there is no room."""
        if len(self._data) + self._row > MOST_BYTES:
            del self._data[: max(1, len(self) // 4) * self._row]
        self._data += HEAD.pack(time_ns, cycle)
        self._data += data

    def rows(self) -> Iterator[tuple[int, int, bytes]]:
        """Return time, cycle and variables of each sample, as they are now."""
        data = bytes(self._data)
        for at in range(0, len(data), self._row):
            time_ns, cycle = HEAD.unpack_from(data, at)
            yield time_ns, cycle, data[at + HEAD.size : at + self._row]


def write_bag(path: Path, tags: Sequence[Tag], samples: KeptSamples, epoch_ns: int) -> None:
    """Write a bag.

    Args:
        path: of the new file, which ends in ``.bag``.
        tags: whose values are in the samples, in this order.
        samples: at least one.
        epoch_ns: of ROS, when the controller started.

    Raises:
        RecordingError: rosbags is not installed, or the file cannot be made.
        PlcError: there is no sample, or the disk takes no more.
    """
    if not len(samples):
        raise PlcError("the trace has no samples yet")
    bag = create(path)
    try:
        cycles = bag.add(CYCLE, "std_msgs/msg/UInt64")
        topics, start = [], 0
        for tag in tags:
            for each in messages_of(tag, start):
                topics.append((bag.add(each.topic, each.type_name), each))
            start += tag.data_type.size
        for time_ns, cycle, data in samples.rows():
            row = [(cycles, cycle.to_bytes(8, "little"))]
            for connection, each in topics:
                row.append((connection, each.message(data[each.start : each.start + each.size])))
            bag.write(epoch_ns + time_ns, row)
        bag.close()
    except OSError as err:
        bag.abandon()
        raise PlcError(f"the bag cannot be written: {err.strerror}") from None
