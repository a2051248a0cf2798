"""One end of a virtual connection: its two streams, and how it ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.network.protocol import Address, Option, Outcome
from plcsim.network.stream import Stream
from plcsim.network.wire import SECOND_NS, Packet

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.network.events import NetworkEvent
    from plcsim.network.options import SocketOptions
    from plcsim.network.virtual_network import VirtualNetwork

FIRST_RETRY_NS = SECOND_NS // 5


class Connection:
    """One end; ``join`` makes two of them a connection.

    Args:
        net: carries the packets.
        local: the own address.
        peer: the other end's address.
        options: of the socket; read again by ``apply_options``.
        on_gone: called once when the socket needs no port any more; True if the port fades out.

    Attributes:
        outgoing: bytes to the other end.
        incoming: bytes from the other end.
        joined: the attributes above are there.
        lost: why the connection is gone, None while it stands.
        hung_up: the program has closed the socket; what is left goes on in the background.
    """

    other: Connection
    outgoing: Stream
    incoming: Stream

    def __init__(
        self,
        net: VirtualNetwork,
        local: Address,
        peer: Address,
        options: SocketOptions,
        on_gone: Callable[[bool], None],
    ) -> None:
        self.local = local
        self.peer = peer
        self.lost: Outcome | None = None
        self.hung_up = False
        self.joined = False
        self._net = net
        self._options = options
        self._on_gone = on_gone
        self._gone = False
        self._ended_first = False
        self._in_order_ns = 0
        self._fade: NetworkEvent | None = None
        self._probe: NetworkEvent | None = None
        self._missed_probes = 0

    def apply_options(self) -> None:
        """Let options take effect that were set before or while connected."""
        self.outgoing.capacity = self._options[Option.SEND_BUFFER]
        self.incoming.window = self._options[Option.RECEIVE_BUFFER]
        self.incoming.urgent_inline = bool(self._options[Option.URGENT_INLINE])
        if self._options[Option.KEEPALIVE] and self._probe is None and not self._gone:
            self._plan_probe(Option.KEEP_IDLE)

    # -- packets ----------------------------------------------------------------------------------

    def packet_size(self) -> int:
        """Choose the size of the next packet, in bytes."""
        link = self._net.link(self.local.ip, self.peer.ip)
        if link.smallest_packet == link.largest_packet:
            return link.largest_packet
        return self._net.random.randint(link.smallest_packet, link.largest_packet)

    def carry(self, size: int, arrive: Callable[[], None]) -> None:
        """Bring data (or the end mark, if ``size`` is 0) to the other end, in order."""

        def deliver() -> None:
            if size and self.other.hung_up:
                self.other.abort()
                return
            arrive()
            self.other.check_ended()
            self.check_ended()

        patience_ns = self._net.limits.retransmit_ns
        self.send("DATA" if size else "FIN", size, deliver, patience_ns)

    def send(self, kind: str, size: int, deliver: Callable[[], None], patience_ns: int = 0) -> None:
        """Send a packet behind all earlier ones of this end."""

        def taken() -> bool:
            deliver()
            return True

        packet = Packet(
            kind, self.local, self.peer, size, taken, self._give_up, patience_ns, FIRST_RETRY_NS
        )
        self._in_order_ns = self._net.send(packet, self._in_order_ns)

    def hold_back(self, until_ns: int) -> None:
        """Let no packet of this end arrive before ``until_ns``."""
        self._in_order_ns = max(self._in_order_ns, until_ns)

    def _give_up(self) -> None:
        self.lose(Outcome.TIMED_OUT)

    # -- reading ----------------------------------------------------------------------------------

    def read(self, size: int, *, peek: bool) -> bytes:
        """Take up to ``size`` bytes that have arrived; none if there are none."""
        data = self.incoming.read(size, peek=peek)
        self.other.check_ended()
        return data

    # -- ending -----------------------------------------------------------------------------------

    def finish(self) -> None:
        """Send the end mark: no more bytes will follow."""
        if not self.outgoing.finished:
            self._ended_first = not self.incoming.ended
            self.outgoing.finish()

    def hang_up(self) -> None:
        """The program closes the socket: send the rest in the background, or reset.

        Unread bytes or a linger time of 0 reset the connection (RFC 1122, 4.2.2.13).
        """
        self.hung_up = True
        if self.lost is not None:
            self._go(fading=False)
        elif self._options.linger == 0 or self.incoming.arrived:
            self.abort()
        else:
            self.finish()
            self._fade = self._net.plan(self._net.limits.fade_ns, self._fade_out)
            self.check_ended()

    def abort(self) -> None:
        """Forget all bytes and tell the other end by RST."""
        self.hung_up = True
        self._cut_off()
        self.send("RST", 0, lambda: self.other.lose(Outcome.RESET))
        self._go(fading=False)

    def lose(self, reason: Outcome) -> None:
        """The connection is gone; bytes that have arrived can still be read."""
        self.lost = self.lost or reason
        self._cut_off()
        if self.hung_up:
            self._go(fading=False)

    def check_ended(self) -> None:
        """Free the port once the program has closed and both directions have ended."""
        if self.hung_up and self.outgoing.ended and self.incoming.ended:
            self._go(fading=self._ended_first)

    def _cut_off(self) -> None:
        self.outgoing.cut_off()
        self.incoming.cut_off()

    def _fade_out(self) -> None:
        if self.outgoing.drained:
            self._go(fading=False)
        else:
            self.abort()

    def _go(self, *, fading: bool) -> None:
        for event in (self._fade, self._probe):
            if event is not None:
                self._net.cancel(event)
        if not self._gone:
            self._gone = True
            self._on_gone(fading)

    # -- keepalive --------------------------------------------------------------------------------

    def _plan_probe(self, wait: Option) -> None:
        self._probe = self._net.plan(self._options[wait] * SECOND_NS, self._send_probe)

    def _send_probe(self) -> None:
        """Ask the other end for a sign of life.

        The first probe is planned from the last one, not from the last data: in the simulation it
        costs nothing, and a lost peer is noticed within the same bound.
        """
        self._probe = None
        if self.lost is not None or self._gone or not self._options[Option.KEEPALIVE]:
            return
        if self._net.silent(self.local.ip, self.peer.ip):
            self._missed_probes += 1
        elif self.other.is_gone:
            self.lose(Outcome.RESET)
            return
        else:
            self._missed_probes = 0
        if self._missed_probes > self._options[Option.KEEP_COUNT]:
            self.lose(Outcome.TIMED_OUT)
            return
        self._plan_probe(Option.KEEP_INTERVAL if self._missed_probes else Option.KEEP_IDLE)

    @property
    def is_gone(self) -> bool:
        """Whether the socket of this end exists no more."""
        return self._gone


def join(one: Connection, two: Connection) -> None:
    """Make two ends one connection."""
    one.other, two.other = two, one
    one.joined = two.joined = True
    one.outgoing = two.incoming = Stream(one)
    two.outgoing = one.incoming = Stream(two)
    one.apply_options()
    two.apply_options()
