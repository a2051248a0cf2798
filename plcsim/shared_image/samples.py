"""Samples: variables that a service chose, copied in PUBLISH into its stream, in every cycle.

Nothing is lost on the way but what the service is too slow to read, and that is counted. What
belongs to a class in the middle of a cycle is as in the sample before.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import PageFault
from plcsim.shared_image.command import Follow
from plcsim.shared_image.events import EventKind

if TYPE_CHECKING:
    from plcsim.core.memory import Memory
    from plcsim.core.owners import Owners
    from plcsim.core.task import TaskClass
    from plcsim.shared_image.command import SampleCommand
    from plcsim.shared_image.stream import StreamWriter

MOST: Final = 64
"""Of one service at a time."""

_HEAD = struct.Struct("<IIq")
_KIND: Final = EventKind.SAMPLE.value


class Sample(NamedTuple):
    """One sample, as a service gets it.

    Attributes:
        number: of the request it belongs to.
        task_class: number of the class whose PUBLISH it was taken in.
        cycle: of that class, from 1.
        data: the variables, one after another.
    """

    number: int
    task_class: int
    cycle: int
    data: bytes


def sample_of(data: bytes) -> Sample:
    """Return the sample in a record of the kind `EventKind.SAMPLE`."""
    number, task_class, cycle = _HEAD.unpack_from(data)
    return Sample(number, task_class, cycle, data[_HEAD.size :])


class _Request:
    """A request that is being served."""

    def __init__(self, request: SampleCommand, memory: Memory, owners: Owners) -> None:
        self.number = request.number
        self.task_class = request.task_class
        self.period_ns = request.period_ns
        self.due_ns = 0
        pieces = [part for span in request.spans for part in owners.cut(*span)]
        self._pieces = [(owner, memory.view(address, size)) for owner, address, size in pieces]
        self._parts: list[bytes | memoryview] = [b"", *(view for _, view in self._pieces)]
        self._owners = 0
        for owner, _ in self._pieces:
            self._owners |= owner
        self._last = b""

    def take(self, head: bytes, held: int) -> bytes | None:
        """Return the next sample; None where the first one would show half a cycle."""
        if self._owners & held:
            if not self._last:
                return None
            data = b"".join([head, *self._kept(held)])
        else:
            self._parts[0] = head
            data = b"".join(self._parts)
        self._last = data
        return data

    def _kept(self, held: int) -> list[bytes | memoryview]:
        """Return the pieces, those of held classes as in the last sample."""
        at = _HEAD.size
        parts: list[bytes | memoryview] = []
        for owner, view in self._pieces:
            parts.append(self._last[at : at + len(view)] if owner & held else view)
            at += len(view)
        return parts


class Sampler:
    """Serves the requests of one service.

    Args:
        memory: where the variables lie.
        owners: of the variables.
        stream: takes the samples.

    Attributes:
        follows: figures that the service asks for beside samples.
    """

    def __init__(self, memory: Memory, owners: Owners, stream: StreamWriter) -> None:
        self._memory = memory
        self._owners = owners
        self._stream = stream
        self._requests: dict[int, _Request] = {}
        self.follows = Follow()

    def __len__(self) -> int:
        return len(self._requests)

    @property
    def stream(self) -> StreamWriter:
        """What the service reads."""
        return self._stream

    def start(self, request: SampleCommand) -> bool:
        """Serve a request from now on; False where there are too many.

        Raises:
            PageFault: a variable does not lie in PLC memory.
        """
        for address, size in request.spans:
            if not size:
                raise PageFault(address, size)
            self._memory.check(address, size)
        if request.number not in self._requests and len(self._requests) >= MOST:
            return False
        self._requests[request.number] = _Request(request, self._memory, self._owners)
        return True

    def cancel(self, number: int) -> None:
        """End a request, 0 for all, and what is followed."""
        if number:
            self._requests.pop(number, None)
        else:
            self._requests.clear()
            self.follows = Follow()

    def publish(self, task_class: TaskClass, held: int, release_ns: int, time_ns: int) -> None:
        """Take the samples that are due.

        Args:
            task_class: that publishes.
            held: classes in the middle of a cycle, as bits of owners.
            release_ns: of the cycle.
            time_ns: the same since the start of the controller.
        """
        for request in self._requests.values():
            if request.task_class not in (0, task_class.number) or release_ns < request.due_ns:
                continue
            head = _HEAD.pack(request.number, task_class.number, task_class.cycles)
            data = request.take(head, held)
            if data is not None:
                self._stream.write(_KIND, time_ns, data)
                request.due_ns = release_ns + request.period_ns
