"""What the ends of all connections share, TCPROS and XML-RPC: states, time, bytes to send.

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
from typing import TYPE_CHECKING, ClassVar, Final, TypeAlias

from crosnode.transport.transitions import Transitions, next_state

if TYPE_CHECKING:
    from crosnode.transport.dyn_buffer import Data


MOST_READ: Final = 1 << 20
"""Bytes; more than one read gives."""


class ConnectionState(Enum):
    """States of all roles; a role uses those in its table."""

    __hash__ = object.__hash__  # that of Enum is written in Python, and each message needs it

    HANDSHAKE = auto()  # waiting for the header of the peer
    DECISION = auto()  # waiting for this program to accept or refuse
    STREAMING = auto()  # messages flow
    IDLE = auto()  # a client may send a request
    REQUEST = auto()  # a server waits for a request
    REPLY = auto()  # a call is running
    CLOSED = auto()


class Trigger(Enum):
    """What moves a connection from state to state."""

    __hash__ = object.__hash__  # as above

    HEADER = auto()
    ACCEPT = auto()
    REFUSE = auto()
    MESSAGE = auto()
    REQUEST = auto()
    REPLY = auto()
    LAST = auto()  # the only reply of a connection that is not persistent, or of a probe
    END = auto()  # the peer closed or broke the protocol, time ran out, or this program closes


Table: TypeAlias = Transitions[ConnectionState, Trigger]


class ConnectionEvent:
    """Base of all that a connection tells its owner."""

    __slots__ = ()

    @property
    def count(self) -> int:
        """How often the event has its price."""
        return 1


@dataclass(frozen=True, slots=True)
class Failed(ConnectionEvent):
    """The connection is over because the peer broke the protocol or a time limit."""

    reason: str


@dataclass(frozen=True, slots=True)
class Silent(Failed):
    """The connection is over because the peer did not do its part in time."""


@dataclass(frozen=True, slots=True)
class Closed(ConnectionEvent):
    """The peer closed between two messages."""


@dataclass(frozen=True, slots=True)
class Progress(ConnectionEvent):
    """Some of a long document was read or written; there is more to do. Owners are not told."""


class ProtocolConnection(ABC):
    """One end of a connection.

    Args:
        state: the first state.
        timeout_ns: nanoseconds the peer may take for its part in a timed state.
        now_ns: time of the step in which the connection was made.

    Attributes:
        state: of the role's table.
        most: messages that the next event may hold at most.
        outbox: what is to be written, in order; ``data_to_send`` takes it.
    """

    TABLE: ClassVar[Table]
    IS_PARSED: ClassVar[bool]
    """Whether what is read are documents, whose price lies in their events and not in the bytes."""

    PAUSED: ClassVar[frozenset[ConnectionState]] = frozenset({ConnectionState.CLOSED})
    TIMED: ClassVar[frozenset[ConnectionState]] = frozenset()

    def __init__(self, state: ConnectionState, timeout_ns: int, now_ns: int) -> None:
        self.state = state
        self.most = 1
        self._timeout_ns = timeout_ns
        self._since_ns = now_ns
        self._is_drained = True
        self.outbox: list[bytes | memoryview] = []

    @abstractmethod
    def event_price(self, now_ns: int) -> int:
        """What the next event costs of the work of a step, at the prices of `StepLimits`."""

    @abstractmethod
    def receive_data(self, data: Data) -> None:
        """Take received bytes; what is kept of them is copied. Then call ``next_event``."""

    @property
    def next_read(self) -> int:
        """Bytes that the next read should ask for at most, where there is no ``room``."""
        return MOST_READ

    @property
    def room(self) -> memoryview | None:
        """Where the bytes of a large message are to be written; None where none is expected."""
        return None

    @property
    def is_room_fresh(self) -> bool:
        """Whether the system lays out the pages of ``room`` as they are filled."""
        return False

    def filled(self, size: int) -> None:
        """Note that bytes were written to ``room``; then call ``next_event`` as for bytes."""
        raise NotImplementedError(f"{type(self).__name__} gives no room.")

    @abstractmethod
    def receive_eof(self) -> None:
        """Take the end of the stream; then call ``next_event`` as for bytes."""

    @abstractmethod
    def next_event(self, now_ns: int) -> ConnectionEvent | None:
        """Return the next event, None where none can be had from the bytes so far."""

    @property
    def wants_data(self) -> bool:
        """False while received bytes could only wait: the owner should not read.

        So no more is held than one incomplete message and what was read last.
        """
        return self._is_drained and self.state not in self.PAUSED

    @property
    def deadline_ns(self) -> int | None:
        """When ``handle_timer`` ends the connection, None where the peer may take its time."""
        return self._since_ns + self._timeout_ns if self.state in self.TIMED else None

    def handle_timer(self, now_ns: int) -> Failed | None:
        """End the connection where its deadline has passed."""
        deadline_ns = self.deadline_ns
        if deadline_ns is None or now_ns < deadline_ns:
            return None
        return Silent(self._fail(f"silent for {self._timeout_ns} ns").reason)

    def data_to_send(self) -> list[bytes | memoryview]:
        """Return what is to be written, in order, and forget it."""
        data, self.outbox = self.outbox, []
        return data

    @property
    def idle_since_ns(self) -> int | None:
        """Since when nothing is under way and the peer need not say anything; None otherwise."""
        return None

    def close(self) -> None:
        """End the connection from this side."""
        if self.state is not ConnectionState.CLOSED:
            self._move(Trigger.END)

    def _move(self, trigger: Trigger) -> None:
        self.state = next_state(self.TABLE, self.state, trigger, type(self).__name__)

    def _fail(self, reason: str) -> Failed:
        self.close()
        return Failed(reason)
