"""The data objects of a controller, and the blocks that make, find, read and write them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.library.block import AsynchronousBlock, SynchronousBlock
from plcsim.library.dataobj import interface
from plcsim.library.dataobj.interface import (
    doERR_DUPOBJECT,
    doERR_ILLEGALLENGTH,
    doERR_ILLMEMTYPE,
    doERR_ILLOBJECT,
    doERR_ILLPARAMETER,
    doERR_ILLSTATE,
    doERR_MODULNOTFOUND,
    doERR_NOMEMORY,
    doERR_TOOLONG_MODULNAME,
    doERR_WRONGOFFSET,
    doERR_WRONGTIME,
    doFIXRAM,
    doMEMCARD,
    doTEMP,
    doUSRRAM,
    doUSRROM,
)
from plcsim.library.dataobj.settings import MadeObjects
from plcsim.library.heap import heap_of
from plcsim.library.idents import Idents
from plcsim.library.runtime import ERR_OK

if TYPE_CHECKING:
    from plcsim.core.context import Context

LONGEST_NAME: Final = 10
"""Characters of a name (doERR_TOOLONG_MODULNAME)."""

NS_PER_SECOND: Final = 1_000_000_000
LAST_SECOND: Final = 4_102_444_799

_MEMORIES: Final = (doUSRROM, doUSRRAM, doMEMCARD, doFIXRAM, doTEMP)


@dataclass(slots=True)
class DataObject:
    """A data object.

    Attributes:
        name: unique.
        address: of its contents.
        size: bytes of them.
        memory: doUSRRAM, ...: they all lie in the PLC memory.
        option: as given.
        date: of the last change, seconds since 1970.
        attached: how often DatObjAttach keeps it.
    """

    name: bytes
    address: int
    size: int
    memory: int
    option: int
    date: int
    attached: int = 0


class DataObjects(Idents[DataObject]):
    """The data objects of a controller: at first those of its project."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        made = context.settings(MadeObjects)
        for name, data in made.contents.items() if made is not None else ():
            found = self.make(name.encode("latin-1", "replace"), len(data), doUSRROM, 0)
            if isinstance(found, DataObject):
                context.memory.write(found.address, data)
                self.add(found)

    def named(self, name: bytes) -> int:
        """Return the ident of the object with a name, 0 where there is none."""
        return next((ident for ident, each in self if each.name == name), 0)

    def make(self, name: bytes, size: int, memory: int, option: int) -> int | DataObject:
        """Return a new object, or the status why there is none."""
        if memory not in _MEMORIES:
            return doERR_ILLMEMTYPE
        if self.named(name):
            return doERR_DUPOBJECT
        if not size:
            return doERR_ILLEGALLENGTH
        address = None if self.full else heap_of(self.context).allocate(size)
        if address is None:
            return doERR_NOMEMORY
        return DataObject(name, address, size, memory, option, self.now)

    @property
    def now(self) -> int:
        """The controller's date, seconds since 1970."""
        return self.context.date_ns // NS_PER_SECOND

    def name_at(self, address: int) -> bytes | int:
        """Return the name at an address, or the status why there is none."""
        if not address:
            return doERR_ILLPARAMETER
        name = self.context.memory.string(address, LONGEST_NAME + 1)
        if not name:
            return doERR_ILLPARAMETER
        return doERR_TOOLONG_MODULNAME if len(name) > LONGEST_NAME else name


class DatObjCreate(interface.DatObjCreate, AsynchronousBlock):
    """Make a data object of len bytes: those at pCpyData, or zeros.

    Inputs: enable, grp, pName, len, MemType, Option, pCpyData. Outputs: status (ERR_OK,
    doERR_DUPOBJECT, doERR_ILLEGALLENGTH, doERR_ILLMEMTYPE, doERR_ILLPARAMETER, doERR_NOMEMORY,
    doERR_TOOLONG_MODULNAME), ident, pDatObjMem.
    """

    def step(self) -> int:
        """Make it."""
        self.ident = self.pDatObjMem = 0
        objects, memory = self.context.library(DataObjects), self.context.memory
        name = objects.name_at(self.pName)
        if isinstance(name, int):
            return name
        if self.pCpyData:
            memory.check(self.pCpyData, self.len)
        made = objects.make(name, self.len, self.MemType, self.Option)
        if isinstance(made, int):
            return made
        if self.pCpyData:
            memory.write(made.address, memory.read(self.pCpyData, made.size))
        self.ident, self.pDatObjMem = objects.add(made), made.address
        return ERR_OK


class _ObjectBlock(SynchronousBlock):
    """Base of the blocks that deal with an object by its ident."""

    __slots__ = ()

    ident: int

    @property
    def found(self) -> DataObject | None:
        """The object, None where the ident is unknown."""
        return self.context.library(DataObjects).find(self.ident)

    def place(self, offset: int, size: int) -> tuple[int, int]:
        """Return the status, and the address of a part of the object."""
        found = self.found
        if found is None:
            return doERR_ILLOBJECT, 0
        if offset > found.size:
            return doERR_WRONGOFFSET, 0
        if size > found.size - offset:
            return doERR_ILLEGALLENGTH, 0
        return ERR_OK, found.address + offset


