"""How a virtual connection comes about: SYN, then SYN-ACK, a refusal, or silence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.network.connection import FIRST_RETRY_NS, Connection, join
from plcsim.network.protocol import Outcome
from plcsim.network.wire import SECOND_NS, Packet

if TYPE_CHECKING:
    from plcsim.network.virtual_host import VirtualHost
    from plcsim.network.virtual_network import VirtualNetwork

FIRST_SYN_RETRY_NS = SECOND_NS
"""RFC 6298: the first repeat comes after one second."""


class Handshake:
    """One attempt of a client to connect.

    Args:
        net: carries the packets.
        target: the host at the peer's address, None if there is none.
        client: the client's end.

    Attributes:
        answer: WOULD_BLOCK until it is known how the attempt ended.
        cancelled: the client has closed its socket.
    """

    def __init__(self, net: VirtualNetwork, target: VirtualHost | None, client: Connection) -> None:
        self.answer = Outcome.WOULD_BLOCK
        self.cancelled = False
        self._net = net
        self._target = target
        self._client = client
        net.send(
            Packet(
                "SYN",
                client.local,
                client.peer,
                0,
                self._syn_arrives,
                self._time_out,
                net.limits.connect_ns,
                FIRST_SYN_RETRY_NS,
            )
        )

    def _syn_arrives(self) -> bool:
        """Return False where the SYN is dropped: no such host, or no room in the queue."""
        if self.cancelled:
            return True
        if self._target is None:
            return False
        address = self._client.peer
        listener = self._target.listener(address)
        if listener is None or self._target.refuses(address.port):
            self._answer_by("RST", Outcome.REFUSED)
            return True
        server = listener.take(address, self._client.local)
        if server is None:
            return False
        join(self._client, server)
        self._answer_by("SYN-ACK", Outcome.OK)
        return True

    def _answer_by(self, kind: str, outcome: Outcome) -> None:
        def deliver() -> bool:
            self._set_answer(outcome)
            return True

        client, net = self._client, self._net
        patience_ns = net.limits.connect_ns
        arrival_ns = net.send(
            Packet(
                kind,
                client.peer,
                client.local,
                0,
                deliver,
                self._time_out,
                patience_ns,
                FIRST_RETRY_NS,
            )
        )
        if outcome is Outcome.OK:
            client.other.hold_back(arrival_ns)

    def _set_answer(self, outcome: Outcome) -> None:
        if not self.cancelled:
            self.answer = outcome
        elif outcome is Outcome.OK:
            self._client.abort()

    def _time_out(self) -> None:
        self.answer = Outcome.TIMED_OUT
        if self._client.joined:
            self._client.other.lose(Outcome.TIMED_OUT)
