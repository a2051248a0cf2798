"""Connections: so many at once, none with a chunk that is too long, each with limits of its own.

asyncua keeps one object of limits for all connections, and what one client negotiates becomes
everybody's; it waits for a chunk as long as a header says, and keeps what comes until then; and it
closes without a word where there is no room. All three are set right here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Final

from asyncua import Server, ua
from asyncua.server.binary_server_asyncio import BinaryServer, OPCUAProtocol
from asyncua.ua.ua_binary import uatcp_to_binary

_HEADER: Final = 8
"""Bytes of a chunk's header, with its length at 4 (OPC 10000-6, 7.1.2.2)."""


class OpcuaConnection(OPCUAProtocol):
    """One client."""

    _buffer: bytes

    def __init__(self, **given: Any) -> None:
        super().__init__(**{**given, "limits": replace(given["limits"])})

    def connection_made(self, transport: Any) -> None:
        """Take a client where there is room; tell it otherwise."""
        if len(self.clients) >= self.iserver.max_connections:
            transport.write(error(ua.StatusCodes.BadTcpServerTooBusy, "opcua.connections"))
        super().connection_made(transport)

    def data_received(self, data: bytes) -> None:
        """Take bytes of the client; end where a chunk is longer than it may be."""
        if self.transport is None or self.transport.is_closing():
            return
        super().data_received(data)
        length = int.from_bytes(self._buffer[4:_HEADER], "little")
        if len(self._buffer) >= _HEADER and length > self.limits.max_recv_buffer:
            self._buffer = b""
            reason = f"a chunk of {length} bytes, {self.limits.max_recv_buffer} at most"
            self.transport.write(error(ua.StatusCodes.BadTcpMessageTooLarge, reason))
            self.transport.close()


class _Listener(BinaryServer):
    """Listens, and makes a connection of each client."""

    def _make_protocol(self) -> OpcuaConnection:
        return OpcuaConnection(
            iserver=self.iserver,
            policies=self._policies,
            clients=self.clients,
            closing_tasks=self.closing_tasks,
            limits=self.limits,
        )


class OpcuaServer(Server):
    """asyncua's server with the connections of this module."""

    async def start(self) -> None:
        """Listen.

        Raises:
            OSError: the address cannot be listened on.
        """
        await self._setup_server_nodes()
        await self.iserver.start()
        host, port = self._get_bind_socket_info()
        self.bserver = _Listener(self.iserver, host, port, self.limits)
        self.bserver.set_policies(self._policies)
        try:
            await self.bserver.start()
        except OSError:
            await self.iserver.stop()
            raise


def error(code: int, reason: str) -> bytes:
    """Return the message before a connection is closed (OPC 10000-6, 7.1.2.5)."""
    message = ua.ErrorMessage()
    message.Error = ua.StatusCode(code)
    message.Reason = reason
    data: bytes = uatcp_to_binary(ua.MessageType.Error, message)
    return data
