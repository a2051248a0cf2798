"""The process of the pages; `plcsim.process.service_main` calls `serve`."""

from __future__ import annotations

import asyncio
import contextlib
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

import uvicorn

from plcsim.access.users import Users, users_file
from plcsim.host import descriptors
from plcsim.web.service.app import LARGEST_MESSAGE, make_app
from plcsim.web.service.door import Door
from plcsim.web.service.hub import Hub
from plcsim.web.service.listener import bound_socket, check_users, tls_context
from plcsim.web.service.protocol import limited_protocol
from plcsim.web.settings import settings_from

if TYPE_CHECKING:
    from collections.abc import Iterator

    from plcsim.process.service_main import Service
    from plcsim.web.settings import WebSettings


BACKLOG: Final = 128
"""Connections that are taken at once before those that find no room are closed."""

ENOUGH_S: Final = 1.0
"""A scan that runs has answered by then."""


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
    check_users(settings, users)
    context = None if settings.tls is None else tls_context(settings.tls)
    descriptors.allow(2 * settings.connections + descriptors.SPARE)
    hub = Hub(service)
    listening = bound_socket(settings)
    config = _config(settings, hub, Door(settings, users))
    config.load()
    config.ssl = context
    server = _Server(config)
    loop = asyncio.get_running_loop()
    loop.add_reader(service.stop_fd, lambda: setattr(server, "should_exit", True))
    reading = asyncio.create_task(hub.run())
    url = replace(settings, port=listening.getsockname()[1]).url
    service.serving(url if users else f"{url}  (no users: this machine alone, as engineer)")
    try:
        await server.serve([listening])
        if hub.acting:  # what was asked for last has its line in the audit log, too
            await asyncio.wait(hub.acting, timeout=ENOUGH_S)
    finally:
        reading.cancel()
        await asyncio.gather(reading, return_exceptions=True)
        hub.audit.close()


def _config(settings: WebSettings, hub: Hub, door: Door) -> uvicorn.Config:
    return uvicorn.Config(
        make_app(hub, door),
        http=limited_protocol(settings.connections),
        ws="websockets-sansio",
        lifespan="off",
        log_config=None,
        log_level="critical",  # what peers send that is wrong is their own affair
        access_log=False,
        server_header=False,
        date_header=False,
        proxy_headers=False,
        ws_max_size=LARGEST_MESSAGE,
        ws_ping_interval=20.0,
        ws_ping_timeout=20.0,
        timeout_keep_alive=30,
        backlog=BACKLOG,
        timeout_graceful_shutdown=1,
    )
