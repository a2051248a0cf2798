"""Library AsIODiag: this controller is simulated, and no module is plugged into it."""

from __future__ import annotations

from typing import Final

from plcsim.library.asiodiag import interface
from plcsim.library.asiodiag.interface import (
    asdiagALL,
    asdiagERR_IDENT,
    asdiagERR_INDEX,
    asdiagERR_INFOKIND,
    asdiagPLUGGED,
)
from plcsim.library.block import SynchronousBlock
from plcsim.library.runtime import ERR_OK

EMPTY_LIST: Final = 1
"""Ident of every list of modules: none has an entry."""


class DiagCreateInfo(interface.DiagCreateInfo, SynchronousBlock):
    """A list of modules, without any. Inputs: enable, infoKind. Outputs: status, ident, nrEntries.

    Statuses: ERR_OK, asdiagERR_INFOKIND.
    """

    def step(self) -> int:
        """Make the list."""
        if not asdiagPLUGGED <= self.infoKind <= asdiagALL:
            return asdiagERR_INFOKIND
        self.ident, self.nrEntries = EMPTY_LIST, 0
        return ERR_OK


class DiagDisposeInfo(interface.DiagDisposeInfo, SynchronousBlock):
    """Forget a list. Inputs: enable, ident. Output: status. Statuses: ERR_OK, asdiagERR_IDENT."""

    def step(self) -> int:
        """Forget the list."""
        return ERR_OK if self.ident == EMPTY_LIST else asdiagERR_IDENT


class DiagGetNumInfo(interface.DiagGetNumInfo, SynchronousBlock):
    """A number about a module: there is none. Statuses: asdiagERR_IDENT, asdiagERR_INDEX."""

    def step(self) -> int:
        """Look for the module."""
        return asdiagERR_INDEX if self.ident == EMPTY_LIST else asdiagERR_IDENT


class DiagGetStrInfo(interface.DiagGetStrInfo, SynchronousBlock):
    """A text about a module: there is none. Statuses: asdiagERR_IDENT, asdiagERR_INDEX."""

    def step(self) -> int:
        """Look for the module."""
        return asdiagERR_INDEX if self.ident == EMPTY_LIST else asdiagERR_IDENT
