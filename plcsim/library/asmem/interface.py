"""Library AsMem as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = [
    "asmemERR_CREATE",
    "asmemERR_DESTROY",
    "asmemERR_FREE",
    "asmemERR_INFO",
    "asmemERR_NOMEM",
]

_DECLARED = declared_beside(__name__)

asmemERR_DESTROY: Final = 30501

asmemERR_CREATE: Final = 30500

asmemERR_NOMEM: Final = 30502

asmemERR_INFO: Final = 30504

asmemERR_FREE: Final = 30503


class AsMemPartCreate(FunctionBlock):
    """Makes a partition."""

    _plc_type = _DECLARED["AsMemPartCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The partition."""


class AsMemPartDestroy(FunctionBlock):
    """Gives a partition back."""

    _plc_type = _DECLARED["AsMemPartDestroy"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsMemPartAlloc(FunctionBlock):
    """Reserves a block of a partition."""

    _plc_type = _DECLARED["AsMemPartAlloc"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    mem: int
    """Address of the block."""


class AsMemPartAllocClear(FunctionBlock):
    """Reserves a block of a partition, zeroed."""

    _plc_type = _DECLARED["AsMemPartAllocClear"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    mem: int
    """Address of the block."""


class AsMemPartRealloc(FunctionBlock):
    """Changes the size of a block."""

    _plc_type = _DECLARED["AsMemPartRealloc"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    memOld: int
    """Address of the block."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    mem: int
    """Address of the block."""


class AsMemPartFree(FunctionBlock):
    """Gives a block back."""

    _plc_type = _DECLARED["AsMemPartFree"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    mem: int
    """Address of the block."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class AsMemPartInfo(FunctionBlock):
    """What is free in a partition."""

    _plc_type = _DECLARED["AsMemPartInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The partition."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    numBytesFree: int

    maxBlockSizeFree: int
