"""What all TCPROS roles share: states, acts, events, and the step from bytes to events.

A connection is a pure object. The owner hands it received bytes (``receive_data``), takes events
one by one (``next_event``) and writes what ``data_to_send`` gives; how many events it takes in a
step is its own bound. Each role has one table of transitions, and all of them go through it.

Rules: a peer that breaks the protocol gives a ``Failed`` event and the state CLOSED, never an
exception; this program using a connection out of turn raises ``LocalProtocolError``. In state
CLOSED the owner writes what is left to send, then closes the socket.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple, TypeAlias

from crosnode.errors import LocalProtocolError, TcprosError
from crosnode.tcpros.header import decode_header, encode_header, missing_field, sums_agree
from crosnode.tcpros.reader import ByteReader

if TYPE_CHECKING:
    from collections.abc import Generator, Mapping

MIB: Final = 1 << 20


class Limits(NamedTuple):
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


class State(Enum):
    """States of all roles; a role uses those in its table."""

    HANDSHAKE = auto()  # waiting for the header of the peer
    DECISION = auto()  # waiting for this program to accept or refuse
    STREAMING = auto()  # messages flow
    IDLE = auto()  # a client may send a request
    REQUEST = auto()  # a server waits for a request
    REPLY = auto()  # a call is running
    CLOSED = auto()


class Act(Enum):
    """What moves a connection from state to state."""

    HEADER = auto()
    ACCEPT = auto()
    REFUSE = auto()
    MESSAGE = auto()
    REQUEST = auto()
    REPLY = auto()
    LAST = auto()  # the only reply of a connection that is not persistent, or of a probe
    END = auto()  # the peer closed or broke the protocol, time ran out, or this program closes


@dataclass(frozen=True, slots=True)
class HeaderReceived:
    """The header of the peer, unknown fields included."""

    fields: dict[str, str]


@dataclass(frozen=True, slots=True)
class MessageReceived:
    """A message of a topic; ``body`` may be empty."""

    body: bytes


@dataclass(frozen=True, slots=True)
class RequestReceived:
    """A request to a service; ``body`` may be empty."""

    body: bytes


@dataclass(frozen=True, slots=True)
class ReplyReceived:
    """The reply of a service: a response where ``ok``, else the text of an error."""

    ok: bool
    body: bytes


@dataclass(frozen=True, slots=True)
class Refused:
    """The peer answered our header with ``error``."""

    error: str


@dataclass(frozen=True, slots=True)
class Failed:
    """The connection is over because the peer broke the protocol or a time limit."""

    reason: str


@dataclass(frozen=True, slots=True)
class Closed:
    """The peer closed between two messages."""


Event: TypeAlias = (
    HeaderReceived | MessageReceived | RequestReceived | ReplyReceived | Refused | Failed | Closed
)
Table: TypeAlias = "Mapping[State, Mapping[Act, State]]"


class Connection(ABC):
    """One end of a TCPROS connection.

    Args:
        limits: see ``Limits``.
        now_ns: time of the step in which the connection was made.
    """

    TABLE: ClassVar[Table]
    PAUSED: ClassVar[frozenset[State]] = frozenset({State.DECISION, State.CLOSED})
    TIMED: ClassVar[frozenset[State]] = frozenset({State.HANDSHAKE})

    def __init__(self, limits: Limits, now_ns: int) -> None:
        self.limits = limits
        self.state = State.HANDSHAKE
        self.header: dict[str, str] = {}
        self._reader = ByteReader()
        self._outbox: list[bytes | memoryview] = []
        self._since_ns = now_ns
        self._is_drained = True
        self._parser = self._parse()

    @property
    def wants_data(self) -> bool:
        """False while received bytes could only wait: the owner should not read.

        So no more is held than one incomplete block and what was read last.
        """
        return self._is_drained and self.state not in self.PAUSED

    @property
    def deadline_ns(self) -> int | None:
        """When ``handle_timer`` ends the connection, None where the peer may take its time."""
        return self._since_ns + self.limits.timeout_ns if self.state in self.TIMED else None

    def receive_data(self, data: bytes | bytearray | memoryview) -> None:
        """Take received bytes; then call ``next_event`` until it gives None."""
        if self.state is not State.CLOSED:
            self._reader.feed(data)
            self._is_drained = False

    def receive_eof(self) -> None:
        """Take the end of the stream; then call ``next_event`` as for bytes."""
        self._reader.feed_eof()

    def next_event(self, now_ns: int) -> Event | None:
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
        self._is_drained = event is None
        return event

    def handle_timer(self, now_ns: int) -> Failed | None:
        """End the connection where its deadline has passed."""
        deadline_ns = self.deadline_ns
        if deadline_ns is None or now_ns < deadline_ns:
            return None
        return self._fail(f"silent for {self.limits.timeout_ns} ns")

    def data_to_send(self) -> list[bytes | memoryview]:
        """Return what is to be written, in order, and forget it."""
        data, self._outbox = self._outbox, []
        return data

    def close(self) -> None:
        """End the connection from this side."""
        self._end()

    @abstractmethod
    def _parse(self) -> Generator[Event | None, None, None]:
        """Turn bytes into events; yield None where bytes are missing."""

    def _move(self, act: Act) -> None:
        try:
            self.state = self.TABLE[self.state][act]
        except KeyError:
            message = f"{type(self).__name__}: {act.name} in state {self.state.name}"
            raise LocalProtocolError(message) from None

    def _end(self) -> None:
        if self.state is not State.CLOSED:
            self._move(Act.END)
            self._reader.clear()

    def _fail(self, reason: str) -> Failed:
        self._end()
        return Failed(reason)

    def _read_header(self) -> Generator[None, None, dict[str, str]]:
        body = yield from self._reader.block(self.limits.max_header, "header")
        self.header = decode_header(body)
        return self.header

    def _read_message(self) -> Generator[None, None, bytes]:
        return (yield from self._reader.block(self.limits.max_message, "message"))

    def _send_header(self, fields: Mapping[str, str]) -> None:
        self._outbox.append(encode_header(fields))


class ClientConnection(Connection):
    """The end that connects: its header is sent at once, and the answer read."""

    def __init__(self, fields: Mapping[str, str], limits: Limits, now_ns: int) -> None:
        super().__init__(limits, now_ns)
        self._send_header(fields)

    def _read_answer(
        self, md5sum: str, act: Act = Act.HEADER
    ) -> Generator[None, None, HeaderReceived | Refused]:
        fields = yield from self._read_header()
        if "error" in fields:
            self._end()
            return Refused(fields["error"])
        if not sums_agree(md5sum, fields.get("md5sum", md5sum)):
            raise TcprosError(f"md5sum {fields['md5sum']} answers our {md5sum}")
        self._move(act)
        return HeaderReceived(fields)


class ServerConnection(Connection):
    """The end that was connected to: it reads a header, then accepts or refuses."""

    REQUIRED: ClassVar[tuple[str, ...]]

    def refuse(self, reason: str) -> None:
        """Answer the header with ``error`` and end the connection."""
        self._move(Act.REFUSE)
        self._send_header({"error": reason})

    def _fail(self, reason: str) -> Failed:
        if self.state is State.HANDSHAKE:
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
        self._move(Act.HEADER)
        return HeaderReceived(fields)
