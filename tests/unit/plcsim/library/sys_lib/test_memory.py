"""TMP_alloc and its like."""

import pytest

from plcsim.core.errors import PageFault
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK
from plcsim.library.sys_lib import (
    ERR_BUR_ILLPTR,
    ERR_BUR_MEM_ALLOC,
    ERR_BUR_MEM_FREE,
    ERR_BUR_TMP_ALLOC,
    ERR_BUR_TMP_FREE,
)

KINDS = pytest.mark.parametrize(
    ("kind", "no_memory", "not_reserved"),
    [
        ("TMP", ERR_BUR_TMP_ALLOC, ERR_BUR_TMP_FREE),
        ("MEM", ERR_BUR_MEM_ALLOC, ERR_BUR_MEM_FREE),
    ],
)


@KINDS
def test_memory_is_reserved_and_given_back(tasks, kind, no_memory, not_reserved):
    allocate, free = tasks.function(f"{kind}_alloc"), tasks.function(f"{kind}_free")
    assert allocate(1000, tasks.out) == ERR_OK
    address = tasks.number()
    tasks.memory.write(address, b"x" * 1000)
    assert allocate(1000, tasks.out + 4) == ERR_OK
    assert abs(tasks.number(4) - address) >= 1000
    assert free(1000, address) == ERR_OK
    assert free(1000, address) == not_reserved
    assert allocate(2**31, tasks.out) == no_memory
    assert tasks.number() == 0
    assert allocate(0, tasks.out) == no_memory
    assert allocate(8, 0) == ERR_BUR_ILLPTR


def test_nothing_is_reserved_for_a_wild_pointer(tasks):
    before = heap_of(tasks.context).free_bytes
    with pytest.raises(PageFault):
        tasks.function("TMP_alloc")(8, 0x7000_0000)
    assert heap_of(tasks.context).free_bytes == before


def test_a_restart_frees_all(tasks):
    allocate = tasks.function("TMP_alloc")
    allocate(1000, tasks.out)
    first = tasks.number()
    tasks.controller.shutdown()
    allocate(1000, tasks.out)
    assert tasks.number() == first
