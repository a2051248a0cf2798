"""The extension of the table [ros]: settings for nodes, the embedded master, the bridge."""

from __future__ import annotations

import os
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.errors import CrosnodeError
from crosnode.graph.dns import NameServers, parse_name_servers
from crosnode.graph.hosts import hosts_text
from crosnode.graph.uri import DEFAULT_PORT, make_uri
from crosnode.messages import MessageTypes
from crosnode.node.ros_time import Epoch
from crosnode.plc.bridge import Bridge
from crosnode.plc.node_watch import NodeWatch
from crosnode.plc.project import MASTER_IP, RosContext, surroundings
from crosnode.plc.settings import RosSettings, read_settings
from plcsim.core.errors import ConfigurationError, Findings
from plcsim.project.extension import Attachment, Extension

if TYPE_CHECKING:
    from collections.abc import Callable

    from crosnode.master.server import MasterServer
    from plcsim.core.context import Context
    from plcsim.core.controller import Controller
    from plcsim.core.task import TaskClass
    from plcsim.settings.table import Table

RESOLV: Final = Path("/etc/resolv.conf")
LOOK_NS: Final = 500_000_000
"""Nanoseconds between two looks at masters and at the wall clock."""

CHECK_IP: Final = "192.168.0.10"
"""Of the controller of `RosExtension.check`, on a network with nobody else."""


class RosExtension(Extension):
    """Nodes, the embedded master, the bridge."""

    def read(self, table: Table) -> RosSettings:
        """Return the settings; the types of the bridge are looked up."""
        text = hosts_text()
        servers = RESOLV.read_text(errors="replace") if RESOLV.is_file() else ""
        settings = replace(
            read_settings(table, dict(os.environ), text), name_servers=parse_name_servers(servers)
        )
        types = MessageTypes(settings.packages)
        findings = Findings()
        keys = settings.table
        for key, topics in (("publish", keys.publish), ("subscribe", keys.subscribe)):
            for topic, entry in topics.items():
                if misfit := _misfit(types, entry.type_name):
                    findings.add(table.error(f"{key}.{topic}.type", misfit))
        for key, services in (("services", keys.services), ("calls", keys.calls)):
            for name, service in services.items():
                try:
                    types.service(service.type_name)
                except CrosnodeError as error:
                    findings.add(table.error(f"{key}.{name}.type", str(error)))
        findings.check()
        return settings

    def in_process(self, settings: RosSettings, ip: str) -> RosSettings:
        """Return the settings with an embedded master in the scan; see `Extension`.

        On a virtual network all addresses are those of that network, and no ROS_* counts: an
        embedded master is at the controller's address, any other at ``MASTER_IP``.
        """
        settings = replace(settings, is_in_process=True)
        if not ip:
            return settings
        own = (ip, settings.table.master_port)
        host, port = own if settings.is_embedded else (MASTER_IP, DEFAULT_PORT)
        uri = make_uri("http", host, port)
        return replace(
            settings, master_uri=uri, host=ip, bind_ip=None, ipv6=":" in ip, environment={},
            name_servers=NameServers(),
        )  # fmt: skip

    def service(self, settings: RosSettings) -> str:
        """Return the module of the embedded master, where it runs in a process of its own."""
        if settings.is_embedded and not settings.is_in_process:
            return "crosnode.plc.master_service"
        return ""

    def endpoint(self, settings: RosSettings) -> str:
        """Return the URI of the embedded master."""
        return settings.master_uri

    def attach(self, settings: RosSettings, controller: Controller) -> Attachment:
        """Leave the settings for programs; step the bridge, and a master in the scan, with it."""
        clock, first = controller.clock, min(controller.classes, key=lambda each: each.cycle_ns)
        found = RosContext(settings, Epoch(), time.perf_counter_ns)
        if not clock.is_virtual:
            found.epoch.ns = clock.unix_ns() - clock.now_ns()
            controller.image.watchers.append(_NowAndThen(controller, first, _follow_wall_clock))
        if settings.is_embedded and settings.is_in_process:
            found = found._replace(master=_master_in_scan(controller, first))
        controller.context.give_settings(found)
        if settings.table.has_bridge:
            step = _BridgeStep(controller, first, settings.file)
            step.bridge()  # its types are compiled before the first cycle
            controller.image.inputs.append(step.latch)
            controller.image.watchers.append(step.publish)
        controller.image.watchers.append(_NowAndThen(controller, first, _watch_nodes))
        return Attachment(_for_service(settings))

    def check(self, settings: RosSettings, controller: Controller) -> list[str]:
        """Check the bridge against the tags, as a run does before its first cycle."""
        self.attach(self.in_process(settings, CHECK_IP), controller)
        return []


