"""TMP_alloc and its like: memory that programs reserve while they run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.library.executable import function
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib.interface import (
    ERR_BUR_ILLPTR,
    ERR_BUR_MEM_ALLOC,
    ERR_BUR_MEM_FREE,
    ERR_BUR_TMP_ALLOC,
    ERR_BUR_TMP_FREE,
)

if TYPE_CHECKING:
    from plcsim.core.context import Context


def _allocate(context: Context, size: int, p_address: int, failed: int) -> int:
    if not p_address:
        return ERR_BUR_ILLPTR
    context.memory.check(p_address, 4)
    address = heap_of(context).allocate(size) if size else None
    context.memory.write(p_address, (address or 0).to_bytes(4, "little"))
    return failed if address is None else ERR_OK


@function("TMP_alloc")
def allocate(context: Context, size: int, p_address: int) -> int:
    """Reserve memory and store its address, 0 where there is none; return a status."""
    return _allocate(context, size, p_address, ERR_BUR_TMP_ALLOC)


@function("TMP_free")
def release(context: Context, _size: int, address: int) -> int:
    """Give memory back; return a status."""
    return ERR_OK if heap_of(context).release(address) else ERR_BUR_TMP_FREE


@function("MEM_alloc")
def allocate_for_long(context: Context, size: int, p_address: int) -> int:
    """Reserve memory, as TMP_alloc does."""
    return _allocate(context, size, p_address, ERR_BUR_MEM_ALLOC)


@function("MEM_free")
def release_after_long(context: Context, _size: int, address: int) -> int:
    """Give memory back, as TMP_free does."""
    return ERR_OK if heap_of(context).release(address) else ERR_BUR_MEM_FREE
