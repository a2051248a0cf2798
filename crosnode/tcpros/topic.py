"""The two ends of a topic connection.

The publisher listens. It refuses a header without callerid, topic or md5sum, and a wrong md5sum; a
wrong or missing type it accepts, as rospy and roscpp do. What a subscriber sends after its header
is thrown away.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from crosnode.tcpros.connection import (
    ClientConnection,
    MessagesReceived,
    ServerConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.reader import LARGE, length_of
from crosnode.transport.budget import MESSAGE_WORK
from crosnode.transport.connection import Closed, ConnectionEvent, ConnectionState, Table, Trigger

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable

PUBLISHER: Final[Table] = {
    ConnectionState.HANDSHAKE: {
        Trigger.HEADER: ConnectionState.DECISION,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.DECISION: {
        Trigger.ACCEPT: ConnectionState.STREAMING,
        Trigger.REFUSE: ConnectionState.CLOSED,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.STREAMING: {
        Trigger.MESSAGE: ConnectionState.STREAMING,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.CLOSED: {},
}

SUBSCRIBER: Final[Table] = {
    ConnectionState.HANDSHAKE: {
        Trigger.HEADER: ConnectionState.STREAMING,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.STREAMING: {
        Trigger.MESSAGE: ConnectionState.STREAMING,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.CLOSED: {},
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
        self._move(Trigger.ACCEPT)
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

    def send_messages(self, bodies: Iterable[bytes | memoryview]) -> None:
        """Send messages; a large one must not change until it is written, small ones are joined."""
        self._move(Trigger.MESSAGE)
        joined: list[bytes | memoryview] = []
        for body in bodies:
            joined.append(length_of(body))
            if len(body) >= LARGE:
                self.outbox += (b"".join(joined), body)
                joined.clear()
            else:
                joined.append(body)
        if joined:
            self.outbox.append(b"".join(joined))

    def _parse(self) -> Generator[ConnectionEvent | None, None, None]:
        yield (yield from self._read_offer())
        while (yield from self._reader.more()):
            self._reader.clear()
        self.close()
        yield Closed()


class SubscriberConnection(ClientConnection):
    """A subscriber's end. Events: HeaderReceived or Refused, MessagesReceived, Closed or Failed.

    Args:
        topic: resolved name of the topic.
        type_info: the type expected; name and md5sum ``*`` take any.
        caller_id: name of the node.
        tcp_nodelay: ask the publisher to send at once.
        limits: see ``TcprosLimits``.
        now_ns: time of the step.
    """

    TABLE: ClassVar[Table] = SUBSCRIBER
    MESSAGE_PRICE: ClassVar[int] = MESSAGE_WORK

    def __init__(
        self,
        topic: str,
        type_info: TypeInfo,
        caller_id: str,
        *,
        tcp_nodelay: bool,
        limits: TcprosLimits,
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

    def _parse(self) -> Generator[ConnectionEvent | None, None, None]:
        yield (yield from self._read_answer(self._md5sum))
        while (yield from self._reader.more_blocks()):
            # No name for it here: its memory may be used again when the owner has let it go.
            yield (yield from self._read_messages())
        self.close()
        yield Closed()

    def _read_messages(self) -> Generator[None, None, MessagesReceived]:
        bodies: list[bytes | memoryview] = []
        self._reader.take_blocks(bodies, self.most, self.limits.max_message)
        if not bodies:
            bodies.append((yield from self._read_message()))
        self._move(Trigger.MESSAGE)
        return MessagesReceived(bodies)