def _for_service(settings: RosSettings) -> dict[str, object]:
    """Return what `crosnode.plc.master_service` is told."""
    return {
        "file": str(settings.file),
        "host": settings.host,
        "port": settings.table.master_port,
        "bind_ip": settings.bind_ip,
        "ipv6": settings.ipv6,
        "hosts": dict(settings.hosts),
    }


def _misfit(types: MessageTypes, name: str) -> str:
    """Return why a topic cannot have a type, "" where it can."""
    try:
        types.message(name)
    except CrosnodeError as error:
        try:
            types.service(name)
        except CrosnodeError:
            return str(error)
        return f"{name} is a service; topics have messages"
    return ""


def _master_in_scan(
    controller: Controller, task_class: TaskClass
) -> Callable[[Context], MasterServer]:
    """Let the master do its step in LATCH; return what makes it."""
    # not at the top: beside a master in its own process the scan has no use for it
    from crosnode.plc.in_process_master import InProcessMaster, MasterStep  # noqa: PLC0415

    controller.image.inputs.append(MasterStep(controller.context, task_class))
    return InProcessMaster


class _NowAndThen:
    """Does something in PUBLISH of a task class, about twice a second.

    Args:
        controller: whose class it is.
        task_class: the fastest.
        act: called with the controller.
    """

    def __init__(
        self, controller: Controller, task_class: TaskClass, act: Callable[[Controller], None]
    ) -> None:
        self._controller = controller
        self._class = task_class
        self._act = act
        self._next_ns = 0

    def __call__(self, task_class: TaskClass) -> None:
        now_ns = self._controller.context.release_ns
        if task_class is self._class and now_ns >= self._next_ns:
            self._next_ns = now_ns + LOOK_NS
            self._act(self._controller)


def _watch_nodes(controller: Controller) -> None:
    """Tell whether the nodes of the programs have their master."""
    context = controller.context
    for severity, text in context.library(NodeWatch).look(context.release_ns):
        controller.log(severity, "ros", text)


def _follow_wall_clock(controller: Controller) -> None:
    """Let ROS time go with the host's time of day, which may be set while the PLC runs."""
    found, clock = surroundings(controller.context), controller.clock
    if found:
        found.epoch.follow(clock.now_ns(), clock.unix_ns(), clock.now_ns())


class _BridgeStep:
    """Does the bridge's step with the fastest class; a restart of the controller makes another."""

    def __init__(self, controller: Controller, task_class: TaskClass, file: Path) -> None:
        self._controller = controller
        self._class = task_class
        self._file = file

    def bridge(self) -> Bridge:
        """Return the bridge of this start of the controller."""
        return self._controller.context.library(self._make)

    def _make(self, _context: Context) -> Bridge:
        try:
            return Bridge(self._controller)
        except CrosnodeError as error:
            raise ConfigurationError(f"{self._file}: ros: {error}") from None

    def latch(self, task_class: TaskClass) -> None:
        """Bring messages in."""
        if task_class is self._class:
            self.bridge().latch()

    def publish(self, task_class: TaskClass) -> None:
        """Send tags."""
        if task_class is self._class:
            self.bridge().publish(self._controller.context.release_ns)


EXTENSION = RosExtension()
