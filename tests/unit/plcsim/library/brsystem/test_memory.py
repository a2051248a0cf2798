"""Free memory."""

from plcsim.library import brsystem
from plcsim.library.brsystem import brDRAM, brERR_INVALID_PARAMETER
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK


def test_what_is_reserved_is_not_free(plc):
    info = plc.call(brsystem.MEMInfo)
    before = info.FreeUSR_Ram
    assert info.status == ERR_OK
    assert 0 < before <= plc.memory.size
    heap_of(plc.context).allocate(1_000_000)
    info()
    assert before - 1_000_000 - 64 <= info.FreeUSR_Ram <= before - 1_000_000
    assert info.FreeMEMCARD == 0


def test_by_kind(plc):
    info = plc.call(brsystem.MEMxInfo, mem_typ=brDRAM)
    assert (info.status, info.MemSize) == (ERR_OK, plc.memory.size)
    assert plc.call(brsystem.MEMxInfo, mem_typ=99).status == brERR_INVALID_PARAMETER
    info()
    assert heap_of(plc.context).allocate(info.BiggestFreeBlockSize - 8) is not None
