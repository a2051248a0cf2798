"""Partitions of memory."""

import pytest

from plcsim.library import asmem
from plcsim.library.asmem import (
    asmemERR_CREATE,
    asmemERR_DESTROY,
    asmemERR_FREE,
    asmemERR_INFO,
    asmemERR_NOMEM,
)
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK


@pytest.fixture
def ident(plc):
    made = plc.call(asmem.AsMemPartCreate, len=1024)
    assert made.status == ERR_OK
    return made.ident


def test_blocks_of_a_partition(plc, ident):
    first = plc.call(asmem.AsMemPartAlloc, ident=ident, len=100)
    second = plc.call(asmem.AsMemPartAlloc, ident=ident, len=100)
    assert (first.status, second.status) == (ERR_OK, ERR_OK)
    assert abs(first.mem - second.mem) >= 100
    info = plc.call(asmem.AsMemPartInfo, ident=ident)
    assert (info.numBytesFree, info.maxBlockSizeFree) == (1024 - 208, 1024 - 208)
    assert plc.call(asmem.AsMemPartFree, ident=ident, mem=first.mem).status == ERR_OK
    assert plc.call(asmem.AsMemPartFree, ident=ident, mem=first.mem).status == asmemERR_FREE
    info()
    assert info.numBytesFree == 1024 - 104


def test_a_partition_has_an_end(plc, ident):
    assert plc.call(asmem.AsMemPartAlloc, ident=ident, len=1025).status == asmemERR_NOMEM
    assert plc.call(asmem.AsMemPartAlloc, ident=ident, len=1024).status == ERR_OK
    more = plc.call(asmem.AsMemPartAllocClear, ident=ident, len=1)
    assert (more.status, more.mem) == (asmemERR_NOMEM, 0)
    assert plc.call(asmem.AsMemPartAlloc, ident=ident, len=0).status == asmemERR_NOMEM


def test_a_cleared_block_is_zero(plc, ident):
    used = plc.call(asmem.AsMemPartAlloc, ident=ident, len=16).mem
    plc.memory.write(used, b"x" * 16)
    plc.call(asmem.AsMemPartFree, ident=ident, mem=used)
    assert plc.memory.read(plc.call(asmem.AsMemPartAlloc, ident=ident, len=16).mem, 1) == b"x"
    plc.call(asmem.AsMemPartFree, ident=ident, mem=used)
    clear = plc.call(asmem.AsMemPartAllocClear, ident=ident, len=16)
    assert plc.memory.read(clear.mem, 16) == bytes(16)


def test_a_block_that_moves_keeps_its_bytes(plc, ident):
    old = plc.call(asmem.AsMemPartAlloc, ident=ident, len=8).mem
    plc.memory.write(old, b"12345678")
    new = plc.call(asmem.AsMemPartRealloc, ident=ident, memOld=old, len=20)
    assert new.status == ERR_OK
    assert plc.memory.read(new.mem, 8) == b"12345678"
    assert plc.call(asmem.AsMemPartFree, ident=ident, mem=old).status == asmemERR_FREE
    small = plc.call(asmem.AsMemPartRealloc, ident=ident, memOld=new.mem, len=3)
    assert plc.memory.read(small.mem, 3) == b"123"
    too_large = plc.call(asmem.AsMemPartRealloc, ident=ident, memOld=small.mem, len=2000)
    assert too_large.status == asmemERR_NOMEM
    assert plc.memory.read(small.mem, 3) == b"123"
    assert plc.call(asmem.AsMemPartRealloc, ident=ident, memOld=5, len=8).status == asmemERR_NOMEM
    assert plc.call(asmem.AsMemPartRealloc, ident=ident, len=8).status == ERR_OK


def test_a_partition_that_was_given_back(plc, ident):
    destroy = plc.new(asmem.AsMemPartDestroy)
    before = heap_of(plc.context).free_bytes
    destroy(enable=True, ident=ident)
    assert destroy.status == ERR_OK
    assert heap_of(plc.context).free_bytes == before + 1024
    assert plc.call(asmem.AsMemPartDestroy, ident=ident).status == asmemERR_DESTROY
    assert plc.call(asmem.AsMemPartInfo, ident=ident).status == asmemERR_INFO
    assert plc.call(asmem.AsMemPartFree, ident=ident, mem=0).status == asmemERR_FREE


@pytest.mark.parametrize("size", [0, 7, 2**31])
def test_no_such_partition_can_be(plc, size):
    made = plc.call(asmem.AsMemPartCreate, len=size)
    assert (made.status, made.ident) == (asmemERR_CREATE, 0)
