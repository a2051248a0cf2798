"""Library dvframe as Python sees it.

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
    "ARG_BAUD",
    "ARG_EVSEND_TASKEVENT",
    "ARG_EVSEND_TASKIDENT",
    "ARG_MISC",
    "ARG_PVPOLLADR",
    "ARG_TXPVPOLLADR",
    "MISC_RECEIVE_ALL",
    "XOPENCONFIG",
    "frmERR_DEVICEDESCRIPTION",
    "frmERR_FUB_ENABLE_FALSE",
    "frmERR_IF_UNREACHABLE",
    "frmERR_INIT_IN_PROGRESS",
    "frmERR_INPUTERROR",
    "frmERR_INVALIDBUFFER",
    "frmERR_IOCTL_NOTSUPPORTED",
    "frmERR_IOCTL_NOTVALID",
    "frmERR_MAXOPEN",
    "frmERR_MODEDESCRIPTION",
    "frmERR_NOBUFFER",
    "frmERR_NOINPUT",
    "frmERR_NORESOURCES",
    "frmERR_NOTOPENED",
    "frmERR_OK",
    "frmERR_PA_DB_SB",
    "frmERR_TRANSMITOVERRUN",
]

_DECLARED = declared_beside(__name__)

frmERR_IOCTL_NOTSUPPORTED: Final = 8257

frmERR_DEVICEDESCRIPTION: Final = 8252

frmERR_FUB_ENABLE_FALSE: Final = 65534

frmERR_TRANSMITOVERRUN: Final = 8078

frmERR_MODEDESCRIPTION: Final = 8253

frmERR_IOCTL_NOTVALID: Final = 8073

frmERR_INVALIDBUFFER: Final = 8072

frmERR_IF_UNREACHABLE: Final = 8067

frmERR_INIT_IN_PROGRESS: Final = 8068

ARG_EVSEND_TASKIDENT: Final = 14

ARG_EVSEND_TASKEVENT: Final = 18

frmERR_NORESOURCES: Final = 8258

frmERR_INPUTERROR: Final = 8079

frmERR_NOTOPENED: Final = 8251

MISC_RECEIVE_ALL: Final = 2

frmERR_PA_DB_SB: Final = 8256

frmERR_NOBUFFER: Final = 8071

ARG_TXPVPOLLADR: Final = 17

frmERR_NOINPUT: Final = 60

frmERR_MAXOPEN: Final = 8254

ARG_PVPOLLADR: Final = 15

frmERR_OK: Final = 0

ARG_MISC: Final = 16

ARG_BAUD: Final = 0


class XOPENCONFIG(Struct):
    """XOPENCONFIG."""

    _plc_type = _DECLARED["XOPENCONFIG"]

    idle: int

    delimc: int

    delim: Array[int]

    tx_cnt: int

    rx_cnt: int

    tx_len: int

    rx_len: int

    argc: int

    argv: int


class FRM_mode(FunctionBlock):
    """Changes the mode of an interface."""

    _plc_type = _DECLARED["FRM_mode"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    mode: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_ctrl(FunctionBlock):
    """Control lines of an interface."""

    _plc_type = _DECLARED["FRM_ctrl"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    ioctrl: int

    inarg: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    outarg: int

    internal: str


class FRM_robuf(FunctionBlock):
    """Gives a buffer for sending back."""

    _plc_type = _DECLARED["FRM_robuf"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    buffer: int

    buflng: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_gbuf(FunctionBlock):
    """Takes a buffer for sending."""

    _plc_type = _DECLARED["FRM_gbuf"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    buffer: int

    buflng: int

    internal: str


class FRM_rbuf(FunctionBlock):
    """Gives a received buffer back."""

    _plc_type = _DECLARED["FRM_rbuf"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    buffer: int

    buflng: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_close(FunctionBlock):
    """Closes an interface."""

    _plc_type = _DECLARED["FRM_close"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_write(FunctionBlock):
    """Sends a buffer."""

    _plc_type = _DECLARED["FRM_write"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    buffer: int

    buflng: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_writeAcknowledged(FunctionBlock):
    """FRM_writeAcknowledged."""

    _plc_type = _DECLARED["FRM_writeAcknowledged"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    buffer: int

    buflng: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    internal: str


class FRM_read(FunctionBlock):
    """Receives a buffer."""

    _plc_type = _DECLARED["FRM_read"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The interface."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    buffer: int

    buflng: int

    internal: str


class FRM_xopen(FunctionBlock):
    """Opens an interface."""

    _plc_type = _DECLARED["FRM_xopen"]

    enable: bool
    """Run the block; FALSE resets it."""

    device: int

    mode: int

    config: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The interface."""

    internal: str
