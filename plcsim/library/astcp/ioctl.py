"""TcpIoctl: options of a socket and of the library."""

from __future__ import annotations

from functools import partial
from struct import Struct as Format
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.astcp import interface
from plcsim.library.astcp.block import AsTcpBlock, ip_size, ip_string
from plcsim.library.runtime import ERR_OK
from plcsim.network.protocol import Option, Outcome

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.memory import Memory
    from plcsim.library.astcp.idents import Endpoint, IdentTable

_UDINT: Final = Format("<I")
_PAIR: Final = Format("<II")
_UINT: Final = Format("<H")


class _Answer(NamedTuple):
    """Status, and bytes for pData."""

    status: int
    data: bytes = b""


class _Ioctl(NamedTuple):
    """Size in bytes of the value at pData, and what is done with it."""

    size: int
    run: Callable[[Endpoint, bytes, Memory], _Answer]


def _set_status(outcome: Outcome) -> int:
    if outcome is Outcome.OK:
        return ERR_OK
    return interface.tcpERR_PARAMETER if outcome is Outcome.INVALID else interface.tcpERR_SYSTEM


def _set_option(option: Option, endpoint: Endpoint, data: bytes, _memory: Memory) -> _Answer:
    (value,) = _UDINT.unpack(data)
    return _Answer(_set_status(endpoint.socket.set_option(option, value)))


def _get_option(option: Option, endpoint: Endpoint, _data: bytes, _memory: Memory) -> _Answer:
    outcome, value = endpoint.socket.option(option)
    if outcome is not Outcome.OK:
        return _Answer(interface.tcpERR_SYSTEM)
    return _Answer(ERR_OK, _UDINT.pack(value))


def _set_linger(endpoint: Endpoint, data: bytes, _memory: Memory) -> _Answer:
    on, seconds = _PAIR.unpack(data)
    return _Answer(_set_status(endpoint.socket.set_linger(seconds if on else None)))


def _get_linger(endpoint: Endpoint, _data: bytes, _memory: Memory) -> _Answer:
    seconds = endpoint.socket.linger()
    return _Answer(ERR_OK, _PAIR.pack(seconds is not None, seconds or 0))


def _set_no_waiting(endpoint: Endpoint, data: bytes, _memory: Memory) -> _Answer:
    endpoint.no_waiting = any(data)
    return _Answer(ERR_OK)


def _get_no_waiting(endpoint: Endpoint, _data: bytes, _memory: Memory) -> _Answer:
    return _Answer(ERR_OK, _UDINT.pack(endpoint.no_waiting))


def _get_address(endpoint: Endpoint, data: bytes, memory: Memory) -> _Answer:
    """Store the socket's own address where the tcpSO_ADDRESS_typ in ``data`` points to."""
    port_at, ip_at = _PAIR.unpack(data)
    local = endpoint.socket.local
    for address, size in ((port_at, _UINT.size), (ip_at, ip_size(local.ip))):
        if address:
            memory.check(address, size)
    if port_at:
        memory.write(port_at, _UINT.pack(local.port))
    if ip_at:
        memory.write(ip_at, ip_string(local.ip))
    return _Answer(ERR_OK, data)


_OPTIONS: Final = {
    Option.KEEPALIVE: (interface.tcpSO_KEEPALIVE_SET, interface.tcpSO_KEEPALIVE_GET),
    Option.SEND_BUFFER: (interface.tcpSO_SNDBUF_SET, interface.tcpSO_SNDBUF_GET),
    Option.RECEIVE_BUFFER: (interface.tcpSO_RCVBUF_SET, interface.tcpSO_RCVBUF_GET),
    Option.URGENT_INLINE: (interface.tcpSO_OOBINLINE_SET, interface.tcpSO_OOBINLINE_GET),
    Option.NO_DELAY: (interface.tcpTCP_NODELAY_SET, interface.tcpTCP_NODELAY_GET),
    Option.KEEP_COUNT: (interface.tcpTCP_KEEPCNT_SET, interface.tcpTCP_KEEPCNT_GET),
    Option.KEEP_IDLE: (interface.tcpTCP_KEEPIDLE_SET, interface.tcpTCP_KEEPIDLE_GET),
    Option.KEEP_INTERVAL: (interface.tcpTCP_KEEPINTVL_SET, interface.tcpTCP_KEEPINTVL_GET),
}

_IOCTLS: Final[dict[int, _Ioctl]] = {
    interface.tcpSO_LINGER_SET: _Ioctl(_PAIR.size, _set_linger),
    interface.tcpSO_LINGER_GET: _Ioctl(_PAIR.size, _get_linger),
    interface.tcpSO_ADDRESS_GET: _Ioctl(_PAIR.size, _get_address),
    interface.tcpSO_NOWAITING_SET: _Ioctl(_UDINT.size, _set_no_waiting),
    interface.tcpSO_NOWAITING_GET: _Ioctl(_UDINT.size, _get_no_waiting),
    **{s: _Ioctl(_UDINT.size, partial(_set_option, o)) for o, (s, _) in _OPTIONS.items()},
    **{g: _Ioctl(_UDINT.size, partial(_get_option, o)) for o, (_, g) in _OPTIONS.items()},
}
"""What is done on one socket; tcpID_LIST_GET and tcpID_MAX_GET concern all."""


class TcpIoctl(interface.TcpIoctl, AsTcpBlock):
    """Read or set an option.

    Inputs: enable; ident, not looked at by tcpID_...; ioctl; pData, address of the value; datalen,
    its bytes: 8 for linger and address, 4 for all others, a multiple of 4 for tcpID_LIST_GET, which
    stores as many idents as fit. Outputs: status; outlen, bytes stored at pData.

    Statuses: ERR_OK, tcpERR_INVALID_IOCTL, tcpERR_INVALID_IDENT, tcpERR_PARAMETER (pData 0, wrong
    length, value out of range), tcpERR_SYSTEM.
    """

    def step(self, idents: IdentTable) -> int:
        """Do what ioctl says."""
        self.outlen = 0
        if self.ioctl == interface.tcpID_LIST_GET:
            return self._store_list(idents.in_use())
        if self.ioctl == interface.tcpID_MAX_GET:
            return self._store_max(idents.settings.idents)
        found = _IOCTLS.get(self.ioctl)
        if found is None:
            return interface.tcpERR_INVALID_IOCTL
        endpoint = idents.find(self.ident)
        if endpoint is None:
            return self.unknown_ident(idents)
        return self._run(found, endpoint)

    def _run(self, ioctl: _Ioctl, endpoint: Endpoint) -> int:
        if not self.pData or self.datalen != ioctl.size:
            return interface.tcpERR_PARAMETER
        memory = self.context.memory
        answer = ioctl.run(endpoint, memory.read(self.pData, ioctl.size), memory)
        return self._store(answer)

    def _store(self, answer: _Answer) -> int:
        self.context.memory.write(self.pData, answer.data)
        self.outlen = len(answer.data)
        return answer.status

    def _store_list(self, idents: tuple[int, ...]) -> int:
        if not self.pData or not self.datalen or self.datalen % _UDINT.size:
            return interface.tcpERR_PARAMETER
        self.context.memory.check(self.pData, self.datalen)
        stored = idents[: self.datalen // _UDINT.size]
        return self._store(_Answer(ERR_OK, b"".join(_UDINT.pack(ident) for ident in stored)))

    def _store_max(self, most: int) -> int:
        if not self.pData or self.datalen != _UDINT.size:
            return interface.tcpERR_PARAMETER
        return self._store(_Answer(ERR_OK, _UDINT.pack(most)))
