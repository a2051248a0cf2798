"""Values of the controller for reads and subscriptions, from snapshots of the shared image."""

from __future__ import annotations

import asyncio
import time
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Final

from asyncua import ua

from plcsim.core.system import State
from plcsim.shared_image import ImageError, ImageNotReady, ScanWatch

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from asyncua.server.address_space import AddressSpace

    from plcsim.opcua.service.values import VariableCodec
    from plcsim.shared_image import ImageReader

AT_ONCE: Final = 50
"""Changes that are handed over before the connections have their turn."""

_CODES: Final = ua.StatusCodes
_VALUE: Final = ua.AttributeIds.Value


class Readings:
    """What clients read.

    A read of several variables is answered from one snapshot; what a subscription reports as well.

    Args:
        image: the shared image.
        state: of the controller.
        codecs: of the variables, by node.
    """

    def __init__(
        self,
        image: ImageReader,
        state: Callable[[], int],
        codecs: Mapping[ua.NodeId, VariableCodec],
    ) -> None:
        self._image = image
        self._state = state
        self._watch = ScanWatch(image.directory.cycle_ns)
        self.codecs = codecs
        directory = image.directory
        self._spans = {
            node: (at, at + codec.leaf.tag.data_type.size)
            for node, codec in codecs.items()
            for at in [directory.offset_of(codec.leaf.tag.address, codec.leaf.tag.data_type.size)]
        }
        self._monitored: dict[ua.NodeId, tuple[int, bytes] | None] = {}

    def status(self) -> int:
        """Return the status code of a value that is read now.

        In SERVICE, and while the controller is stopped, values are those of the last cycle.
        """
        if self._state() in (State.SERVICE.value, State.STOPPED.value):
            return _CODES.UncertainLastUsableValue
        if not self._watch.is_alive(self._image.latest, time.monotonic_ns()):
            return _CODES.BadNoCommunication
        return _CODES.Good

    def read(self, nodes: Iterable[ua.NodeId]) -> dict[ua.NodeId, ua.DataValue]:
        """Return the values of variables, all of one cycle."""
        wanted = {node: self._spans[node] for node in nodes if node in self._spans}
        if not wanted:
            return {}
        low = min(start for start, _ in wanted.values())
        try:
            _, data = self._image.copy(low, max(end for _, end in wanted.values()))
        except ImageNotReady:
            return dict.fromkeys(wanted, _without_value(_CODES.BadWaitingForInitialData))
        except ImageError:
            return dict.fromkeys(wanted, _without_value(_CODES.BadNoCommunication))
        status, now = self.status(), datetime.now(UTC)
        return {
            node: self._value(node, data[start - low : end - low], status, now)
            for node, (start, end) in wanted.items()
        }

    def _value(self, node: ua.NodeId, data: bytes, status: int, now: datetime) -> ua.DataValue:
        return ua.DataValue(
            Value=self.codecs[node].variant(data),
            StatusCode=ua.StatusCode(status),
            SourceTimestamp=now,
            ServerTimestamp=now,
        )

    def current(self, node: ua.NodeId, _attribute: Any) -> ua.DataValue:
        """Return one value; asyncua's callback of a variable."""
        return self.read([node])[node]

    def monitor(self, nodes: Iterable[ua.NodeId]) -> None:
        """Look at variables from now on; those that nobody asks for any more are dropped."""
        for node in nodes:
            if node in self._spans:
                self._monitored.setdefault(node, None)

    async def report(self, space: AddressSpace) -> None:
        """Hand what has changed to the subscriptions; to be called once a sampling interval."""
        self._drop_unwatched(space)
        if not self._monitored:
            return
        low = min(self._spans[node][0] for node in self._monitored)
        try:
            _, data = self._image.copy(low, max(self._spans[n][1] for n in self._monitored))
        except ImageError:
            return
        status, now = self.status(), datetime.now(UTC)
        told = 0
        for node, before in list(self._monitored.items()):
            start, end = self._spans[node]
            seen = (status, data[start - low : end - low])
            if seen != before:
                self._monitored[node] = seen
                value = self._value(node, seen[1], status, now)
                for handle, tell in list(
                    space[node].attributes[_VALUE].datachange_callbacks.items()
                ):
                    await tell(handle, value)
                told += 1
                if told % AT_ONCE == 0:
                    await asyncio.sleep(0)

    def _drop_unwatched(self, space: AddressSpace) -> None:
        for node in list(self._monitored):
            if not space[node].attributes[_VALUE].datachange_callbacks:
                del self._monitored[node]


def _without_value(code: int) -> ua.DataValue:
    return ua.DataValue(StatusCode=ua.StatusCode(code))
