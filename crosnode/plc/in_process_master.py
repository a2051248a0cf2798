"""The embedded master inside the scan, where no process runs beside it: virtual clock and tests."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from crosnode.master.server import MasterOptions, MasterServer, first_parameters
from crosnode.plc.project import surroundings

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.core.task import TaskClass


class InProcessMaster(MasterServer):
    """``context.library(InProcessMaster)``; a restart of the controller makes another.

    Args:
        context: of a controller whose [ros] says ``master = "embedded"``.
    """

    def __init__(self, context: Context) -> None:
        found = surroundings(context)
        assert found is not None
        settings = found.settings
        super().__init__(
            context,
            MasterOptions(
                host=settings.host,
                port=settings.table.master_port,
                bind_ip=settings.bind_ip,
                pid=os.getpid(),
                parameters=first_parameters(f"plcsim-{os.getpid()}"),
                hosts=settings.hosts,
            ),
        )


class MasterStep:
    """Does the master's step in LATCH of a task class."""

    def __init__(self, context: Context, task_class: TaskClass) -> None:
        self._context = context
        self._class = task_class

    def __call__(self, task_class: TaskClass) -> None:
        """Do the step, where it is this class' turn."""
        if task_class is self._class:
            self._context.library(InProcessMaster).step()
