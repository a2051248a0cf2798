"""Library FileIO as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

if TYPE_CHECKING:
    from st_types import Array

__all__ = [
    "ATTR_ARCHIVE",
    "ATTR_DIRECTORY",
    "ATTR_HIDDEN",
    "ATTR_RDONLY",
    "ATTR_SYSTEM",
    "ATTR_VOL_LABEL",
    "DIR_OW",
    "FILE_ALL",
    "FILE_DETMEM",
    "FILE_DIR",
    "FILE_FILE",
    "FILE_ONCE",
    "FILE_OW_DETMEM",
    "FILE_OW_ONCE",
    "FILE_R",
    "FILE_RW",
    "FILE_W",
    "SET_RECURSIVE",
    "fiATTR_ARCHIVE",
    "fiATTR_DIRECTORY",
    "fiATTR_HIDDEN",
    "fiATTR_RDONLY",
    "fiATTR_SYSTEM",
    "fiATTR_VOL_LABEL",
    "fiBOTH",
    "fiDIRECTORY",
    "fiDIR_READ_DATA",
    "fiDIR_READ_EX_DATA",
    "fiERR_ACCESS",
    "fiERR_ASYNC_MANAGER",
    "fiERR_COM_FILE_CLOSE",
    "fiERR_COM_FILE_IOCTL",
    "fiERR_COM_FILE_OPEN",
    "fiERR_COM_FILE_READ",
    "fiERR_COM_FILE_WRITE",
    "fiERR_DATA",
    "fiERR_DATA_SIZE",
    "fiERR_DETMEMINFO",
    "fiERR_DEVICE_ALREADY_EXIST",
    "fiERR_DEVICE_DRIVER",
    "fiERR_DEVICE_INVALID_HANDLE",
    "fiERR_DEVICE_MANAGER",
    "fiERR_DIR_ALREADY_EXIST",
    "fiERR_DIR_INVALID_HANDLE",
    "fiERR_DIR_NOT_EMPTY",
    "fiERR_DIR_NOT_EXIST",
    "fiERR_EXIST",
    "fiERR_FILE",
    "fiERR_FILE_DEVICE",
    "fiERR_FILE_NOT_FOUND",
    "fiERR_FILE_NOT_OPENED",
    "fiERR_INIT",
    "fiERR_INVALID_DIRECTORY",
    "fiERR_INVALID_NBYTES",
    "fiERR_INVALID_PATH",
    "fiERR_INVALID_TYP",
    "fiERR_LESS_VIRTUAL_MEMORY",
    "fiERR_MODE",
    "fiERR_NETIO_INIT",
    "fiERR_NETIO_IP_UNEQUAL",
    "fiERR_NETIO_PARAMETERS",
    "fiERR_NETIO_PORT",
    "fiERR_NETIO_USER",
    "fiERR_NOT_ENOUGH_FREEMEM",
    "fiERR_NOT_SUPPORTED",
    "fiERR_NO_MORE_ENTRIES",
    "fiERR_PARAMETER",
    "fiERR_SEEK",
    "fiERR_SPACE",
    "fiERR_SYSTEM",
    "fiFILE",
    "fiFILE_INFO",
    "fiOVERWRITE",
    "fiREAD_ONLY",
    "fiREAD_WRITE",
    "fiRECURSIVE",
    "fiTruncate",
    "fiWRITE_ONLY",
]

_DECLARED = declared_beside(__name__)

fiATTR_ARCHIVE: Final = 32

fiATTR_DIRECTORY: Final = 16

fiATTR_HIDDEN: Final = 2

fiATTR_RDONLY: Final = 1

fiATTR_SYSTEM: Final = 4

fiATTR_VOL_LABEL: Final = 8

fiRECURSIVE: Final = 1

fiOVERWRITE: Final = 2

fiREAD_ONLY: Final = 0

fiWRITE_ONLY: Final = 1

fiREAD_WRITE: Final = 2

fiFILE: Final = 0

fiDIRECTORY: Final = 1

fiBOTH: Final = 2

fiTruncate: Final = 1

fiERR_INVALID_PATH: Final = 20700

fiERR_DATA_SIZE: Final = 20701

fiERR_NO_MORE_ENTRIES: Final = 20702

fiERR_NOT_SUPPORTED: Final = 20703

fiERR_INVALID_TYP: Final = 20704

fiERR_EXIST: Final = 20705

fiERR_ACCESS: Final = 20706

fiERR_MODE: Final = 20707

fiERR_FILE_NOT_FOUND: Final = 20708

fiERR_FILE_DEVICE: Final = 20709

fiERR_SPACE: Final = 20710

fiERR_SEEK: Final = 20711

fiERR_FILE: Final = 20712

fiERR_LESS_VIRTUAL_MEMORY: Final = 20713

fiERR_COM_FILE_OPEN: Final = 20714

fiERR_COM_FILE_CLOSE: Final = 20715

fiERR_COM_FILE_READ: Final = 20716

fiERR_COM_FILE_WRITE: Final = 20717

fiERR_COM_FILE_IOCTL: Final = 20718

fiERR_DATA: Final = 20719

fiERR_ASYNC_MANAGER: Final = 20720

fiERR_FILE_NOT_OPENED: Final = 20721

fiERR_INVALID_DIRECTORY: Final = 20722

fiERR_DIR_NOT_EXIST: Final = 20723

fiERR_DIR_NOT_EMPTY: Final = 20724

fiERR_DIR_ALREADY_EXIST: Final = 20725

fiERR_DETMEMINFO: Final = 20726

fiERR_NOT_ENOUGH_FREEMEM: Final = 20727

fiERR_DIR_INVALID_HANDLE: Final = 20728

fiERR_PARAMETER: Final = 20729

fiERR_DEVICE_ALREADY_EXIST: Final = 20730

fiERR_DEVICE_INVALID_HANDLE: Final = 20731

fiERR_NETIO_IP_UNEQUAL: Final = 20732

fiERR_NETIO_PORT: Final = 20733

fiERR_NETIO_USER: Final = 20734

fiERR_INVALID_NBYTES: Final = 20735

fiERR_NETIO_PARAMETERS: Final = 20736

fiERR_NETIO_INIT: Final = 20737

fiERR_INIT: Final = 20796

fiERR_DEVICE_DRIVER: Final = 20797

fiERR_DEVICE_MANAGER: Final = 20798

fiERR_SYSTEM: Final = 20799

ATTR_ARCHIVE: Final = 32

ATTR_DIRECTORY: Final = 16

ATTR_HIDDEN: Final = 2

ATTR_RDONLY: Final = 1

ATTR_SYSTEM: Final = 4

ATTR_VOL_LABEL: Final = 8

DIR_OW: Final = 1

FILE_ALL: Final = 2

FILE_DIR: Final = 1

FILE_FILE: Final = 0

FILE_ONCE: Final = 0

FILE_DETMEM: Final = 1

FILE_OW_DETMEM: Final = 2

FILE_OW_ONCE: Final = 3

FILE_R: Final = 0

FILE_W: Final = 1

FILE_RW: Final = 2

SET_RECURSIVE: Final = 1


class fiDIR_READ_DATA(Struct):
    """FiDIR_READ_DATA."""

    _plc_type = _DECLARED["fiDIR_READ_DATA"]

    Filename: Array[int]

    Date: int

    Filelength: int


class fiDIR_READ_EX_DATA(Struct):
    """FiDIR_READ_EX_DATA."""

    _plc_type = _DECLARED["fiDIR_READ_EX_DATA"]

    Filename: Array[int]

    Date: int

    Filelength: int

    Mode: int


class fiFILE_INFO(Struct):
    """FiFILE_INFO."""

    _plc_type = _DECLARED["fiFILE_INFO"]

    size: int

    linkCnt: int

    accTime: int

    modTime: int

    chgTime: int

    reserved: Array[int]


class FileCreate(FunctionBlock):
    """Creates and opens a file; asynchronous."""

    _plc_type = _DECLARED["FileCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pFile: int
    """Address of the file's name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The open file."""


