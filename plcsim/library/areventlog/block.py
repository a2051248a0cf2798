"""What the blocks of ArEventLog share: a rising edge of Execute starts them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.areventlog.interface import (
    arEVENTLOG_ERR_IDENT_INVALID,
    arEVENTLOG_ERR_RECORDID_INVALID,
)
from plcsim.library.areventlog.logs import EventLog, EventLogs, EventRecord
from plcsim.library.block import StatusError

if TYPE_CHECKING:
    from collections.abc import Callable

IDLE, BUSY, FINISHED = range(3)
OK: Final = 0


class EventLogBlock(FunctionBlock):
    """Base of the blocks that are done in the call that sees Execute rise.

    Done or Error stay TRUE while Execute does; with Execute FALSE all outputs are reset.
    """

    __slots__ = ()

    Execute: bool
    Done: bool
    Error: bool
    StatusID: int
    Internal: Any
    Ident: int
    RecordID: int

    def execute(self) -> None:
        """Run one call.

        Raises:
            PageFault: a pointer input is wild; nothing was done.
        """
        state = self.Internal.FBStateCtx
        if not self.Execute:
            state.State = IDLE
            self.Done = self.Error = False
            self.StatusID = OK
        elif state.State == IDLE:
            self._start(state)
        elif state.State == BUSY:
            self._finish(state)

    def _start(self, state: Any) -> None:
        self._finish(state)

    def _finish(self, state: Any) -> None:
        status = self._status_of(self.act)
        state.State = FINISHED
        self.StatusID = status
        self.Error = status != OK
        self.Done = status == OK

    @staticmethod
    def _status_of(act: Callable[[], None]) -> int:
        try:
            act()
        except StatusError as failed:
            return failed.status
        return OK

    def act(self) -> None:
        """Do what the block does.

        Raises:
            StatusError: it cannot; with the status.
        """
        raise NotImplementedError(f"{type(self).__name__} has no act method.")

    @property
    def logs(self) -> EventLogs:
        """The logbooks of the controller."""
        return self.context.library(EventLogs)

    @property
    def log(self) -> EventLog:
        """The logbook.

        Raises:
            StatusError: there is none with this ident.
        """
        found = self.logs.find(self.Ident)
        if found is None:
            raise StatusError(arEVENTLOG_ERR_IDENT_INVALID)
        return found

    @property
    def record(self) -> EventRecord:
        """The record.

        Raises:
            StatusError: there is no such logbook, or no such record.
        """
        found = self.log.records.get(self.RecordID)
        if found is None:
            raise StatusError(arEVENTLOG_ERR_RECORDID_INVALID)
        return found


class AsynchronousEventLogBlock(EventLogBlock):
    """Base of the blocks that are Busy in the first call and done in the second."""

    __slots__ = ()

    Busy: bool

    def execute(self) -> None:
        """Run one call, likewise."""
        super().execute()
        self.Busy = self.Internal.FBStateCtx.State == BUSY

    def _start(self, state: Any) -> None:
        state.State = BUSY
