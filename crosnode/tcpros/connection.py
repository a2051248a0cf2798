"""What all TCPROS roles share: the header first, events parsed from bytes after it."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple

from crosnode.errors import TcprosError
from crosnode.tcpros.header import decode_header, encode_header, missing_field, sums_agree
from crosnode.tcpros.reader import ByteReader
from crosnode.transport.budget import HEADER_WORK, REQUEST_WORK
from crosnode.transport.connection import (
    ConnectionEvent,
    ConnectionState,
    Failed,
    ProtocolConnection,
    Trigger,
)

if TYPE_CHECKING:
    from collections.abc import Generator, Mapping, Sequence

MIB: Final = 1 << 20


class TcprosLimits(NamedTuple):
    """What one connection may take.

    Attributes:
        max_header: bytes of a connection header.
        max_message: bytes of a message, a request or a reply.
        timeout_ns: nanoseconds a peer may take for its header, and for its part of a call.
    """

    max_header: int = 1 << 17
    max_message: int = 64 * MIB
    timeout_ns: int = 10_000_000_000


class TypeInfo(NamedTuple):
    """What a header says of a type: ``pkg/Name``, md5sum, full text; ``*`` for any type."""

    name: str
    md5sum: str
    definition: str = ""


@dataclass(frozen=True, slots=True)
class HeaderReceived(ConnectionEvent):
    """The header of the peer, unknown fields included."""

    fields: dict[str, str]


@dataclass(frozen=True, slots=True)
class MessagesReceived(ConnectionEvent):
    """Messages of a topic, at least one; a body may be empty."""

    bodies: Sequence[bytes | memoryview]

    @property
    def count(self) -> int:
        """Each message has its price."""
        return len(self.bodies)


@dataclass(frozen=True, slots=True)
class RequestReceived(ConnectionEvent):
    """A request to a service; ``body`` may be empty."""

    body: bytes | memoryview


@dataclass(frozen=True, slots=True)
class ReplyReceived(ConnectionEvent):
    """The reply of a service: a response where ``ok``, else the text of an error."""

    ok: bool
    body: bytes | memoryview


@dataclass(frozen=True, slots=True)
class Refused(ConnectionEvent):
    """The peer answered our header with ``error``."""

    error: str


class TcprosConnection(ProtocolConnection):
    """One end of a TCPROS connection.

    Args:
        limits: see ``TcprosLimits``.
        now_ns: time of the step in which the connection was made.
    """

    IS_PARSED: ClassVar[bool] = False
    MESSAGE_PRICE: ClassVar[int] = REQUEST_WORK
    """What each event behind the header costs of the work of a step."""

    PAUSED: ClassVar[frozenset[ConnectionState]] = frozenset(
        {ConnectionState.DECISION, ConnectionState.CLOSED}
    )
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset({ConnectionState.HANDSHAKE})

    def __init__(self, limits: TcprosLimits, now_ns: int) -> None:
        super().__init__(ConnectionState.HANDSHAKE, limits.timeout_ns, now_ns)
        self.limits = limits
        self.header: dict[str, str] = {}
        self._reader = ByteReader()
        self._parser = self._parse()

    def event_price(self, now_ns: int) -> int:
        """A header is the price of a new connection."""
        is_new = self.state is ConnectionState.HANDSHAKE
        return HEADER_WORK if is_new else self.MESSAGE_PRICE

    def receive_data(self, data: bytes | bytearray | memoryview) -> None:
        """Take received bytes; then call ``next_event`` until it gives None."""
        if self.state is not ConnectionState.CLOSED:
            self._reader.feed(data)
            self._is_drained = False

    @property
    def next_read(self) -> int:
        """Little behind a large message: the next one may be large as well."""
        return self._reader.next_read

    @property
    def room(self) -> memoryview | None:
        """Where the rest of a large message goes."""
        return self._reader.room

    @property
    def is_room_fresh(self) -> bool:
        """Whether its pages are laid out as they are filled."""
        return self._reader.is_room_fresh

    def filled(self, size: int) -> None:
        """Note bytes of a large message."""
        self._reader.filled(size)
        self._is_drained = False

    def handle_timer(self, now_ns: int) -> Failed | None:
        """As in ``ProtocolConnection``; what large messages have left is given back by and by."""
        self._reader.give_back(now_ns)
        return super().handle_timer(now_ns)

    def receive_eof(self) -> None:
        """Take the end of the stream; then call ``next_event`` as for bytes."""
        self._reader.feed_eof()

    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        """Return the next event, None where none can be had from the bytes so far."""
        if self.state in self.PAUSED:
            return None
        before = self.state
        try:
            event = next(self._parser)
        except TcprosError as error:
            return self._fail(str(error))
        if self.state is not before:
            self._since_ns = now_ns
        self._is_drained = event is None or self._reader.is_idle
        return event

    def close(self) -> None:
        """End the connection from this side."""
        super().close()
        self._reader.clear()

    @abstractmethod
    def _parse(self) -> Generator[ConnectionEvent | None, None, None]:
        """Turn bytes into events; yield None where bytes are missing."""

    def _read_header(self) -> Generator[None, None, dict[str, str]]:
        body = yield from self._reader.block(self.limits.max_header, "header")
        self.header = decode_header(body)
        return self.header

    def _read_message(self) -> Generator[None, None, bytes | memoryview]:
        return (yield from self._reader.large_block(self.limits.max_message, "message"))

    def _send_header(self, fields: Mapping[str, str]) -> None:
        self.outbox.append(encode_header(fields))


class ClientConnection(TcprosConnection):
    """The end that connects: its header is sent at once, and the answer read."""

    def __init__(self, fields: Mapping[str, str], limits: TcprosLimits, now_ns: int) -> None:
        super().__init__(limits, now_ns)
        self._send_header(fields)

    def _read_answer(
        self, md5sum: str, trigger: Trigger = Trigger.HEADER
    ) -> Generator[None, None, HeaderReceived | Refused]:
        fields = yield from self._read_header()
        if "error" in fields:
            self.close()
            return Refused(fields["error"])
        if not sums_agree(md5sum, fields.get("md5sum", md5sum)):
            raise TcprosError(f"md5sum {fields['md5sum']} answers our {md5sum}")
        self._move(trigger)
        return HeaderReceived(fields)


class ServerConnection(TcprosConnection):
    """The end that was connected to: it reads a header, then accepts or refuses."""

    REQUIRED: ClassVar[tuple[str, ...]]

    def refuse(self, reason: str) -> None:
        """Answer the header with ``error`` and end the connection."""
        self._move(Trigger.REFUSE)
        self._send_header({"error": reason})

    def _fail(self, reason: str) -> Failed:
        if self.state is ConnectionState.HANDSHAKE:
            self._send_header({"error": reason})
        return super()._fail(reason)

    def _fault(self, md5sum: str) -> str | None:
        """Return the reason to refuse the peer's header, None where it fits."""
        missing = missing_field(self.header, self.REQUIRED)
        if missing or sums_agree(md5sum, self.header["md5sum"]):
            return missing
        return f"md5sum {self.header['md5sum']} does not match {md5sum}"

    def _read_offer(self) -> Generator[None, None, HeaderReceived]:
        fields = yield from self._read_header()
        self._move(Trigger.HEADER)
        return HeaderReceived(fields)
