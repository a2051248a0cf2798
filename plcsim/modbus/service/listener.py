"""The listening socket: every peer is judged before anything is spent on it.

asyncio's own server makes a transport for each peer, and with TLS a handshake, before a protocol
sees its address; a peer that never finishes the handshake would count nowhere.
"""

from __future__ import annotations

import asyncio
import socket
from typing import TYPE_CHECKING, Final

from plcsim.modbus.service.tls import server_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.modbus.settings import TlsSettings

BACKLOG: Final = 1024
"""Peers that may wait to be taken; a peer beyond has to ask again after a second."""

AT_ONCE: Final = 128
"""So many peers are taken before connections have their turn again."""

PAUSE_S: Final = 1.0
"""No peer is taken for so long where the system has no descriptor left."""


HANDSHAKE_S: Final = 10.0
"""A peer has this long to finish the handshake of TLS."""


def endpoint(host: str, port: int) -> str:
    """Return an address as people write it; an IPv4 peer of an IPv6 socket as IPv4."""
    host = host.removeprefix("::ffff:")
    return f"[{host}]:{port}" if ":" in host else f"{host}:{port}"


class Listener:
    """Takes peers until it is closed.

    Args:
        host: IP address; "::" takes IPv4 as well.
        port: of TCP, 0 for any free one.
        tls: None for plain TCP.
        admit: gives the protocol for a peer's address and port, None to refuse the peer.
        fail: told which peer did not get in, and why.

    Attributes:
        port: the one it listens on.
        entering: protocols of peers that are let in at the moment.

    Raises:
        ConfigurationError: TLS is not set up.
        OSError: the address cannot be listened on.
    """

    def __init__(
        self,
        host: str,
        port: int,
        tls: TlsSettings | None,
        admit: Callable[[str, int], asyncio.Protocol | None],
        fail: Callable[[str, str], None],
    ) -> None:
        self._tls = server_context(tls) if tls else None
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        self._socket = socket.create_server(
            (host, port), family=family, backlog=BACKLOG, dualstack_ipv6=host == "::"
        )
        self._socket.settimeout(0)
        self._admit = admit
        self._fail = fail
        self.entering: dict[asyncio.Protocol, asyncio.Task[None]] = {}
        self._pause: asyncio.TimerHandle | None = None
        self.port: int = self._socket.getsockname()[1]
        self._listen()

    def _listen(self) -> None:
        asyncio.get_running_loop().add_reader(self._socket.fileno(), self._ready)

    def _ready(self) -> None:
        for _ in range(AT_ONCE):
            try:
                client, address = self._socket.accept()
            except (BlockingIOError, ConnectionAbortedError):
                return
            except OSError as err:
                self._fail("listener", f"no connection can be taken for now: {err}")
                self._rest()
                return
            protocol = self._admit(*address[:2])
            if protocol is None:
                client.close()
                continue
            client.settimeout(0)
            entering = self._enter(client, protocol, endpoint(*address[:2]))
            self.entering[protocol] = asyncio.get_running_loop().create_task(entering)

    async def _enter(self, client: socket.socket, protocol: asyncio.Protocol, name: str) -> None:
        try:
            await asyncio.get_running_loop().connect_accepted_socket(
                lambda: protocol,
                client,
                ssl=self._tls,
                ssl_handshake_timeout=HANDSHAKE_S if self._tls else None,
            )
        except (OSError, RuntimeError) as err:  # uvloop's error for a peer that has gone already
            self._fail(name, f"the connection failed: {err}")
        finally:
            del self.entering[protocol]

    def _rest(self) -> None:
        """Look again later: the socket stays ready, so waiting for it would be a busy loop."""
        loop = asyncio.get_running_loop()
        loop.remove_reader(self._socket.fileno())
        self._pause = loop.call_later(PAUSE_S, self._listen)

    def close(self) -> None:
        """Stop listening; who is not in yet stays outside."""
        for task in self.entering.values():
            task.cancel()
        if self._pause is not None:
            self._pause.cancel()
        if self._socket.fileno() >= 0:
            asyncio.get_running_loop().remove_reader(self._socket.fileno())
            self._socket.close()
