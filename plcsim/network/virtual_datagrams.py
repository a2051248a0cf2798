"""Datagrams on a virtual net: sent once, lost where the net is silent or a buffer is full."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from plcsim.network.datagrams import BROADCAST_IP, MAX_DATAGRAM, Datagram, is_target
from plcsim.network.protocol import (
    ANY_IP,
    NO_ADDRESS,
    Address,
    Option,
    OptionValue,
    Outcome,
    Sent,
    legal_value,
)
from plcsim.network.wire import Packet, is_loopback

if TYPE_CHECKING:
    from plcsim.network.virtual_host import VirtualHost


def _nothing() -> None:
    """Do nothing about a lost datagram: nobody learns of it."""


class VirtualDatagramSocket:
    """A UDP socket of a virtual host; see `plcsim.network.datagrams.DatagramSocket`."""

    def __init__(self, host: VirtualHost, bound: Address) -> None:
        self._host = host
        self.bound = bound
        self._peer: Address | None = None
        self._waiting: deque[tuple[bytes, Address]] = deque()
        self._is_open = True
        limits = host.net.limits
        self._options = {
            Option.BROADCAST: 0,
            Option.SEND_BUFFER: limits.send_buffer,
            Option.RECEIVE_BUFFER: limits.receive_buffer,
        }

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""
        return self.bound if self._is_open else NO_ADDRESS

    @property
    def peer(self) -> Address | None:
        """The other side that ``connect`` has fixed, else None."""
        return self._peer

    def connect(self, peer: Address) -> Outcome:
        """Fix the other side."""
        if not is_target(peer):
            return Outcome.INVALID_ADDRESS
        self._peer = peer
        return Outcome.OK

    def disconnect(self) -> Outcome:
        """Undo ``connect``."""
        self._peer = None
        return Outcome.OK

    def send(self, data: bytes | memoryview, target: Address | None = None) -> Sent:
        """Send one datagram."""
        self._host.net.settle()
        to = target or self._peer
        if not self._is_open or len(data) > MAX_DATAGRAM:
            return Sent(Outcome.INVALID)
        if to is None:
            return Sent(Outcome.NOT_CONNECTED)
        if not is_target(to):
            return Sent(Outcome.INVALID_ADDRESS)
        if to.ip == BROADCAST_IP and not self._options[Option.BROADCAST]:
            return Sent(Outcome.DENIED)
        content = bytes(data)
        for host in self._host.net.hosts_at(to.ip, self._host):
            self._send_to(host, Address(host.ip, to.port), content, to.ip)
        return Sent(Outcome.OK, len(content))

    def _send_to(self, host: VirtualHost, target: Address, data: bytes, ip: str) -> None:
        source_ip = self.bound.ip if self.bound.ip != ANY_IP else self._host.ip
        source = Address("127.0.0.1" if is_loopback(ip) else source_ip, self.bound.port)

        def deliver() -> bool:
            return host.deliver_datagram(target, data, source)

        packet = Packet("UDP", source, target, len(data), deliver, _nothing, 0, 0)
        self._host.net.send(packet)

    def take(self, data: bytes, source: Address) -> bool:
        """Keep a datagram that has arrived; False where it is lost."""
        held = sum(len(each) for each, _ in self._waiting)
        if held + len(data) > self._options[Option.RECEIVE_BUFFER] and self._waiting:
            return False
        if self._peer is not None and self._peer != source:
            return False
        self._waiting.append((data, source))
        return True

    def recv(self, size: int, *, peek: bool = False) -> Datagram:
        """Take one datagram."""
        self._host.net.settle()
        if not self._is_open or size < 1:
            return Datagram(Outcome.INVALID)
        if not self._waiting:
            return Datagram(Outcome.WOULD_BLOCK)
        data, source = self._waiting[0] if peek else self._waiting.popleft()
        return Datagram(Outcome.OK, data[:size], source)

    def set_option(self, option: Option, value: int) -> Outcome:
        """Set BROADCAST or the size of a buffer."""
        legal = legal_value(option, value)
        if option not in self._options or legal is None or not self._is_open:
            return Outcome.INVALID
        self._options[option] = legal
        return Outcome.OK

    def option(self, option: Option) -> OptionValue:
        """Read it back."""
        if option not in self._options or not self._is_open:
            return OptionValue(Outcome.INVALID)
        return OptionValue(Outcome.OK, self._options[option])

    def close(self) -> None:
        """Free the port."""
        if self._is_open:
            self._host.remove_datagrams(self)
        self._is_open = False
        self._peer = None
        self._waiting.clear()
