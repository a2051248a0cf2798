"""The server: sockets and their limits around `plcsim.modbus.service.connection`."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import ipaddress
import os
import sys
import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final, cast

from plcsim.core.errors import ConfigurationError
from plcsim.modbus.ports import remedy
from plcsim.modbus.service.connection import ModbusConnection, ModbusLimits
from plcsim.modbus.service.handler import AccessRights, Handler
from plcsim.modbus.service.listener import Listener, endpoint
from plcsim.modbus.service.tls import rights_of, role_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.modbus.service.device import Device
    from plcsim.modbus.settings import ModbusSettings

TICK_S: Final = 0.05
"""The server looks this often for timeouts and whether the scan is alive."""

HIGH_WATER: Final = 64 * 1024
"""Bytes of answers a peer may leave unread before its requests wait too."""


class Server:
    """Serves one device over TCP.

    Args:
        device: what is served.
        settings: of [modbus].
        now_ns: the clock of all timeouts.

    Attributes:
        port: the one it listens on.
        refused: connections refused by the allowlist or the limit.
        faults: connections closed because of what their peer sent.
    """

    def __init__(
        self,
        device: Device,
        settings: ModbusSettings,
        now_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self.device = device
        self.settings = settings
        self.port = 0
        self.refused = 0
        self.faults = 0
        self.now_ns = now_ns
        # a slow project needs longer: a write waits for its next LATCH
        timeout_ns = max(settings.write_timeout_ns, 3 * device.image.directory.cycle_ns)
        self.limits = ModbusLimits(frozenset(settings.unit_ids), timeout_ns)
        self.peers: set[_Peer] = set()
        self._networks = [ipaddress.ip_network(network) for network in settings.allow]
        self._listener: Listener | None = None
        self._ticker: asyncio.TimerHandle | None = None
        self._wake_fd = -1

    async def start(self, wake_fd: int = -1) -> None:
        """Listen, and look after the connections from now on.

        Args:
            wake_fd: an eventfd that the scan raises when it has acknowledged writes, -1 for none.

        Raises:
            ConfigurationError: the address cannot be listened on, or TLS is not set up.
        """
        loop = asyncio.get_running_loop()
        host, port = self.settings.host, self.settings.port
        try:
            self._listener = Listener(host, port, self.settings.tls, self._admit, self.faulty)
        except OSError as err:
            denied = isinstance(err, PermissionError)
            reason = remedy(port) if denied else os.strerror(err.errno or errno.EIO)
            raise ConfigurationError(
                f"modbus: cannot listen on {endpoint(host, port)}: {reason}"
            ) from None
        loop.set_exception_handler(self._report)
        self.port = self._listener.port
        if wake_fd >= 0:
            self._wake_fd = wake_fd
            loop.add_reader(wake_fd, self._woken)
        self._tick()

    def _woken(self) -> None:
        with contextlib.suppress(BlockingIOError):
            os.eventfd_read(self._wake_fd)
        self._pump_waiting()

    def _pump_waiting(self) -> None:
        self.device.collect()
        for peer in [peer for peer in self.peers if peer.connection.is_waiting]:
            peer.pump()

    def _tick(self) -> None:
        self._ticker = asyncio.get_running_loop().call_later(TICK_S, self._tick)
        now_ns = self.now_ns()
        self.device.tick(now_ns)
        self._pump_waiting()
        for peer in list(self.peers):
            peer.check_idle(now_ns)

    async def stop(self) -> None:
        """Close all connections and stop listening."""
        if self._ticker is not None:
            self._ticker.cancel()
        if self._wake_fd >= 0:
            asyncio.get_running_loop().remove_reader(self._wake_fd)
        if self._listener is not None:
            self._listener.close()
        for peer in list(self.peers):
            peer.abort()
        self.device.collect()
        await asyncio.sleep(0)

    def admits(self, host: str) -> bool:
        """Return True where one more connection from an address is welcome."""
        address = ipaddress.ip_address(host.partition("%")[0])
        mapped = getattr(address, "ipv4_mapped", None)
        known = not self._networks or any((mapped or address) in n for n in self._networks)
        if known and len(self.peers) + self._entering < self.settings.connections:
            return True
        self.refused += 1
        return False

    @property
    def _entering(self) -> int:
        """Connections that are being made; with TLS that may take a while."""
        entering = self._listener.entering if self._listener else {}
        return sum(protocol not in self.peers for protocol in entering)

    def _admit(self, host: str, port: int) -> _Peer | None:
        return _Peer(self, endpoint(host, port)) if self.admits(host) else None

    def rights_of(self, role: str) -> AccessRights:
        """Return what a peer may do."""
        roles = self.settings.tls.roles if self.settings.tls else {}
        rights = rights_of(role, roles)
        return replace(rights, may_write=rights.may_write and not self.settings.read_only)

    def _report(self, _loop: object, context: dict[str, Any]) -> None:
        """Take what asyncio would log, such as a failed handshake, without filling a disk."""
        error = context.get("exception")
        self.faulty("asyncio", f"{context['message']}{f': {error!r}' if error else ''}")

    def faulty(self, peer: str, fault: str) -> None:
        """Count a connection that is closed for what its peer sent; the first few are printed."""
        self.faults += 1
        if self.faults <= 10:
            sys.stderr.write(f"modbus: {peer}: {fault}; closed\n")


class _Peer(asyncio.Protocol):
    """One connection and its socket."""

    connection: ModbusConnection
    _transport: asyncio.Transport

    def __init__(self, server: Server, name: str) -> None:
        self.name = name
        self._server = server
        self._is_blocked = False
        self._is_paused = False
        self._is_scheduled = False
        self._is_ending = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Get ready for requests."""
        self._transport = cast("asyncio.Transport", transport)
        self._transport.set_write_buffer_limits(HIGH_WATER)
        server = self._server
        role = _role(transport) if server.settings.tls and server.settings.tls.roles else ""
        handler = Handler(server.device, server.rights_of(role), self.name, role)
        self.connection = ModbusConnection(handler, server.device, server.limits, server.now_ns())
        server.peers.add(self)

    def connection_lost(self, _exc: Exception | None) -> None:
        """Forget the peer; writes that are queued are still applied."""
        self._server.peers.discard(self)

    def data_received(self, data: bytes) -> None:
        """Execute what has come."""
        self.connection.receive(data)
        self.pump()

    def eof_received(self) -> bool:
        """Keep a peer that sends no more until it has its answers; TLS knows no such state."""
        self._is_ending = self._server.settings.tls is None
        return self._is_ending and self._is_busy

    @property
    def _is_busy(self) -> bool:
        return self.connection.is_waiting or self.connection.has_more

    def pause_writing(self) -> None:
        """Let requests wait while the peer does not read its answers."""
        self._is_blocked = True

    def resume_writing(self) -> None:
        """Go on where the peer has read."""
        self._is_blocked = False
        self.pump()

    def pump(self) -> None:
        """Execute some requests, send answers, and see to it that the rest gets its turn."""
        connection = self.connection
        if self._transport.is_closing():
            return
        if not self._is_blocked:
            answers = connection.step(self._server.now_ns())
            if answers:
                self._transport.write(answers)
            if connection.fault:
                self._server.faulty(self.name, connection.fault)
                self._transport.close()
                return
            if connection.has_more and not self._is_scheduled:
                self._is_scheduled = True
                asyncio.get_running_loop().call_soon(self._pump_rest)
        if self._is_ending and not self._is_busy:
            self._transport.close()
            return
        self._throttle()

    def _pump_rest(self) -> None:
        self._is_scheduled = False
        self.pump()

    def _throttle(self) -> None:
        """Stop reading the socket while more requests wait than are needed to stay busy."""
        if self.connection.is_full != self._is_paused:
            self._is_paused = not self._is_paused
            if self._is_paused:
                self._transport.pause_reading()
            else:
                self._transport.resume_reading()

    def check_idle(self, now_ns: int) -> None:
        """Close a connection that has not sent a complete request for too long."""
        if now_ns - self.connection.last_request_ns > self._server.settings.idle_ns:
            self._transport.abort()

    def abort(self) -> None:
        """Close at once."""
        self._transport.abort()


def _role(transport: asyncio.BaseTransport) -> str:
    tls: Any = transport.get_extra_info("ssl_object")
    return role_of(tls.getpeercert(binary_form=True)) if tls else ""