class DatObjWrite(interface.DatObjWrite, _ObjectBlock):
    """Write len bytes from pSource at Offset of an object.

    Output: status (ERR_OK, doERR_ILLOBJECT, doERR_WRONGOFFSET, doERR_ILLEGALLENGTH,
    doERR_ILLPARAMETER).
    """

    def step(self) -> int:
        """Write."""
        status, address = self.place(self.Offset, self.len)
        found, memory = self.found, self.context.memory
        if status != ERR_OK or found is None:
            return status
        if not self.pSource:
            return doERR_ILLPARAMETER
        memory.write(address, memory.read(self.pSource, self.len))
        found.date = self.context.library(DataObjects).now
        return ERR_OK


class DatObjRead(interface.DatObjRead, _ObjectBlock):
    """Read len bytes at Offset of an object to pDestination. Output: status, as for DatObjWrite."""

    def step(self) -> int:
        """Read."""
        status, address = self.place(self.Offset, self.len)
        if status != ERR_OK:
            return status
        if not self.pDestination:
            return doERR_ILLPARAMETER
        memory = self.context.memory
        memory.write(self.pDestination, memory.read(address, self.len))
        return ERR_OK


class DatObjAttach(interface.DatObjAttach, _ObjectBlock):
    """Keep an object from being deleted. Output: status (ERR_OK, doERR_ILLOBJECT)."""

    def step(self) -> int:
        """Count."""
        if self.found is None:
            return doERR_ILLOBJECT
        self.found.attached += 1
        return ERR_OK


class DatObjDetach(interface.DatObjDetach, _ObjectBlock):
    """Undo DatObjAttach. Output: status (ERR_OK, doERR_ILLOBJECT, doERR_ILLSTATE)."""

    def step(self) -> int:
        """Count."""
        if self.found is None:
            return doERR_ILLOBJECT
        if not self.found.attached:
            return doERR_ILLSTATE
        self.found.attached -= 1
        return ERR_OK


class DatObjDelete(interface.DatObjDelete, AsynchronousBlock):
    """Delete an object, and give its memory back.

    Inputs: enable, ident. Output: status (ERR_OK, doERR_ILLOBJECT, doERR_ILLSTATE where it is
    attached).
    """

    def step(self) -> int:
        """Delete it."""
        objects = self.context.library(DataObjects)
        found = objects.find(self.ident)
        if found is None:
            return doERR_ILLOBJECT
        if found.attached:
            return doERR_ILLSTATE
        objects.remove(self.ident)
        heap_of(self.context).release(found.address)
        return ERR_OK


class DatObjMove(interface.DatObjMove, AsynchronousBlock):
    """Move an object to another memory: here it stays where it is, under the same ident.

    Inputs: enable, ident, MemType, Option. Outputs: status (ERR_OK, doERR_ILLOBJECT,
    doERR_ILLMEMTYPE), identNew, pDatObjMem.
    """

    def step(self) -> int:
        """Note the memory."""
        found = self.context.library(DataObjects).find(self.ident)
        if found is None:
            return doERR_ILLOBJECT
        if self.MemType not in _MEMORIES:
            return doERR_ILLMEMTYPE
        found.memory, found.option = self.MemType, self.Option
        self.identNew, self.pDatObjMem = self.ident, found.address
        return ERR_OK


class DatObjCopy(interface.DatObjCopy, AsynchronousBlock):
    """Copy an object under another name.

    Inputs: enable, ident, pNameTarget, MemTypeTarget, OptionTarget. Outputs: status (as for
    DatObjCreate, and doERR_ILLOBJECT), identNew, pDatObjMemNew.
    """

    def step(self) -> int:
        """Copy it."""
        self.identNew = self.pDatObjMemNew = 0
        objects, memory = self.context.library(DataObjects), self.context.memory
        found = objects.find(self.ident)
        if found is None:
            return doERR_ILLOBJECT
        name = objects.name_at(self.pNameTarget)
        if isinstance(name, int):
            return name
        made = objects.make(name, found.size, self.MemTypeTarget, self.OptionTarget)
        if isinstance(made, int):
            return made
        memory.write(made.address, memory.read(found.address, found.size))
        self.identNew, self.pDatObjMemNew = objects.add(made), made.address
        return ERR_OK


class DatObjInfo(interface.DatObjInfo, SynchronousBlock):
    """Find an object by its name.

    Inputs: enable, pName. Outputs: status (ERR_OK, doERR_MODULNOTFOUND, doERR_ILLPARAMETER,
    doERR_TOOLONG_MODULNAME), ident, pDatObjMem, len, MemType, Option, ChangeDate.
    """

    def step(self) -> int:
        """Find it."""
        self.ident = self.pDatObjMem = self.len = 0
        objects = self.context.library(DataObjects)
        name = objects.name_at(self.pName)
        if isinstance(name, int):
            return name
        ident = objects.named(name)
        found = objects.find(ident)
        if found is None:
            return doERR_MODULNOTFOUND
        self.ident, self.pDatObjMem, self.len = ident, found.address, found.size
        self.MemType, self.Option, self.ChangeDate = found.memory, found.option, found.date
        return ERR_OK


class DatObjChangeDate(interface.DatObjChangeDate, SynchronousBlock):
    """Set the date of an object. Inputs: enable, pName, SetDate. Output: status."""

    def step(self) -> int:
        """Set it."""
        objects = self.context.library(DataObjects)
        name = objects.name_at(self.pName)
        if isinstance(name, int):
            return name
        found = objects.find(objects.named(name))
        if found is None:
            return doERR_MODULNOTFOUND
        if self.SetDate > LAST_SECOND:
            return doERR_WRONGTIME
        found.date = self.SetDate
        return ERR_OK
