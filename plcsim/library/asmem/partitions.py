"""Library AsMem: partitions of memory, which are taken from the controller's heap."""

from __future__ import annotations

from typing import NamedTuple

from plcsim.library.asmem import interface
from plcsim.library.asmem.interface import (
    asmemERR_CREATE,
    asmemERR_DESTROY,
    asmemERR_FREE,
    asmemERR_INFO,
    asmemERR_NOMEM,
)
from plcsim.library.block import SynchronousBlock
from plcsim.library.heap import Blocks, heap_of
from plcsim.library.idents import Idents
from plcsim.library.runtime import ERR_OK


class Partition(NamedTuple):
    """Where a partition lies, and what of it is reserved."""

    address: int
    blocks: Blocks


class Partitions(Idents[Partition]):
    """The partitions of a controller."""


class _PartitionBlock(SynchronousBlock):
    """Base of the blocks: finds the partition."""

    __slots__ = ()

    ident: int

    @property
    def partitions(self) -> Partitions:
        """The partitions of the controller."""
        return self.context.library(Partitions)

    def allocated(self, size: int) -> int:
        """Reserve a block of the partition; return its address, 0 where it does not fit."""
        found = self.partitions.find(self.ident)
        return (found.blocks.allocate(size) if found and size else None) or 0


class AsMemPartCreate(interface.AsMemPartCreate, _PartitionBlock):
    """Make a partition of len bytes. Outputs: status (ERR_OK, asmemERR_CREATE), ident."""

    def step(self) -> int:
        """Make it."""
        self.ident = 0
        size = self.len & ~7
        address = (
            heap_of(self.context).allocate(size) if size and not self.partitions.full else None
        )
        if address is None:
            return asmemERR_CREATE
        self.ident = self.partitions.add(Partition(address, Blocks(address, size)))
        return ERR_OK


class AsMemPartDestroy(interface.AsMemPartDestroy, _PartitionBlock):
    """Give a partition back. Output: status (ERR_OK, asmemERR_DESTROY)."""

    def step(self) -> int:
        """Give it back."""
        found = self.partitions.remove(self.ident)
        if found is None:
            return asmemERR_DESTROY
        heap_of(self.context).release(found.address)
        return ERR_OK


class AsMemPartAlloc(interface.AsMemPartAlloc, _PartitionBlock):
    """Reserve len bytes of a partition. Outputs: status (ERR_OK, asmemERR_NOMEM), mem."""

    def step(self) -> int:
        """Reserve them."""
        self.mem = self.allocated(self.len)
        return ERR_OK if self.mem else asmemERR_NOMEM


class AsMemPartAllocClear(interface.AsMemPartAllocClear, _PartitionBlock):
    """Reserve len bytes of a partition, zeroed. Outputs: status (ERR_OK, asmemERR_NOMEM), mem."""

    def step(self) -> int:
        """Reserve them."""
        self.mem = self.allocated(self.len)
        if not self.mem:
            return asmemERR_NOMEM
        self.context.memory.write(self.mem, bytes(self.len))
        return ERR_OK


class AsMemPartRealloc(interface.AsMemPartRealloc, _PartitionBlock):
    """Give a block another size, perhaps at another place; its bytes are kept.

    Inputs: enable, ident, memOld (0 for a new block), len. Outputs: status (ERR_OK,
    asmemERR_NOMEM: the old block is still there), mem.
    """

    def step(self) -> int:
        """Move it."""
        found = self.partitions.find(self.ident)
        old_size = found.blocks.size_of(self.memOld) if found and self.memOld else 0
        if found is None or old_size is None:
            return asmemERR_NOMEM
        address = self.allocated(self.len)
        if not address:
            return asmemERR_NOMEM
        memory = self.context.memory
        memory.write(
            address, memory.read(self.memOld, min(old_size, self.len)) if old_size else b""
        )
        found.blocks.release(self.memOld)
        self.mem = address
        return ERR_OK


class AsMemPartFree(interface.AsMemPartFree, _PartitionBlock):
    """Give a block back. Inputs: enable, ident, mem. Output: status (ERR_OK, asmemERR_FREE)."""

    def step(self) -> int:
        """Give it back."""
        found = self.partitions.find(self.ident)
        return ERR_OK if found and found.blocks.release(self.mem) else asmemERR_FREE


class AsMemPartInfo(interface.AsMemPartInfo, _PartitionBlock):
    """What is free. Outputs: status (ERR_OK, asmemERR_INFO), numBytesFree, maxBlockSizeFree."""

    def step(self) -> int:
        """Look at it."""
        found = self.partitions.find(self.ident)
        if found is None:
            return asmemERR_INFO
        self.numBytesFree = found.blocks.free.total
        self.maxBlockSizeFree = found.blocks.free.largest
        return ERR_OK
