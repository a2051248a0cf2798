"""A TCP peer of the controller on the virtual network, moved on in every cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.network import Address, Outcome
from plcsim.testing.errors import PlcTestError

if TYPE_CHECKING:
    from plcsim.network import Socket, VirtualNetwork

__tracebackhide__ = True

CHUNK = 4096
"""Bytes received in one step at most."""


class Peer:
    """One connection with the controller; it connects, or waits to be connected to.

    Attributes:
        received: the bytes that have come so far.
        connected: True from the handshake on.
        closed: how the connection ended: "" while it lives, "closed" by the controller, or what
            the network said, such as "reset".
    """

    def __init__(
        self, network: VirtualNetwork, ip: str, controller: Address, port: int = 0
    ) -> None:
        self.received = bytearray()
        self.connected = False
        self.closed = ""
        self._controller = controller
        self._outgoing = bytearray()
        self._finished = False
        opened = network.host(ip).open("", port)
        if opened.socket is None:
            raise PlcTestError(f"peer {ip}:{port}: {opened.outcome.name.lower()}")
        self._socket: Socket = opened.socket
        self._listening = bool(port)
        if self._listening:
            self._socket.listen(1)

    def send(self, data: bytes) -> None:
        """Send bytes, from the next cycle on as fast as they are taken."""
        self._outgoing += data

    def close(self) -> None:
        """Close the connection in the next cycle, after all bytes are sent."""
        self._finished = True

    def step(self) -> None:
        """Connect, send and receive what is possible now; called in LATCH."""
        if self.closed:
            return
        if not self.connected:
            self._join()
            return
        self._send()
        self._receive()
        if self._finished and not self._outgoing and not self.closed:
            self._end("closed by the test")

    def _join(self) -> None:
        if self._listening:
            accepted = self._socket.accept()
            if accepted.socket is not None:
                self._socket.close()
                self._socket, self.connected = accepted.socket, True
            return
        outcome = self._socket.connect(self._controller)
        if outcome is Outcome.OK:
            self.connected = True
        elif outcome is not Outcome.WOULD_BLOCK:
            self._end(outcome.name.lower())

    def _send(self) -> None:
        while self._outgoing:
            sent = self._socket.send(bytes(self._outgoing))
            if sent.outcome is not Outcome.OK or not sent.taken:
                return
            del self._outgoing[: sent.taken]

    def _receive(self) -> None:
        received = self._socket.recv(CHUNK)
        if received.outcome is Outcome.OK:
            self.received += received.data
        elif received.outcome is not Outcome.WOULD_BLOCK:
            self._end(received.outcome.name.lower())

    def _end(self, why: str) -> None:
        self.closed = why
        self.connected = False
        self._socket.close()
