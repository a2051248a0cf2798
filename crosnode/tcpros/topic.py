"""The two ends of a topic connection.

The publisher listens. It refuses a header without callerid, topic or md5sum, and a wrong md5sum; a
wrong or missing type it accepts, as rospy and roscpp do. What a subscriber sends after its header
is thrown away.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from crosnode.tcpros.connection import (
    ClientConnection,
    Event,
    Limits,
    MessageReceived,
    ServerConnection,
    TypeInfo,
)
from crosnode.tcpros.reader import length_of
from crosnode.transport.connection import Act, Closed, State, Table

if TYPE_CHECKING:
    from collections.abc import Generator

PUBLISHER: Final[Table] = {
    State.HANDSHAKE: {Act.HEADER: State.DECISION, Act.END: State.CLOSED},
    State.DECISION: {
        Act.ACCEPT: State.STREAMING,
        Act.REFUSE: State.CLOSED,
        Act.END: State.CLOSED,
    },
    State.STREAMING: {Act.MESSAGE: State.STREAMING, Act.END: State.CLOSED},
    State.CLOSED: {},
}

SUBSCRIBER: Final[Table] = {
    State.HANDSHAKE: {Act.HEADER: State.STREAMING, Act.END: State.CLOSED},
    State.STREAMING: {Act.MESSAGE: State.STREAMING, Act.END: State.CLOSED},
    State.CLOSED: {},
}


class PublisherConnection(ServerConnection):
    """A publisher's end. Events: HeaderReceived, then Closed or Failed.

    After HeaderReceived the owner calls ``accept`` with the topic it names, or ``refuse``.
    """

    TABLE: ClassVar[Table] = PUBLISHER
    REQUIRED: ClassVar[tuple[str, ...]] = ("callerid", "topic", "md5sum")

    def accept(self, type_info: TypeInfo, caller_id: str, *, latching: bool = False) -> bool:
        """Answer the header; a subscriber that does not fit is refused and False returned."""
        if fault := self._fault(type_info.md5sum):
            self.refuse(fault)
            return False
        self._move(Act.ACCEPT)
        self._send_header(
            {
                "callerid": caller_id,
                "latching": str(int(latching)),
                "md5sum": type_info.md5sum,
                "message_definition": type_info.definition,
                "topic": self.header["topic"],
                "type": type_info.name,
            }
        )
        return True

    def send_message(self, body: bytes | memoryview) -> None:
        """Send a message; ``body`` must not change until it is written."""
        self._move(Act.MESSAGE)
        self._outbox += (length_of(body), body)

    def _parse(self) -> Generator[Event | None, None, None]:
        yield (yield from self._read_offer())
        while (yield from self._reader.more()):
            self._reader.clear()
        self.close()
        yield Closed()


class SubscriberConnection(ClientConnection):
    """A subscriber's end. Events: HeaderReceived or Refused, MessageReceived, Closed or Failed.

    Args:
        topic: resolved name of the topic.
        type_info: the type expected; name and md5sum ``*`` take any.
        caller_id: name of the node.
        tcp_nodelay: ask the publisher to send at once.
        limits: see ``Limits``.
        now_ns: time of the step.
    """

    TABLE: ClassVar[Table] = SUBSCRIBER

    def __init__(
        self,
        topic: str,
        type_info: TypeInfo,
        caller_id: str,
        *,
        tcp_nodelay: bool,
        limits: Limits,
        now_ns: int,
    ) -> None:
        self._md5sum = type_info.md5sum
        fields = {
            "callerid": caller_id,
            "md5sum": type_info.md5sum,
            "message_definition": type_info.definition,
            "tcp_nodelay": str(int(tcp_nodelay)),
            "topic": topic,
            "type": type_info.name,
        }
        super().__init__(fields, limits, now_ns)

    def _parse(self) -> Generator[Event | None, None, None]:
        yield (yield from self._read_answer(self._md5sum))
        while (yield from self._reader.more()):
            body = yield from self._read_message()
            self._move(Act.MESSAGE)
            yield MessageReceived(body)
        self.close()
        yield Closed()
