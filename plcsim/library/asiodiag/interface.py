"""Library AsIODiag as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = [
    "asdiagALL",
    "asdiagCONFIGURED",
    "asdiagCONFIG_BUS",
    "asdiagCONFIG_FAMILY",
    "asdiagCONFIG_MODNO",
    "asdiagCONFIG_MODULE",
    "asdiagCONFIG_USETYPE",
    "asdiagERR_IDENT",
    "asdiagERR_INDEX",
    "asdiagERR_INFOCODE",
    "asdiagERR_INFOKIND",
    "asdiagERR_NOMEM",
    "asdiagHARDWARE_DEVICE_TAG",
    "asdiagHARDWARE_MODULE_NAME",
    "asdiagMODUL_STATE",
    "asdiagPATH",
    "asdiagPLUGGED",
    "asdiagPLUGGED_BUS",
    "asdiagPLUGGED_FAMILY",
    "asdiagPLUGGED_MODNO",
    "asdiagPLUGGED_MODULE",
    "asdiagPLUGGED_USETYPE",
    "asdiagSERIAL_NUMBER",
    "br2003",
    "br2005",
    "br2010",
    "brADDON",
    "brAUTOMATION_RUNTIME",
    "brC200",
    "brC300",
    "brLOGIGSCANNER",
    "brNO_FAMILY",
    "brPANEL",
    "brPOWERPANEL",
    "brX2X",
]

_DECLARED = declared_beside(__name__)

asdiagERR_NOMEM: Final = 30801

asdiagERR_IDENT: Final = 30802

asdiagERR_INDEX: Final = 30803

asdiagERR_INFOCODE: Final = 30804

asdiagERR_INFOKIND: Final = 30805

asdiagMODUL_STATE: Final = 1

asdiagPLUGGED_MODNO: Final = 2

asdiagCONFIG_MODNO: Final = 3

asdiagPLUGGED_FAMILY: Final = 4

asdiagCONFIG_FAMILY: Final = 5

asdiagPLUGGED_USETYPE: Final = 6

asdiagCONFIG_USETYPE: Final = 7

asdiagSERIAL_NUMBER: Final = 8

asdiagPATH: Final = 1001

asdiagPLUGGED_MODULE: Final = 1002

asdiagCONFIG_MODULE: Final = 1003

asdiagPLUGGED_BUS: Final = 1004

asdiagCONFIG_BUS: Final = 1005

asdiagHARDWARE_MODULE_NAME: Final = 1006

asdiagHARDWARE_DEVICE_TAG: Final = 1007

asdiagPLUGGED: Final = 1

asdiagCONFIGURED: Final = 2

asdiagALL: Final = 3

br2010: Final = 0

br2005: Final = 1

br2003: Final = 2

brLOGIGSCANNER: Final = 3

brAUTOMATION_RUNTIME: Final = 4

brPOWERPANEL: Final = 5

brPANEL: Final = 6

brADDON: Final = 7

brC300: Final = 8

brC200: Final = 9

brX2X: Final = 10

brNO_FAMILY: Final = 255


class DiagCreateInfo(FunctionBlock):
    """Makes a list of modules; asynchronous."""

    _plc_type = _DECLARED["DiagCreateInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    infoKind: int

    StateMan: int

    ErrMan: int

    Init: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ident: int
    """The list."""

    nrEntries: int
    """Modules in the list."""


class DiagDisposeInfo(FunctionBlock):
    """Forgets a list of modules."""

    _plc_type = _DECLARED["DiagDisposeInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The list."""

    StateMan: int

    ErrMan: int

    Init: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class DiagGetNumInfo(FunctionBlock):
    """A number about a module of the list."""

    _plc_type = _DECLARED["DiagGetNumInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The list."""

    index: int

    infoCode: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    value: int


class DiagGetStrInfo(FunctionBlock):
    """A text about a module of the list."""

    _plc_type = _DECLARED["DiagGetStrInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    ident: int
    """The list."""

    index: int

    infoCode: int

    pBuffer: int

    bufferLen: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    stringLen: int
