"""The server of the OPC UA service process: asyncua's, with the controller behind it."""

from __future__ import annotations

import asyncio
import errno
import os
import platform
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from asyncua import Server, ua
from asyncua.common.callback import CallbackType

from plcsim.access import Users
from plcsim.access.users import users_file
from plcsim.core.errors import ConfigurationError
from plcsim.host import descriptors
from plcsim.opcua.extension import branches_of
from plcsim.opcua.service.address_space import Nodes
from plcsim.opcua.service.attributes import Attributes
from plcsim.opcua.service.audit import WriteLog
from plcsim.opcua.service.connections import OpcuaServer
from plcsim.opcua.service.people import People, trust
from plcsim.opcua.service.readings import Readings
from plcsim.opcua.service.security import policies, set_certificate
from plcsim.opcua.settings import OpcuaProject, settings_from
from plcsim.settings import is_loopback

if TYPE_CHECKING:
    from collections.abc import Iterable

    from plcsim.opcua.settings import OpcuaSettings
    from plcsim.process.service_main import Service

FOLDER: Final = ".plcsim/opcua"
"""Of the server's certificate and key."""

LARGEST_MESSAGE: Final = 4 * 1024 * 1024
MOST_UNREAD: Final = 8 * 1024 * 1024
"""Bytes of answers that a client leaves unread; then its connection is cut off."""

COLLECT_S: Final = 0.05
"""Answers of the scan are looked for at least so often."""


async def run(service: Service) -> None:
    """Serve the address space until asked to stop.

    Raises:
        ConfigurationError: the address cannot be listened on.
    """
    given, image = service.given, service.image
    project = OpcuaProject(settings_from(given["settings"]), Path(given["folder"]))
    settings = project.settings
    descriptors.allow(settings.connections + descriptors.SPARE)
    stopped = asyncio.Event()
    asyncio.get_running_loop().add_reader(service.stop_fd, stopped.set)
    server = await _server(project, image.directory.project)
    nodes = Nodes(server, image.directory.project)
    await nodes.make(branches_of(project, image.directory.areas))
    readings = Readings(image, lambda: service.page.state.value, nodes.codecs)
    with WriteLog(project.folder) as log:
        attributes = Attributes(
            server.iserver.aspace,
            readings,
            image,
            settings.write_timeout_ns / 1e9,
            log.applied,
            log.refused,
        )
        _connect(server, attributes, readings)
        await _start(server, settings)
        text = f"serving {len(nodes.codecs)} variables on {server.endpoint.geturl()}"
        service.serving(text)
        tasks = [
            asyncio.create_task(_collect(attributes, service.wake_fd)),
            asyncio.create_task(_report(readings, server, settings.sampling_ns / 1e9)),
        ]
        await stopped.wait()
        for task in tasks:
            task.cancel()
        await server.stop()


async def _server(project: OpcuaProject, name: str) -> Server:
    """Return a server with certificate, users and limits, without the controller's nodes."""
    settings = project.settings
    people = People(
        Users(users_file(project.folder)),
        is_loopback=is_loopback(settings.host),
        may_look=settings.anonymous,
    )
    server = OpcuaServer(user_manager=people)
    server.name = f"plcsim {name}"
    server.manufacturer_name = server.product_uri = "plcsim"
    server.limits.max_message_size = LARGEST_MESSAGE
    server.iserver.max_connections = settings.connections
    server.iserver.match_discovery_source_ip = False
    await server.init()
    await server.set_application_uri(f"urn:{platform.node()}:plcsim:{name}")
    await set_certificate(server, project.folder / FOLDER)
    server.set_security_policy(policies(settings.security))
    if settings.trusted:
        server.iserver.certificate_validator = await trust(project.folder / settings.trusted)
    return server


def _connect(server: Server, attributes: Attributes, readings: Readings) -> None:
    """Let asyncua's services use our attributes and tell of subscriptions."""
    server.iserver.attribute_service = attributes
    space = server.iserver.aspace
    value = ua.AttributeIds.Value
    for node in readings.codecs:
        space.set_attribute_value_callback(node, value, readings.current)
        space.set_attribute_value_setter(node, value, _keep_nothing)

    def created(event: Any, _dispatcher: Any = None) -> None:
        items = event.request_params.ItemsToCreate
        readings.monitor(item.ItemToMonitor.NodeId for item in items)

    server.subscribe_server_callback(CallbackType.ItemSubscriptionCreated, created)


def _keep_nothing(*_: Any) -> None:
    """Hold no value: a variable is read from the controller each time."""


async def _start(server: Server, settings: OpcuaSettings) -> None:
    server.set_endpoint(f"opc.tcp://{_named(settings.host)}:{settings.port}")
    server.socket_address = (settings.host, settings.port)
    try:
        await server.start()
    except OSError as err:
        reason = os.strerror(err.errno) if err.errno else str(err)
        hint = "; another program listens there" if err.errno == errno.EADDRINUSE else ""
        raise ConfigurationError(f"opcua: {settings.endpoint}: {reason}{hint}") from None


def _named(host: str) -> str:
    return f"[{host}]" if ":" in host else host


async def _collect(attributes: Attributes, wake_fd: int) -> None:
    """Take the scan's answers when it says that there are some, and now and then."""
    woken = asyncio.Event()
    asyncio.get_running_loop().add_reader(wake_fd, woken.set)
    while True:
        with suppress(TimeoutError):
            await asyncio.wait_for(woken.wait(), COLLECT_S)
        if woken.is_set():
            woken.clear()
            with suppress(BlockingIOError):
                os.eventfd_read(wake_fd)
        attributes.collect()


async def _report(readings: Readings, server: Server, period_s: float) -> None:
    """Hand changes to the subscriptions, once a sampling interval.

    Where there are more than the processor can carry, less often: connections have half the time.
    """
    while True:
        begun_s = time.monotonic()
        await readings.report(server.iserver.aspace)
        cut_off(server.iserver.asyncio_transports)
        spent_s = time.monotonic() - begun_s
        await asyncio.sleep(max(period_s - spent_s, spent_s))


def cut_off(transports: Iterable[asyncio.Transport]) -> None:
    """End the connections of clients that ask on and on and read no answer."""
    for transport in list(transports):
        if transport.get_write_buffer_size() > MOST_UNREAD:
            transport.abort()
