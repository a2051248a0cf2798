"""Library MTFilter as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

__all__ = ["MTFilterMovingAvgInternalType", "mtBCD_ERR_FILTER_WINDOW_INVALID"]

_DECLARED = declared_beside(__name__)

mtBCD_ERR_FILTER_WINDOW_INVALID: Final = -1058012149
"""WindowLength is not 1 to 9999."""


class MTFilterMovingAvgInternalType(Struct):
    """MTFilterMovingAvgInternalType."""

    _plc_type = _DECLARED["MTFilterMovingAvgInternalType"]

    Enabled: bool

    UpdateOld: bool

    pValues: int
    """Values on the heap."""

    WindowLength: int

    Count: int

    Next: int


class MTFilterMovingAverage(FunctionBlock):
    """Mean of the latest values."""

    _plc_type = _DECLARED["MTFilterMovingAverage"]

    Enable: bool
    """Run the block; FALSE resets it."""

    WindowLength: int
    """Number of values."""

    Update: bool
    """A rising edge takes over the parameters above."""

    In: float
    """Input."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    UpdateDone: bool
    """They are taken over."""

    Out: float
    """Output."""

    Internal: MTFilterMovingAvgInternalType
    """State."""
