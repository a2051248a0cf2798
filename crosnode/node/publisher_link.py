"""One publisher of a topic: asked for its address, connected to, and again when it is lost."""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING, Final, Protocol

from crosnode.errors import HostPendingError
from crosnode.graph.uri import make_uri
from crosnode.node.status import StatusKind
from crosnode.tcpros import HeaderReceived, MessagesReceived, Refused, SubscriberConnection
from crosnode.transport.connection import Failed
from crosnode.transport.transitions import Transitions, next_state
from crosnode.xmlrpc.api_caller import ApiCall, CallState
from plcsim.core.backoff import Backoff

if TYPE_CHECKING:
    from collections.abc import Sequence

    from crosnode.node.core import NodeCore
    from crosnode.tcpros import TypeInfo
    from crosnode.transport.budget import StepBudget
    from crosnode.transport.connection import ConnectionEvent
    from crosnode.transport.link import PeerLink
    from plcsim.network import Address

FIRST_RETRY_NS: Final = 100_000_000
LONGEST_RETRY_NS: Final = 5_000_000_000

FIRST_FORGIVEN_NS: Final = 10_000_000_000
LONGEST_FORGIVEN_NS: Final = 600_000_000_000
"""Nanoseconds until a publisher is tried again that broke the protocol or a limit."""


class PublisherState(Enum):
    """How far the way to a publisher is."""

    WAITING = auto()
    """Until it is time to try, or to try again."""
    ASKING = auto()
    LOCATED = auto()
    """The address is known; a step that may start a connection is waited for."""
    CONNECTING = auto()
    STREAMING = auto()
    LEFT = auto()


class PublisherTrigger(Enum):
    """What happens on the way to a publisher."""

    DUE = "its node is asked where the topic can be had"
    ANSWERED = "the node says where"
    NOT_HAD = "the node does not, or does not answer"
    STARTED = "a connection is started"
    ACCEPTED = "its header fits"
    LOST = "the connection ends"
    LEAVE = "the master does not name it any more, or the topic is taken back"


_State = PublisherState
_Trigger = PublisherTrigger

PUBLISHER_LINK: Final[Transitions[PublisherState, PublisherTrigger]] = {
    _State.WAITING: {_Trigger.DUE: _State.ASKING, _Trigger.LEAVE: _State.LEFT},
    _State.ASKING: {
        _Trigger.ANSWERED: _State.LOCATED,
        _Trigger.NOT_HAD: _State.WAITING,
        _Trigger.LEAVE: _State.LEFT,
    },
    _State.LOCATED: {_Trigger.STARTED: _State.CONNECTING, _Trigger.LEAVE: _State.LEFT},
    _State.CONNECTING: {
        _Trigger.ACCEPTED: _State.STREAMING,
        _Trigger.LOST: _State.WAITING,
        _Trigger.LEAVE: _State.LEFT,
    },
    _State.STREAMING: {_Trigger.LOST: _State.WAITING, _Trigger.LEAVE: _State.LEFT},
    _State.LEFT: {},
}


class Receiver(Protocol):
    """Who a publisher's messages are for; `crosnode.node.subscriber.Subscriber`."""

    topic: str
    core: NodeCore
    tcp_nodelay: bool

    def type_info(self) -> TypeInfo:
        """Return what the header says of the type."""

    def receive(self, bodies: Sequence[bytes | memoryview], publisher: PublisherLink) -> None:
        """Take messages."""