class FileOpen(FunctionBlock):
    """Opens a file; asynchronous."""

    _plc_type = _DECLARED["FileOpen"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pFile: int
    """Address of the file's name."""

    mode: int
    """FiREAD_ONLY, fiWRITE_ONLY or fiREAD_WRITE."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The open file."""

    filelen: int
    """Bytes of the file."""


class FileClose(FunctionBlock):
    """Closes a file; asynchronous."""

    _plc_type = _DECLARED["FileClose"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open file."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileRead(FunctionBlock):
    """Reads from a file; asynchronous."""

    _plc_type = _DECLARED["FileRead"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open file."""

    offset: int
    """Bytes from the start of the file."""

    pDest: int
    """Address for the bytes."""

    len: int
    """Bytes."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileReadEx(FunctionBlock):
    """Reads from a file and tells how much; asynchronous."""

    _plc_type = _DECLARED["FileReadEx"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open file."""

    offset: int
    """Bytes from the start of the file."""

    pDest: int
    """Address for the bytes."""

    len: int
    """Bytes."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    bytesread: int
    """Bytes that were read."""


class FileWrite(FunctionBlock):
    """Writes to a file; asynchronous."""

    _plc_type = _DECLARED["FileWrite"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open file."""

    offset: int
    """Bytes from the start of the file."""

    pSrc: int
    """Address of the bytes."""

    len: int
    """Bytes."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileWriteEx(FunctionBlock):
    """Writes to a file, which may end there; asynchronous."""

    _plc_type = _DECLARED["FileWriteEx"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open file."""

    offset: int
    """Bytes from the start of the file."""

    pSrc: int
    """Address of the bytes."""

    len: int
    """Bytes."""

    option: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileRename(FunctionBlock):
    """Renames a file; asynchronous."""

    _plc_type = _DECLARED["FileRename"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    pNewName: int
    """Address of the new name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileCopy(FunctionBlock):
    """Copies a file; asynchronous."""

    _plc_type = _DECLARED["FileCopy"]

    enable: bool
    """Run the block; FALSE resets it."""

    pSrcDev: int
    """Address of the device's name."""

    pSrc: int
    """Address of the file's name."""

    pDestDev: int
    """Address of the other device's name."""

    pDest: int
    """Address of the new name."""

    option: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileDelete(FunctionBlock):
    """Deletes a file; asynchronous."""

    _plc_type = _DECLARED["FileDelete"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileInfo(FunctionBlock):
    """Size and dates of a file; asynchronous."""

    _plc_type = _DECLARED["FileInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    pInfo: int
    """Address of a fiFILE_INFO."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class FileTruncate(FunctionBlock):
    """Cuts a file; asynchronous."""

    _plc_type = _DECLARED["FileTruncate"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    newLength: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirCreate(FunctionBlock):
    """Creates a directory; asynchronous."""

    _plc_type = _DECLARED["DirCreate"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirOpen(FunctionBlock):
    """Opens a directory for DirReadEx; asynchronous."""

    _plc_type = _DECLARED["DirOpen"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The open directory."""


class DirClose(FunctionBlock):
    """Closes a directory; asynchronous."""

    _plc_type = _DECLARED["DirClose"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open directory."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirRead(FunctionBlock):
    """Reads an entry of a directory; asynchronous."""

    _plc_type = _DECLARED["DirRead"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pPath: int
    """Address of the path, 0 for all of the device."""

    entry: int
    """Number of the entry, from 0."""

    option: int

    pData: int
    """Address of a fiDIR_READ_DATA."""

    data_len: int
    """Bytes there."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirReadEx(FunctionBlock):
    """Reads the next entry of a directory; asynchronous."""

    _plc_type = _DECLARED["DirReadEx"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The open directory."""

    pData: int
    """Address of a fiDIR_READ_EX_DATA."""

    data_len: int
    """Bytes there."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirInfo(FunctionBlock):
    """Counts the entries of a directory; asynchronous."""

    _plc_type = _DECLARED["DirInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pPath: int
    """Address of the path, 0 for all of the device."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    dirnum: int
    """Directories."""

    filenum: int
    """Files."""


class DirRename(FunctionBlock):
    """Renames a directory; asynchronous."""

    _plc_type = _DECLARED["DirRename"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    pNewName: int
    """Address of the new name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirCopy(FunctionBlock):
    """Copies a directory; asynchronous."""

    _plc_type = _DECLARED["DirCopy"]

    enable: bool
    """Run the block; FALSE resets it."""

    pSrcDev: int
    """Address of the device's name."""

    pSrcDir: int

    pDestDev: int
    """Address of the other device's name."""

    pDestDir: int

    option: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirDelete(FunctionBlock):
    """Deletes an empty directory; asynchronous."""

    _plc_type = _DECLARED["DirDelete"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DirDeleteEx(FunctionBlock):
    """Deletes a directory with all in it; asynchronous."""

    _plc_type = _DECLARED["DirDeleteEx"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pName: int
    """Address of the name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class SetAttributes(FunctionBlock):
    """Sets attributes; asynchronous."""

    _plc_type = _DECLARED["SetAttributes"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pPath: int
    """Address of the path, 0 for all of the device."""

    attributes: int

    option: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class GetAttributes(FunctionBlock):
    """Reads attributes; asynchronous."""

    _plc_type = _DECLARED["GetAttributes"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pPath: int
    """Address of the path, 0 for all of the device."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    attributes: int


class DevMemInfo(FunctionBlock):
    """Size of a device; asynchronous."""

    _plc_type = _DECLARED["DevMemInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    freemem: int
    """Bytes."""

    memsize: int
    """Bytes."""


class DevLink(FunctionBlock):
    """Makes a device; asynchronous."""

    _plc_type = _DECLARED["DevLink"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pParam: int
    """Address of /DEVICE=PATH."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    handle: int
    """The device."""


class DevUnlink(FunctionBlock):
    """Takes a device away; asynchronous."""

    _plc_type = _DECLARED["DevUnlink"]

    enable: bool
    """Run the block; FALSE resets it."""

    handle: int
    """The device."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class GetVolumeLabel(FunctionBlock):
    """Name of a device's volume; asynchronous."""

    _plc_type = _DECLARED["GetVolumeLabel"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    pLabel: int

    labelMax: int

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    labelLen: int


class GetVolumeSerialNo(FunctionBlock):
    """Number of a device's volume; asynchronous."""

    _plc_type = _DECLARED["GetVolumeSerialNo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the device's name."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    serialNo: int
