"""Connections: so many at once, and none that says nothing for long."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, Final

from uvicorn.protocols.http.h11_impl import H11Protocol

if TYPE_CHECKING:
    from asyncio import TimerHandle

FIRST_REQUEST_S: Final = 10.0
"""A peer has so long to ask for something."""

_FULL: Final = (
    b"HTTP/1.1 503 Service Unavailable\r\nconnection: close\r\n"
    b"content-type: text/plain\r\ncontent-length: 42\r\n\r\n"
    b"too many connections; see web.connections\n"
)


def limited_protocol(most: int) -> type[asyncio.Protocol]:
    """Return uvicorn's protocol for at most so many connections, WebSockets included."""

    class LimitedProtocol(H11Protocol):
        """Refuses a peer where there is no room, and lets go of one that asks for nothing."""

        _silence: TimerHandle | None = None

        def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # as in uvicorn
            """Take a peer, where there is room."""
            super().connection_made(transport)
            if len(self.connections) > most:
                transport.write(_FULL)
                transport.close()
                return
            self._silence = asyncio.get_running_loop().call_later(FIRST_REQUEST_S, transport.close)

        def handle_events(self) -> None:
            """Go on with what was read; a whole request has been heard once there is a scope."""
            super().handle_events()
            if self._silence is not None and self.cycle is not None:
                self._silence.cancel()
                self._silence = None

        def handle_websocket_upgrade(self, event: Any) -> None:
            """Hand the connection on."""
            if self._silence is not None:
                self._silence.cancel()
                self._silence = None
            super().handle_websocket_upgrade(event)

        def connection_lost(self, exc: Exception | None) -> None:
            """Forget the peer."""
            if self._silence is not None:
                self._silence.cancel()
            super().connection_lost(exc)

    return LimitedProtocol
