"""Library DataObj as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

if TYPE_CHECKING:
    from st_types import Array

__all__ = [
    "doERR_BRINSTALL",
    "doERR_BURNINGOBJECT",
    "doERR_CHECKSUM_WARNING",
    "doERR_DUPOBJECT",
    "doERR_ILLEGALLENGTH",
    "doERR_ILLMEMTYPE",
    "doERR_ILLOBJECT",
    "doERR_ILLOBJTYPE",
    "doERR_ILLPARAMETER",
    "doERR_ILLSTATE",
    "doERR_MODULDELETE_SYSROM",
    "doERR_MODULNOTFOUND",
    "doERR_NOMEMORY",
    "doERR_STARTHANDLER",
    "doERR_TOOLONG_MODULNAME",
    "doERR_WRONGOFFSET",
    "doERR_WRONGTIME",
    "doFIXRAM",
    "doMEMCARD",
    "doNO_CS",
    "doSYSROM",
    "doTEMP",
    "doUSRRAM",
    "doUSRROM",
]

_DECLARED = declared_beside(__name__)

doERR_TOOLONG_MODULNAME: Final = 20613

doERR_CHECKSUM_WARNING: Final = 20630

doERR_MODULNOTFOUND: Final = 20609

doERR_ILLEGALLENGTH: Final = 20608

doERR_STARTHANDLER: Final = 20612

doERR_ILLPARAMETER: Final = 20600

doERR_WRONGOFFSET: Final = 20607

doERR_ILLOBJTYPE: Final = 20606

doERR_ILLMEMTYPE: Final = 20602

doERR_WRONGTIME: Final = 20610

doERR_ILLOBJECT: Final = 20605

doERR_DUPOBJECT: Final = 20601

doERR_BRINSTALL: Final = 20604

doERR_NOMEMORY: Final = 20603

doERR_ILLSTATE: Final = 20611

doERR_BURNINGOBJECT: Final = 20614

doERR_MODULDELETE_SYSROM: Final = 20615

doSYSROM: Final = 0

doNO_CS: Final = 1

doUSRROM: Final = 2

doUSRRAM: Final = 3

doMEMCARD: Final = 4

doFIXRAM: Final = 5

doTEMP: Final = 65


class DatObjCreate(FunctionBlock):
    """Makes a data object; asynchronous."""

    _plc_type = _DECLARED["DatObjCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    grp: int

    pName: int
    """Address of the name."""

    len: int
    """Bytes."""

    MemType: int
    """DoUSRROM, doUSRRAM, ."""

    Option: int
    """DoNO_CS."""

    pCpyData: int
    """Address of the first contents, 0 for zeros."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The data object."""

    pDatObjMem: int
    """Address of the contents."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_spare: Array[int]

    i_spare_1: int

    i_spare_2: int

    i_spare_3: int

    i_spare_4: int


class DatObjWrite(FunctionBlock):
    """Writes into a data object."""

    _plc_type = _DECLARED["DatObjWrite"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    Offset: int
    """Bytes from the start."""

    pSource: int
    """Address of the bytes."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DatObjRead(FunctionBlock):
    """Reads from a data object."""

    _plc_type = _DECLARED["DatObjRead"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    Offset: int
    """Bytes from the start."""

    pDestination: int
    """Address for the bytes."""

    len: int
    """Bytes."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DatObjDelete(FunctionBlock):
    """Deletes a data object; asynchronous."""

    _plc_type = _DECLARED["DatObjDelete"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_spare: int


class DatObjMove(FunctionBlock):
    """Moves a data object to another memory; asynchronous."""

    _plc_type = _DECLARED["DatObjMove"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    MemType: int
    """DoUSRROM, doUSRRAM, ."""

    Option: int
    """DoNO_CS."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    identNew: int

    pDatObjMem: int
    """Address of the contents."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_spare: Array[int]

    i_spare_1: int

    i_spare_2: int


class DatObjCopy(FunctionBlock):
    """Copies a data object; asynchronous."""

    _plc_type = _DECLARED["DatObjCopy"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    pNameTarget: int

    MemTypeTarget: int

    OptionTarget: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    identNew: int

    pDatObjMemNew: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_spare: Array[int]

    i_spare_1: int

    i_spare_2: int


class DatObjInfo(FunctionBlock):
    """Finds a data object by its name."""

    _plc_type = _DECLARED["DatObjInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pName: int
    """Address of the name."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The data object."""

    pDatObjMem: int
    """Address of the contents."""

    len: int
    """Bytes."""

    MemType: int
    """DoUSRROM, doUSRRAM, ."""

    Option: int
    """DoNO_CS."""

    ChangeDate: int


class DatObjChangeDate(FunctionBlock):
    """Sets the date of a data object."""

    _plc_type = _DECLARED["DatObjChangeDate"]

    enable: bool
    """Run the block; FALSE resets it."""

    pName: int
    """Address of the name."""

    SetDate: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DatObjAttach(FunctionBlock):
    """Keeps a data object from being deleted."""

    _plc_type = _DECLARED["DatObjAttach"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DatObjDetach(FunctionBlock):
    """Lets a data object be deleted again."""

    _plc_type = _DECLARED["DatObjDetach"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The data object."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""
