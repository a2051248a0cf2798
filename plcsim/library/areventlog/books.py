"""Blocks that make, find and delete logbooks."""

from __future__ import annotations

from plcsim.library.areventlog import interface
from plcsim.library.areventlog.block import (
    AsynchronousEventLogBlock,
    EventLogBlock,
)
from plcsim.library.areventlog.interface import (
    arEVENTLOG_ERR_IDENT_SYSTEM,
    arEVENTLOG_ERR_INTERNAL,
    arEVENTLOG_ERR_LOGBOOK_EXISTS,
    arEVENTLOG_ERR_LOGBOOK_NOT_FOUND,
    arEVENTLOG_ERR_NAME_INVALID,
    arEVENTLOG_ERR_PERSISTENCE_INVAL,
    arEVENTLOG_ERR_SIZE_INVALID,
    arEVENTLOG_PERSISTENCE_PERSIST,
)
from plcsim.library.areventlog.logs import RECORD_SIZE, USER, EventLog
from plcsim.library.block import StatusError

LARGEST: int = 16 * 1024 * 1024
"""Bytes of a logbook."""


class ArEventLogCreate(interface.ArEventLogCreate, AsynchronousEventLogBlock):
    """Make a logbook. Inputs: Execute, Name, Size, Persistence, Info. Outputs: Ident, StatusID.

    A restart forgets it, whatever Persistence is. Where there is one of this name, Ident is its.
    StatusID: arEVENTLOG_ERR_LOGBOOK_EXISTS, _NAME_INVALID, _SIZE_INVALID, _PERSISTENCE_INVAL,
    _INTERNAL (too many).
    """

    def act(self) -> None:
        """Make it."""
        self.Ident = 0
        if not self.Name:
            raise StatusError(arEVENTLOG_ERR_NAME_INVALID)
        if self.Persistence > arEVENTLOG_PERSISTENCE_PERSIST:
            raise StatusError(arEVENTLOG_ERR_PERSISTENCE_INVAL)
        if not RECORD_SIZE <= self.Size <= LARGEST:
            raise StatusError(arEVENTLOG_ERR_SIZE_INVALID)
        self.Ident = self.logs.named(self.Name)
        if self.Ident:
            raise StatusError(arEVENTLOG_ERR_LOGBOOK_EXISTS)
        if self.logs.full:
            raise StatusError(arEVENTLOG_ERR_INTERNAL)
        self.Ident = self.logs.add(EventLog(self.Name, self.Size))


class ArEventLogDelete(interface.ArEventLogDelete, AsynchronousEventLogBlock):
    """Delete a logbook of ArEventLogCreate. StatusID: _IDENT_INVALID, _IDENT_SYSTEM."""

    def act(self) -> None:
        """Delete it."""
        if self.log.is_system or self.log.name == USER:
            raise StatusError(arEVENTLOG_ERR_IDENT_SYSTEM)
        self.logs.remove(self.Ident)


class ArEventLogGetIdent(interface.ArEventLogGetIdent, EventLogBlock):
    """Find a logbook by its name. Output: Ident. StatusID: arEVENTLOG_ERR_LOGBOOK_NOT_FOUND."""

    def act(self) -> None:
        """Find it."""
        self.Ident = self.logs.named(self.Name)
        if not self.Ident:
            raise StatusError(arEVENTLOG_ERR_LOGBOOK_NOT_FOUND)
