"""Library AsSem as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = [
    "semERR_ALREADY_FREE",
    "semERR_CREATE",
    "semERR_DELETE",
    "semERR_NOT_EXIST",
    "semERR_NOT_FREE",
]

_DECLARED = declared_beside(__name__)

semERR_CREATE: Final = 33320

semERR_DELETE: Final = 33321

semERR_NOT_EXIST: Final = 33322

semERR_NOT_FREE: Final = 33323

semERR_ALREADY_FREE: Final = 33324


class SemCreate(FunctionBlock):
    """Makes a semaphore."""

    _plc_type = _DECLARED["SemCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    initCount: int

    maxCount: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The semaphore."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class SemDelete(FunctionBlock):
    """Deletes a semaphore."""

    _plc_type = _DECLARED["SemDelete"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The semaphore."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class SemGetInfo(FunctionBlock):
    """Counts of a semaphore."""

    _plc_type = _DECLARED["SemGetInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The semaphore."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    maxCount: int

    curCount: int
