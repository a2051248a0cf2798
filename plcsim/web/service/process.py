"""The process of the pages; `plcsim.process.service_main` calls `serve`."""

from __future__ import annotations

import asyncio
import contextlib
import socket
from pathlib import Path
from typing import TYPE_CHECKING

import uvicorn

from plcsim.access.users import Users, users_file
from plcsim.core.errors import ConfigurationError
from plcsim.host import descriptors
from plcsim.web.service.app import LARGEST_MESSAGE, make_app
from plcsim.web.service.door import Door
from plcsim.web.service.hub import Hub
from plcsim.web.service.protocol import limited_protocol
from plcsim.web.settings import settings_from

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.process.service_main import Service
    from plcsim.web.settings import WebSettings


class _Server(uvicorn.Server):
    """A server whose process has handlers of its own for signals."""

    @contextlib.contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Leave the signals alone."""
        yield


def serve(service: Service) -> None:
    """Serve the pages until asked to stop.

    Raises:
        ConfigurationError: the address cannot be listened on, or nobody could log in.
    """
    asyncio.run(_serve(service))


async def _serve(service: Service) -> None:
    settings = settings_from(service.given["settings"])
    users = Users(users_file(Path(service.given["folder"])))
    if not (settings.is_loopback or users):
        raise ConfigurationError(
            f"web.host: {settings.host} is reached from other machines, and there are no users; "
            "plcsim users add NAME --role engineer"
        )
    descriptors.allow(2 * settings.connections + descriptors.SPARE)
    hub = Hub(service)
    listening = _listen(settings)
    server = _Server(_config(settings, hub, Door(settings, users)))
    loop = asyncio.get_running_loop()
    loop.add_reader(service.stop_fd, lambda: setattr(server, "should_exit", True))
    reading = asyncio.create_task(hub.run())
    host, port = listening.getsockname()[:2]
    where = f"[{host}]" if ":" in host else host
    service.serving(f"http://{where}:{port}{_who(settings, users)}")
    try:
        await server.serve([listening])
    finally:
        reading.cancel()
        await asyncio.gather(reading, return_exceptions=True)
        hub.audit.close()


def _who(_settings: WebSettings, users: Users) -> str:
    return "" if users else "  (no users: this machine alone, as engineer)"


def _listen(settings: WebSettings) -> socket.socket:
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listening = socket.socket(family, socket.SOCK_STREAM)
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((settings.host, settings.port))
    except OSError as err:
        listening.close()
        raise ConfigurationError(
            f"web.port: {settings.host} port {settings.port}: {err.strerror}"
        ) from None
    return listening


def _config(settings: WebSettings, hub: Hub, door: Door) -> uvicorn.Config:
    return uvicorn.Config(
        make_app(hub, door),
        http=limited_protocol(settings.connections),
        ws="websockets-sansio",
        lifespan="off",
        log_config=None,
        access_log=False,
        server_header=False,
        date_header=False,
        proxy_headers=False,
        ws_max_size=LARGEST_MESSAGE,
        ws_ping_interval=20.0,
        ws_ping_timeout=20.0,
        timeout_keep_alive=30,
        timeout_graceful_shutdown=1,
    )
