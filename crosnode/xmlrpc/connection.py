"""The two ends of an XML-RPC connection over HTTP/1.1, kept alive between calls; HTTP by h11."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple, TypeAlias

import h11

from crosnode.errors import LimitError, LocalProtocolError, MessageValueError, XmlRpcError
from crosnode.transport.budget import (
    ALONE_WORK,
    ANSWER_WORK,
    ANSWERED_WORK,
    COLD_PART_WORK,
    PART_WORK,
)
from crosnode.transport.connection import (
    Closed,
    ConnectionEvent,
    ConnectionState,
    Failed,
    Progress,
    ProtocolConnection,
    Table,
    Trigger,
)
from crosnode.xmlrpc.host_field import HostField
from crosnode.xmlrpc.values import (
    MethodCall,
    MethodFault,
    MethodResponse,
    Value,
    ValueLimits,
    ValueParser,
)
from crosnode.xmlrpc.writer import ResponseWriter, dump_call, dump_fault

if TYPE_CHECKING:
    from collections.abc import Sequence

SERVER: Final[Table] = {
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

PARSE_ERROR: Final = -32700
"""Fault code for a document that cannot be read (xmlrpc-epi, fault code interoperability)."""

INTERNAL_ERROR: Final = -32603

WARM_NS: Final = 20_000_000
"""Nanoseconds that code stays in the caches, about: what runs once a second is read from memory
anew, and takes many times as long as what follows its like."""

Document: TypeAlias = MethodCall | MethodResponse | MethodFault
Role: TypeAlias = type[h11.CLIENT] | type[h11.SERVER]

_CONTENT_TYPE: Final = ("Content-Type", "text/xml")


class XmlRpcLimits(NamedTuple):
    """What one connection may take.

    Attributes:
        values: size and shape of a document.
        max_head: bytes of the HTTP request or status line and headers.
        timeout_ns: nanoseconds a peer may take for a request, or a server for its reply.
        idle_ns: nanoseconds that a caller may stay connected without a further request. Callers
            that keep their connection, such as roscpp, make another one then.
    """

    values: ValueLimits = ValueLimits()
    max_head: int = 16384
    timeout_ns: int = 10_000_000_000
    idle_ns: int = 60_000_000_000


@dataclass(frozen=True, slots=True)
class CallReceived(ConnectionEvent):
    """A peer calls a method."""

    method: str
    params: list[Value]


@dataclass(frozen=True, slots=True)
class ResponseReceived(ConnectionEvent):
    """The answer of a server."""

    value: Value


@dataclass(frozen=True, slots=True)
class FaultReceived(ConnectionEvent):
    """The server answers with a fault."""

    code: int
    text: str


@dataclass(frozen=True, slots=True)
class Unreadable(Failed):
    """The server answers with what is no document, or one beyond the limits."""


@lru_cache(maxsize=64)
def _request(host: str, size: int) -> h11.Request:
    """Return the head of a call with a document of ``size`` bytes.

    It is kept, for a node says the same to its master every second, and making it is half of that.
    """
    headers = [("Host", host), _CONTENT_TYPE, ("Content-Length", str(size))]
    return h11.Request(method="POST", target="/RPC2", headers=headers)


@lru_cache(maxsize=64)
def _response(status: int, size: int, headers: tuple[tuple[str, str], ...]) -> h11.Response:
    """Return the head of an answer with a document of ``size`` bytes; it is kept as well."""
    length = ("Content-Length", str(size))
    return h11.Response(status_code=status, headers=[_CONTENT_TYPE, length, *headers])


class _Part(Enum):
    """What of a document was taken."""

    NOTHING = auto()
    BEGUN = auto()
    """It has bytes, or its HTTP head is read."""
    XML = auto()
    """Some of it, at least."""


class LastUse:
    """When documents were last read, or written, by any of the connections that share it."""

    def __init__(self) -> None:
        self._at_ns: int | None = None

    def is_long_ago(self, now_ns: int) -> bool:
        """Return whether the last use is too long ago for warm caches, or there was none."""
        return self._at_ns is None or now_ns - self._at_ns > WARM_NS

    def note(self, now_ns: int) -> bool:
        """Note a use; return whether the one before is too long ago."""
        is_long_ago, self._at_ns = self.is_long_ago(now_ns), now_ns
        return is_long_ago


class XmlRpcConnection(ProtocolConnection):
    """What both ends share; see ``ProtocolConnection`` for its use.

    Args:
        role: h11.CLIENT or h11.SERVER.
        state: the first state.
        limits: see ``XmlRpcLimits``.
        now_ns: time of the step in which the connection was made.
        last_use: of the connections of one kind that a node has; None for a single one.

    Attributes:
        is_beyond_limits: whether it ended because a document was larger or deeper than we accept.
        is_last_call: whether one end has said that no call follows the one that ended.
    """

    IS_PARSED: ClassVar[bool] = True
    END_PRICE: ClassVar[int]
    """What it costs to take a document of which all is read."""

    def __init__(
        self,
        role: Role,
        state: ConnectionState,
        limits: XmlRpcLimits,
        now_ns: int,
        last_use: LastUse | None,
    ) -> None:
        super().__init__(state, limits.timeout_ns, now_ns)
        self.limits = limits
        self._http = h11.Connection(role, max_incomplete_event_size=limits.max_head)
        self._values = ValueParser(limits.values)
        self._unparsed = b""
        self._last_use = last_use or LastUse()
        self._part = _Part.NOTHING
        self._is_cold = False
        self.is_beyond_limits = False
        self.is_last_call = False

    def event_price(self, now_ns: int) -> int:
        """A part of a document that is read, or what follows of it."""
        if self._part is _Part.NOTHING:
            return COLD_PART_WORK if self._last_use.is_long_ago(now_ns) else PART_WORK
        if self._part is _Part.XML and not self._unparsed:
            return self.END_PRICE
        return ALONE_WORK if self._is_cold else PART_WORK

    def receive_data(self, data: bytes | bytearray | memoryview) -> None:
        """Take received bytes; then call ``next_event`` until it gives None."""
        if data and self.state is not ConnectionState.CLOSED:
            self._receive(bytes(data))
            self._is_drained = False

    def receive_eof(self) -> None:
        """Take the end of the stream; then call ``next_event`` as for bytes."""
        if self.state is not ConnectionState.CLOSED:
            self._receive(b"")

    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        """Return the next event, None where none can be had from the bytes so far."""
        if self.state in self.PAUSED:
            return None
        event = self._next_event(now_ns)
        self._is_drained = event is None
        return event

    def _receive(self, data: bytes) -> None:
        try:
            self._http.receive_data(data)
        except RuntimeError as error:  # bytes behind the end of the stream
            raise LocalProtocolError(str(error)) from error

    def _next_event(self, now_ns: int) -> ConnectionEvent | None:
        """Do what the next HTTP events say, until one of ours comes of them, or a part is done."""
        try:
            while True:
                if self._unparsed:
                    self._unparsed = self._values.feed_part(self._unparsed)
                    self._part = _Part.XML
                    if self._unparsed or self._is_cold:
                        self._since_ns = now_ns
                    return Progress()
                self._begin(now_ns)
                http_event = self._http.next_event()
                if http_event in (h11.NEED_DATA, h11.PAUSED):
                    return None
                if event := self._handle(http_event, now_ns):
                    return event
        except h11.RemoteProtocolError as error:
            return self._refuse(f"not HTTP: {error}", http_status=error.error_status_hint)
        except XmlRpcError as error:
            self.is_beyond_limits = isinstance(error, LimitError)
            return self._refuse(str(error), http_status=200)

    def _begin(self, now_ns: int) -> None:
        """Note that a document begins, where one does, and whether its like was long ago."""
        if self._part is _Part.NOTHING and self._http.trailing_data[0]:
            self._part = _Part.BEGUN
            self._is_cold = self._last_use.note(now_ns)

    def _handle(self, http_event: object, now_ns: int) -> ConnectionEvent | None:
        if isinstance(http_event, h11.Data):
            self._unparsed = bytes(http_event.data)
            return None
        if isinstance(http_event, h11.EndOfMessage):
            self._part, self._is_cold = _Part.NOTHING, False
            document = self._values.close()
            self._values = ValueParser(self.limits.values)
            return self._document(document, now_ns)
        if isinstance(http_event, h11.ConnectionClosed):
            self.close()
            return Closed()
        self._head(http_event)
        self._since_ns = now_ns
        return Progress()

    def _head(self, http_event: object) -> None:
        """Check a request or status line."""
        raise NotImplementedError

    def _document(self, document: Document, now_ns: int) -> ConnectionEvent:
        """Make an event of a document and move on."""
        raise NotImplementedError

    def _refuse(self, reason: str, *, http_status: int) -> Failed:
        """End the connection; a server says why, with the HTTP status."""
        return self._fail(reason)

    def _end_call(self) -> None:
        """Make ready for the next call, where both ends keep the connection alive."""
        if self._http.our_state is h11.DONE and self._http.their_state is h11.DONE:
            self._http.start_next_cycle()
            self._move(Trigger.REPLY)
        else:
            self.is_last_call = True
            self._move(Trigger.LAST)

    def _send(self, *http_events: h11.Event) -> None:
        for http_event in http_events:
            if data := self._http.send(http_event):
                self.outbox.append(data)


class XmlRpcServerConnection(XmlRpcConnection):
    """The end that is called. Events: CallReceived, Closed or Failed.

    After CallReceived the owner calls ``respond`` or ``fault``, in the same step or a later one. A
    request that cannot be read is answered with a fault or an HTTP status, and ends the connection.
    A new connection must ask in time, one that has asked before may be idle for longer.
    """

    TABLE: ClassVar[Table] = SERVER
    END_PRICE: ClassVar[int] = ANSWER_WORK
    PAUSED: ClassVar[frozenset[ConnectionState]] = frozenset(
        {ConnectionState.REPLY, ConnectionState.CLOSED}
    )
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset({ConnectionState.REQUEST})

    def __init__(self, limits: XmlRpcLimits, now_ns: int, last_use: LastUse | None = None) -> None:
        super().__init__(h11.SERVER, ConnectionState.REQUEST, limits, now_ns, last_use)
        self._is_idle = False
        self._host_field = HostField()
        self._writer: ResponseWriter | None = None

    def event_price(self, now_ns: int) -> int:
        """As in ``XmlRpcConnection``; a part of a long answer costs what a short one does."""
        return ANSWER_WORK if self._writer else super().event_price(now_ns)

    @property
    def deadline_ns(self) -> int | None:
        """As in ``ProtocolConnection``; later between two calls."""
        return self._since_ns + self.limits.idle_ns if self._is_idle else super().deadline_ns

    @property
    def idle_since_ns(self) -> int | None:
        """Since the last call, or the connection, where no byte of another has come."""
        is_asked = self.state is not ConnectionState.REQUEST or self._is_within_request
        return None if is_asked else self._since_ns

    def handle_timer(self, now_ns: int) -> Failed | None:
        """End the connection where its deadline has passed; an idle one just ends."""
        if self._is_idle and now_ns >= self._since_ns + self.limits.idle_ns:
            self.close()
            return None
        return super().handle_timer(now_ns)

    def _receive(self, data: bytes) -> None:
        completed = self._host_field.complete(data)
        if completed or not data:  # no bytes are the end of the stream
            super()._receive(completed)

    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        """Return the next event, None where none can be had from the bytes so far."""
        if self._writer is not None and self.state is ConnectionState.REPLY:
            self._write_late(self._writer)
            return Progress()
        event = super().next_event(now_ns)
        if event is None and self._is_idle and self._is_within_request:
            self._is_idle, self._since_ns = False, now_ns
        return event

    @property
    def _is_within_request(self) -> bool:
        """True from the first byte of a request on."""
        return self._http.their_state is not h11.IDLE or bool(self._http.trailing_data[0])

    def respond(self, value: Value) -> None:
        """Answer the call with a value; a long one is written while ``next_event`` is called.

        Raises:
            MessageValueError: XML-RPC cannot carry it, as seen in its first part; the call is
                still to be answered. Seen later, it is answered with a fault.
        """
        self._check_turn()
        writer = ResponseWriter(value)
        document = writer.write()
        if document is None:
            self._writer = writer
        else:
            self._answer(document)

    def _write_late(self, writer: ResponseWriter) -> None:
        try:
            document = writer.write()
        except MessageValueError as error:
            document = dump_fault(MethodFault(INTERNAL_ERROR, str(error)))
        if document is not None:
            self._answer(document)

    def fault(self, code: int, text: str) -> None:
        """Answer the call with a fault."""
        self._check_turn()
        self._answer(dump_fault(MethodFault(code, text)))

    def _check_turn(self) -> None:
        if self.state is not ConnectionState.REPLY or self._writer is not None:
            raise LocalProtocolError(f"an answer in state {self.state.name}")

    def _answer(self, document: bytes) -> None:
        self._writer = None
        self._send_document(document, 200)
        self._end_call()
        if not self._http.trailing_data[0]:
            self._host_field.begin()
        self._is_idle = True

    def _send_document(self, document: bytes, status: int, *headers: tuple[str, str]) -> None:
        response = _response(status, len(document), headers)
        self._send(response, h11.Data(data=document), h11.EndOfMessage())

    def _head(self, http_event: object) -> None:
        assert isinstance(http_event, h11.Request)
        if http_event.method != b"POST":
            raise h11.RemoteProtocolError("only POST is served", error_status_hint=405)
        if self._http.they_are_waiting_for_100_continue:
            self._send(h11.InformationalResponse(status_code=100, headers=[]))

    def _document(self, document: Document, now_ns: int) -> ConnectionEvent:
        if not isinstance(document, MethodCall):
            raise XmlRpcError("a reply, where a call was expected")
        self._move(Trigger.REQUEST)
        self._since_ns = now_ns
        self._is_idle = False
        return CallReceived(document.method, document.params)

    def _refuse(self, reason: str, *, http_status: int) -> Failed:
        if self._http.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            document = dump_fault(MethodFault(PARSE_ERROR, reason))
            self._send_document(document, http_status, ("Connection", "close"))
        return self._fail(reason)


class XmlRpcClientConnection(XmlRpcConnection):
    """The end that calls. Events: ResponseReceived, FaultReceived, Closed, Unreadable or Failed.

    Args:
        host: what the ``Host`` header says: name or number, and port.
        limits: see ``XmlRpcLimits``.
        now_ns: time of the step.
        last_use: as of `XmlRpcConnection`.
    """

    TABLE: ClassVar[Table] = CLIENT
    END_PRICE: ClassVar[int] = ANSWERED_WORK
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset({ConnectionState.REPLY})

    def __init__(
        self, host: str, limits: XmlRpcLimits, now_ns: int, last_use: LastUse | None = None
    ) -> None:
        super().__init__(h11.CLIENT, ConnectionState.IDLE, limits, now_ns, last_use)
        self._host = host

    def call(self, method: str, params: Sequence[Value], now_ns: int) -> None:
        """Call a method; the reply must come within the time limit.

        Raises:
            MessageValueError: XML-RPC cannot carry a parameter; nothing is sent.
        """
        document = dump_call(method, tuple(params))
        self._move(Trigger.REQUEST)
        self._since_ns = now_ns
        request = _request(self._host, len(document))
        self._send(request, h11.Data(data=document), h11.EndOfMessage())

    def _head(self, http_event: object) -> None:
        if isinstance(http_event, h11.Response) and http_event.status_code != 200:
            raise XmlRpcError(f"HTTP status {http_event.status_code}")

    def _refuse(self, reason: str, *, http_status: int) -> Failed:
        if http_status == 200:  # HTTP was right, what it carried was not
            self.close()
            return Unreadable(reason)
        return self._fail(reason)

    def _document(self, document: Document, now_ns: int) -> ConnectionEvent:
        if isinstance(document, MethodCall):
            raise XmlRpcError("a call, where a reply was expected")
        self._end_call()
        self._since_ns = now_ns
        if isinstance(document, MethodFault):
            return FaultReceived(*document)
        return ResponseReceived(document.value)
