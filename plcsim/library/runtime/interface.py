"""Library runtime as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = [
    "ERR_FUB_BUSY",
    "ERR_FUB_ENABLE_FALSE",
    "ERR_NOTIMPLEMENTED",
    "ERR_OK",
    "ArFBAsyFuMaInternalType",
    "ArFBStateInternalType",
]

_DECLARED = declared_beside(__name__)

ERR_OK: Final = 0
"""Done."""

ERR_NOTIMPLEMENTED: Final = 9999
"""The block is there for its name only."""

ERR_FUB_ENABLE_FALSE: Final = 65534
"""The block was called with enable FALSE."""

ERR_FUB_BUSY: Final = 65535
"""The block has not finished: call it again with the same inputs."""


class ArFBStateInternalType(Struct):
    """Of blocks with Execute."""

    _plc_type = _DECLARED["ArFBStateInternalType"]

    ExecuteRef: int

    BusyRef: int

    DoneRef: int

    ErrorRef: int

    ActiveRef: int

    StatusRef: int

    FBCyclic: int

    AsyfumaState: int

    FBResetOut: int

    Argument: int

    State: int
    """0 idle, 1 busy, 2 finished."""

    ExecutePrev: bool
    """Execute at the last call."""


class ArFBAsyFuMaInternalType(Struct):
    """Of asynchronous ones."""

    _plc_type = _DECLARED["ArFBAsyFuMaInternalType"]

    State: int

    Result: int
