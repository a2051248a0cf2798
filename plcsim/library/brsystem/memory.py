"""MEMInfo and MEMxInfo: memory that programs can still reserve."""

from __future__ import annotations

from typing import Final

from plcsim.library.block import SynchronousBlock
from plcsim.library.brsystem import interface
from plcsim.library.brsystem.interface import (
    brDRAM,
    brERR_INVALID_PARAMETER,
    brSYSROM,
    brUSRRAM,
    brUSRROM,
)
from plcsim.library.heap import heap_of
from plcsim.library.runtime import ERR_OK

_KINDS: Final = (brDRAM, brUSRRAM, brSYSROM, brUSRROM)


class MEMInfo(interface.MEMInfo, SynchronousBlock):
    """Free memory by kind: all of it is one memory here, the PLC memory; there is no card."""

    def step(self) -> int:
        """Look what is free."""
        free = heap_of(self.context).free_bytes
        self.FreeUSR_Ram = self.FreeSYSTEM = self.FreeTMP_Ram = self.FreeFIX_Ram = free
        self.FreeUSR_Prom = self.FreeSYS_Prom = free
        self.FreeMEMCARD = 0
        return ERR_OK


class MEMxInfo(interface.MEMxInfo, SynchronousBlock):
    """The same for one kind. Inputs: enable, mem_typ. Status: brERR_INVALID_PARAMETER too."""

    def step(self) -> int:
        """Look what is free."""
        if self.mem_typ not in _KINDS:
            return brERR_INVALID_PARAMETER
        self.MemSize = self.context.memory.size
        self.FreeMemSize = heap_of(self.context).free_bytes
        self.BiggestFreeBlockSize = heap_of(self.context).largest_free
        return ERR_OK
