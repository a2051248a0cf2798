"""The extension of the table [operator]."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from plcsim.operator.settings import OperatorSettings
from plcsim.operator.simulation import OperatorSimulation
from plcsim.project.extension import Attachment, Extension

if TYPE_CHECKING:
    from plcsim.core.controller import Controller
    from plcsim.settings.table import Table


class OperatorExtension(Extension):
    """Somebody at the panel, and a plant around the machine."""

    def read(self, table: Table) -> OperatorSettings:
        """Return the settings."""
        return table.read(OperatorSettings)

    def in_test(self, settings: OperatorSettings, ip: str) -> OperatorSettings:
        """Return the settings without steps: a test is the operator itself."""
        return replace(settings, steps=())

    def attach(self, settings: OperatorSettings, controller: Controller) -> Attachment:
        """Let them act in LATCH."""
        OperatorSimulation(settings, controller).hook_in()
        return Attachment()

    def check(self, settings: OperatorSettings, controller: Controller) -> tuple[str, ...]:
        """Check that the tags are there and take their values."""
        OperatorSimulation(settings, controller)
        return ()


EXTENSION = OperatorExtension()
