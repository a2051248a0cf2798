"""The two ends of a service connection.

The server listens. A client with ``probe=1`` only wants the header; without ``persistent=1`` the
connection ends after one call. A reply is a byte that says whether the call went well, then the
response or the text of an error, behind its length.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from crosnode.errors import TcprosError
from crosnode.tcpros.connection import (
    ClientConnection,
    ReplyReceived,
    RequestReceived,
    ServerConnection,
    TcprosLimits,
    TypeInfo,
)
from crosnode.tcpros.reader import length_of
from crosnode.transport.connection import Closed, ConnectionEvent, ConnectionState, Table, Trigger

if TYPE_CHECKING:
    from collections.abc import Generator

SERVER: Final[Table] = {
    ConnectionState.HANDSHAKE: {
        Trigger.HEADER: ConnectionState.DECISION,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.DECISION: {
        Trigger.ACCEPT: ConnectionState.REQUEST,
        Trigger.LAST: ConnectionState.CLOSED,
        Trigger.REFUSE: ConnectionState.CLOSED,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.REQUEST: {
        Trigger.REQUEST: ConnectionState.REPLY,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.REPLY: {
        Trigger.REPLY: ConnectionState.REQUEST,
        Trigger.LAST: ConnectionState.CLOSED,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.CLOSED: {},
}

CLIENT: Final[Table] = {
    ConnectionState.HANDSHAKE: {
        Trigger.HEADER: ConnectionState.IDLE,
        Trigger.LAST: ConnectionState.CLOSED,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.IDLE: {
        Trigger.REQUEST: ConnectionState.REPLY,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.REPLY: {
        Trigger.REPLY: ConnectionState.IDLE,
        Trigger.LAST: ConnectionState.CLOSED,
        Trigger.END: ConnectionState.CLOSED,
    },
    ConnectionState.CLOSED: {},
}


class ServiceServerConnection(ServerConnection):
    """A provider's end. Events: HeaderReceived, RequestReceived, Closed or Failed.

    After HeaderReceived the owner calls ``accept`` with the service it names, or ``refuse``; after
    RequestReceived ``send_response`` or ``send_error``, in the same step or in a later one.
    """

    TABLE: ClassVar[Table] = SERVER
    PAUSED: ClassVar[frozenset[ConnectionState]] = ServerConnection.PAUSED | {ConnectionState.REPLY}
    REQUIRED: ClassVar[tuple[str, ...]] = ("callerid", "service", "md5sum")

    @property
    def deadline_ns(self) -> int | None:
        """As in ``ProtocolConnection``; a client that is not persistent must also ask in time."""
        if self.state is ConnectionState.REQUEST and not self.is_persistent:
            return self._since_ns + self.limits.timeout_ns
        return super().deadline_ns

    @property
    def is_persistent(self) -> bool:
        """True where the client wants more than one call."""
        return self.header.get("persistent", "").lower() in ("1", "true")  # as rospy and roscpp

    def accept(self, type_info: TypeInfo, caller_id: str) -> bool:
        """Answer the header; a client that does not fit is refused and False returned."""
        if fault := self._fault(type_info.md5sum):
            self.refuse(fault)
            return False
        self._move(Trigger.LAST if self.header.get("probe") == "1" else Trigger.ACCEPT)
        self._send_header(
            {
                "callerid": caller_id,
                "md5sum": type_info.md5sum,
                "request_type": type_info.name + "Request",
                "response_type": type_info.name + "Response",
                "type": type_info.name,
            }
        )
        return True

    def send_response(self, body: bytes | memoryview) -> None:
        """Send the response of a call that went well."""
        self._reply(b"\x01", body)

    def send_error(self, reason: str) -> None:
        """Say why a call went wrong; a persistent connection goes on."""
        self._reply(b"\x00", reason.encode(errors="replace"))

    def _reply(self, ok: bytes, body: bytes | memoryview) -> None:
        self._move(Trigger.REPLY if self.is_persistent else Trigger.LAST)
        self.outbox += (ok + length_of(body), body)

    def _parse(self) -> Generator[ConnectionEvent | None, None, None]:
        yield (yield from self._read_offer())
        while (yield from self._reader.more()):
            body = yield from self._read_message()
            self._move(Trigger.REQUEST)
            yield RequestReceived(body)
        self.close()
        yield Closed()


class ServiceClientConnection(ClientConnection):
    """A caller's end. Events: HeaderReceived or Refused, ReplyReceived, Closed or Failed.

    Args:
        service: resolved name of the service.
        type_info: the type expected; md5sum ``*`` takes any.
        caller_id: name of the node.
        persistent: keep the connection for more than one call.
        probe: only fetch the header of the service.
        limits: see ``TcprosLimits``; its time limit also holds for each reply.
        now_ns: time of the step.
    """

    TABLE: ClassVar[Table] = CLIENT
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset(
        {ConnectionState.HANDSHAKE, ConnectionState.REPLY}
    )

    def __init__(
        self,
        service: str,
        type_info: TypeInfo,
        caller_id: str,
        *,
        persistent: bool = False,
        probe: bool = False,
        limits: TcprosLimits,
        now_ns: int,
    ) -> None:
        self._md5sum = type_info.md5sum
        self._persistent = persistent
        self._probe = probe
        fields = {
            "callerid": caller_id,
            "md5sum": type_info.md5sum,
            "service": service,
            "type": type_info.name,
        }
        fields |= {"persistent": "1"} if persistent else {}
        fields |= {"probe": "1"} if probe else {}
        super().__init__(fields, limits, now_ns)

    def send_request(self, body: bytes | memoryview, now_ns: int) -> None:
        """Call the service; the reply must come within the time limit."""
        self._move(Trigger.REQUEST)
        self._since_ns = now_ns
        self.outbox += (length_of(body), body)

    def _parse(self) -> Generator[ConnectionEvent | None, None, None]:
        trigger = Trigger.LAST if self._probe else Trigger.HEADER
        yield (yield from self._read_answer(self._md5sum, trigger))
        while (yield from self._reader.more()):
            if self.state is not ConnectionState.REPLY:
                raise TcprosError("bytes without a request")
            ok = yield from self._reader.exactly(1)
            body = yield from self._read_message()
            self._move(Trigger.REPLY if self._persistent else Trigger.LAST)
            yield ReplyReceived(ok != b"\x00", body)
        self.close()
        yield Closed()