class PublisherLink:
    """One publisher.

    Args:
        receiver: whom its messages are for.
        uri: of its node.

    Attributes:
        uri: of its node.
        state: how far the way to it is.
        link: to it, None while there is none.
        life: of the master that named it last (`MasterClient.life`).
        received: messages from it so far.
        number: of the connection in getBusInfo.
    """

    def __init__(self, receiver: Receiver, uri: str) -> None:
        self.uri = uri
        self.state = PublisherState.WAITING
        self.link: PeerLink | None = None
        self.life = 0
        self.received = 0
        self.number = receiver.core.next_number()
        self._receiver = receiver
        self._call: ApiCall | None = None
        self._address: Address | None = None
        self._backoff = Backoff(FIRST_RETRY_NS, LONGEST_RETRY_NS)
        self._forgiveness = Backoff(FIRST_FORGIVEN_NS, LONGEST_FORGIVEN_NS)

    @property
    def is_streaming(self) -> bool:
        """Whether its header came and fits."""
        return self.state is PublisherState.STREAMING

    @property
    def is_waiting(self) -> bool:
        """Whether no connection is there or on its way: the last was lost, or came to nothing."""
        return self.state is PublisherState.WAITING

    def step(self, now_ns: int, budget: StepBudget) -> None:
        """Ask for the address, then connect, each when it is time."""
        if self.state is PublisherState.WAITING:
            if self._backoff.is_due(now_ns) and self._forgiveness.is_due(now_ns):
                self._ask()
        elif self.state is PublisherState.ASKING and self._call:
            self._take_answer(self._call, now_ns)
        if self.state is PublisherState.LOCATED and self._address and budget.start_call():
            self._connect(self._address, now_ns)

    def _ask(self) -> None:
        core = self._receiver.core
        self._move(PublisherTrigger.DUE)
        params = [core.name, self._receiver.topic, [["TCPROS"]]]
        self._call = core.api.start(ApiCall(self.uri, "requestTopic", params))

    def _take_answer(self, call: ApiCall, now_ns: int) -> None:
        if call.state is CallState.WAITING:
            return
        if call.state is CallState.FAILED:
            self._fail(PublisherTrigger.NOT_HAD, now_ns)
            return
        try:
            _, host, port = call.value
            uri = make_uri("rosrpc", host, port)
            self._address = self._receiver.core.hosts.address(uri, "rosrpc")
        except HostPendingError:
            return  # asked again in the next step
        except (ValueError, TypeError, AttributeError) as error:
            self._fail(PublisherTrigger.NOT_HAD, now_ns)
            self._tell(StatusKind.PEER_REFUSED, f"{self.uri}: {error}")
        else:
            self._move(PublisherTrigger.ANSWERED)

    def _connect(self, address: Address, now_ns: int) -> None:
        receiver, core = self._receiver, self._receiver.core
        connection = SubscriberConnection(
            receiver.topic,
            receiver.type_info(),
            core.name,
            tcp_nodelay=receiver.tcp_nodelay,
            limits=core.tcpros_limits,
            now_ns=now_ns,
        )
        self._move(PublisherTrigger.STARTED)
        self.link = core.loop.connect(address, connection, self, now_ns)

    def _fail(self, trigger: PublisherTrigger, now_ns: int) -> None:
        """Wait a little longer each time before the next attempt."""
        self._move(trigger)
        self._backoff.failed(now_ns)

    def _move(self, trigger: PublisherTrigger) -> None:
        self.state = next_state(PUBLISHER_LINK, self.state, trigger, f"publisher {self.uri}")

    def handle_event(self, link: PeerLink, event: ConnectionEvent, now_ns: int) -> None:
        """Hand messages to the receiver."""
        if isinstance(event, MessagesReceived):
            self.received += len(event.bodies)
            self._receiver.receive(event.bodies, self)
        elif isinstance(event, HeaderReceived) and self.state is PublisherState.CONNECTING:
            self._move(PublisherTrigger.ACCEPTED)
            self._backoff.succeeded()
            self._tell(StatusKind.CONNECTED, self.uri)
        elif isinstance(event, Refused):
            self._tell(StatusKind.PEER_REFUSED, event.error)
        elif isinstance(event, Failed):
            if self.is_streaming:
                self._forgiveness.failed(now_ns)
            self._tell(StatusKind.BAD_MESSAGE, event.reason)

    def expects_data(self, link: PeerLink) -> bool:
        """A publisher may always send."""
        return True

    def fill(self, link: PeerLink) -> None:
        """A subscriber sends nothing after its header."""

    def ended(self, link: PeerLink, reason: str, now_ns: int) -> None:
        """Try again later, as long as the master names the publisher."""
        self.link = None
        if self.state is PublisherState.LEFT:
            return
        if self.is_streaming:
            self._tell(StatusKind.DISCONNECTED, reason or self.uri)
        self._fail(PublisherTrigger.LOST, now_ns)

    def drop(self, reason: str) -> None:
        """End the connection, which is tried again later."""
        if self.link:
            self.link.close(reason)

    def leave(self) -> None:
        """End the connection for good."""
        if self.is_streaming:
            self._tell(StatusKind.DISCONNECTED, "no publisher any more")
        self._move(PublisherTrigger.LEAVE)
        self.drop("no publisher any more")

    def _tell(self, kind: StatusKind, text: str) -> None:
        self._receiver.core.tell(kind, self._receiver.topic, text)
