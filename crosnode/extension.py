"""The extension of the table [ros]: settings for nodes, the embedded master, the bridge."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from crosnode.bridge import Bridge
from crosnode.errors import CrosnodeError
from crosnode.master_server import DEFAULT_PORT
from crosnode.messages import MessageTypes
from crosnode.project import MASTER_IP, OPTIONS, EmbeddedMaster, Surroundings
from crosnode.settings import RosSettings, read_settings
from crosnode.uri import make_uri
from plcsim.errors import ConfigurationError
from plcsim.extension import Attachment

if TYPE_CHECKING:
    from crosnode.settings import Publication, Subscription
    from plcsim.context import Context
    from plcsim.controller import Controller
    from plcsim.table import Table
    from plcsim.task import TaskClass

HOSTS: Final = Path("/etc/hosts")


class RosExtension:
    """`plcsim.extension.Extension` of ROS 1."""

    service = ""

    def read(self, table: Table, folder: Path) -> RosSettings:
        """Return the settings; the types of the bridge are looked up."""
        text = HOSTS.read_text(errors="replace") if HOSTS.is_file() else ""
        settings = read_settings(table, folder, dict(os.environ), text)
        types = MessageTypes(settings.packages)
        entries: tuple[Publication | Subscription, ...] = (*settings.publish, *settings.subscribe)
        for entry in entries:
            try:
                types.message(entry.type_name)
            except CrosnodeError as error:
                raise table.error(f"{entry.topic}.type", str(error)) from None
        return settings

    def on_virtual_network(self, settings: RosSettings, ip: str) -> RosSettings:
        """Return the settings of a controller under test: addresses of that network, no ROS_*.

        The embedded master is at the controller's address, any other at ``MASTER_IP``.
        """
        host, port = (
            (ip, settings.master_port) if settings.is_embedded else (MASTER_IP, DEFAULT_PORT)
        )
        return settings._replace(
            master_uri=make_uri("http", host, port), host=ip, bind_ip="", environment={}
        )

    def attach(self, settings: RosSettings, controller: Controller) -> Attachment:
        """Leave the settings for programs; step the master and the bridge with the scan."""
        clock = controller.clock
        epoch_ns = 0 if clock.is_virtual else time.time_ns() - clock.now_ns()
        found = Surroundings(settings, epoch_ns, time.perf_counter_ns)
        controller.context.options[OPTIONS] = {"surroundings": found}
        first = min(controller.classes, key=lambda each: each.cycle_ns)
        if settings.is_embedded:
            controller.image.inputs.append(_MasterStep(controller.context, first))
        if settings.publish or settings.subscribe:
            step = _BridgeStep(controller, first)
            step.bridge()  # its types are compiled before the first cycle
            controller.image.inputs.append(step.latch)
            controller.image.watchers.append(step.publish)
        return Attachment()


class _MasterStep:
    """Does the embedded master's step in LATCH of the fastest class."""

    def __init__(self, context: Context, task_class: TaskClass) -> None:
        self._context = context
        self._class = task_class

    def __call__(self, task_class: TaskClass) -> None:
        if task_class is self._class:
            self._context.library(EmbeddedMaster).step()


class _BridgeStep:
    """Does the bridge's step with the fastest class; a restart of the controller makes another."""

    def __init__(self, controller: Controller, task_class: TaskClass) -> None:
        self._controller = controller
        self._class = task_class

    def bridge(self) -> Bridge:
        """Return the bridge of this start of the controller."""
        return self._controller.context.library(self._make)

    def _make(self, _context: Context) -> Bridge:
        try:
            return Bridge(self._controller)
        except CrosnodeError as error:
            raise ConfigurationError(f"ros: {error}") from None

    def latch(self, task_class: TaskClass) -> None:
        """Bring messages in."""
        if task_class is self._class:
            self.bridge().latch()

    def publish(self, task_class: TaskClass) -> None:
        """Send tags."""
        if task_class is self._class:
            self.bridge().publish(self._controller.context.release_ns)


EXTENSION = RosExtension()
