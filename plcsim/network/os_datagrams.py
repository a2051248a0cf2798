"""Datagrams on the network of the host."""

from __future__ import annotations

import socket
from contextlib import suppress
from typing import Final

from plcsim.network.datagrams import MAX_DATAGRAM, Datagram, OpenedDatagrams, is_target
from plcsim.network.os_options import read_option, set_option
from plcsim.network.os_outcomes import outcome_of
from plcsim.network.protocol import (
    ANY_IP,
    NO_ADDRESS,
    Address,
    Option,
    OptionValue,
    Outcome,
    Sent,
    is_ipv4,
)

_OPTIONS: Final = {
    Option.BROADCAST: (socket.SOL_SOCKET, socket.SO_BROADCAST),
    Option.SEND_BUFFER: (socket.SOL_SOCKET, socket.SO_SNDBUF),
    Option.RECEIVE_BUFFER: (socket.SOL_SOCKET, socket.SO_RCVBUF),
}


MOST_FOREIGN: Final = 64
"""Datagrams of others that one call leaves out where the other side is fixed."""


class OsDatagramSocket:
    """A UDP socket of the host; see `plcsim.network.datagrams.DatagramSocket`."""

    def __init__(self, os_socket: socket.socket) -> None:
        os_socket.settimeout(0)
        self._socket = os_socket
        self._peer: Address | None = None

    @property
    def local(self) -> Address:
        """The own address; ``NO_ADDRESS`` once closed."""
        try:
            return Address(*self._socket.getsockname())
        except OSError:
            return NO_ADDRESS

    @property
    def peer(self) -> Address | None:
        """The other side that ``connect`` has fixed, else None."""
        return self._peer

    def connect(self, peer: Address) -> Outcome:
        """Fix the other side.

        The host is not told, as Python cannot undo its connect(2): ``recv`` leaves out what others
        send.
        """
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
        if len(data) > MAX_DATAGRAM:
            return Sent(Outcome.INVALID)
        to = target or self._peer
        if to is None:
            return Sent(Outcome.NOT_CONNECTED)
        if not is_target(to):
            return Sent(Outcome.INVALID_ADDRESS)
        try:
            return Sent(Outcome.OK, self._socket.sendto(data, to))
        except OSError as error:
            return Sent(outcome_of(error))

    def recv(self, size: int, *, peek: bool = False) -> Datagram:
        """Take one datagram."""
        if size < 1:
            return Datagram(Outcome.INVALID)
        for _ in range(MOST_FOREIGN):
            try:
                data, peer = self._socket.recvfrom(MAX_DATAGRAM, socket.MSG_PEEK)
                is_wanted = self._peer is None or self._peer == peer
                if not (peek and is_wanted):
                    self._socket.recvfrom(1)
            except OSError as error:
                return Datagram(outcome_of(error))
            if is_wanted:
                return Datagram(Outcome.OK, data[:size], Address(*peer))
        return Datagram(Outcome.WOULD_BLOCK)

    def set_option(self, option: Option, value: int) -> Outcome:
        """Set BROADCAST or the size of a buffer."""
        return set_option(self._socket, _OPTIONS, option, value)

    def option(self, option: Option) -> OptionValue:
        """Read it back."""
        return read_option(self._socket, _OPTIONS, option)

    def close(self) -> None:
        """Free the port."""
        self._peer = None
        with suppress(OSError):
            self._socket.close()


def open_datagrams(ip: str, port: int, *, reuse_address: bool = False) -> OpenedDatagrams:
    """Make a UDP socket of the host and bind it."""
    if ip and not is_ipv4(ip):
        return OpenedDatagrams(Outcome.INVALID_ADDRESS)
    if not 0 <= port < 65_536:
        return OpenedDatagrams(Outcome.INVALID)
    try:
        os_socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    except OSError as error:
        return OpenedDatagrams(outcome_of(error))
    try:
        os_socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, int(reuse_address))
        os_socket.bind((ip or ANY_IP, port))
    except OSError as error:
        os_socket.close()
        return OpenedDatagrams(outcome_of(error))
    return OpenedDatagrams(Outcome.OK, OsDatagramSocket(os_socket))
