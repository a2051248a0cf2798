"""Library brsystem as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

if TYPE_CHECKING:
    from st_types import Array

__all__ = [
    "INIT_REASON_COLDSTART",
    "INIT_REASON_DOWNLOAD",
    "INIT_REASON_UNKNOWN",
    "INIT_REASON_WARMSTART",
    "TARGET_BIG_ENDIAN",
    "TARGET_LITTLE_ENDIAN",
    "br2003",
    "br2005",
    "br2010",
    "brACOPOS",
    "brADDON",
    "brAUTOMATION_RUNTIME",
    "brBASE_IO",
    "brBATTERY_LOW",
    "brBATTERY_MISSING",
    "brBATTERY_NOTEST",
    "brBATTERY_OK",
    "brC200",
    "brC300",
    "brCAN_IO",
    "brCPU",
    "brDRAM",
    "brERR_INVALID_DEVICE",
    "brERR_INVALID_PARAMETER",
    "brERR_NON_CYCLIC_CONTEXT",
    "brETHER_IO",
    "brGLOBAL_REMANENT_PV",
    "brKEY",
    "brLOCAL_REMANENT_PV",
    "brLOGICSCANNER",
    "brNO_FAMILY",
    "brPANEL",
    "brPLUGIN_MODULE",
    "brPOWERPANEL",
    "brPP",
    "brPRODUCT",
    "brREMOTE_IO",
    "brSYSCONF_SET_NON_VOLATILE",
    "brSYSCONF_SET_VOLATILE",
    "brSYSROM",
    "brSYSTEM_MODULE",
    "brUSRRAM",
    "brUSRROM",
    "brWINDOWS_BLUESCREEN",
    "brWINDOWS_OK",
    "brX2X",
]

_DECLARED = declared_beside(__name__)

brSYSCONF_SET_NON_VOLATILE: Final = True

brERR_NON_CYCLIC_CONTEXT: Final = 27252

brERR_INVALID_PARAMETER: Final = 27251

brSYSCONF_SET_VOLATILE: Final = False

INIT_REASON_WARMSTART: Final = 1

INIT_REASON_COLDSTART: Final = 2

brERR_INVALID_DEVICE: Final = 27250

brAUTOMATION_RUNTIME: Final = 4

TARGET_LITTLE_ENDIAN: Final = 1

INIT_REASON_DOWNLOAD: Final = 3

INIT_REASON_UNKNOWN: Final = -1

brBATTERY_MISSING: Final = 3

TARGET_BIG_ENDIAN: Final = 2

brBATTERY_NOTEST: Final = 2

brSYSTEM_MODULE: Final = 2

brPLUGIN_MODULE: Final = 10

brLOGICSCANNER: Final = 3

brBATTERY_LOW: Final = 0

brPOWERPANEL: Final = 5

brBATTERY_OK: Final = 1

brREMOTE_IO: Final = 4

brNO_FAMILY: Final = 255

brETHER_IO: Final = 6

brPRODUCT: Final = 0

brBASE_IO: Final = 3

brCAN_IO: Final = 5

brACOPOS: Final = 7

brUSRRAM: Final = 1

brSYSROM: Final = 2

brUSRROM: Final = 3

brLOCAL_REMANENT_PV: Final = 4

brGLOBAL_REMANENT_PV: Final = 5

brPANEL: Final = 6

brADDON: Final = 7

brC300: Final = 8

brC200: Final = 9

br2010: Final = 0

br2005: Final = 1

br2003: Final = 2

brDRAM: Final = 0

brKEY: Final = 8

brCPU: Final = 1

brPP: Final = 255

brX2X: Final = 10

brWINDOWS_OK: Final = 0

brWINDOWS_BLUESCREEN: Final = 1


class MEMInfo(FunctionBlock):
    """Free memory."""

    _plc_type = _DECLARED["MEMInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    FreeUSR_Ram: int
    """Bytes."""

    FreeSYSTEM: int

    FreeUSR_Prom: int

    FreeSYS_Prom: int

    FreeFIX_Ram: int

    FreeTMP_Ram: int

    FreeMEMCARD: int


class MEMxInfo(FunctionBlock):
    """Free memory of one kind."""

    _plc_type = _DECLARED["MEMxInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    mem_typ: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    MemSize: int
    """Bytes."""

    FreeMemSize: int
    """Bytes."""

    BiggestFreeBlockSize: int
    """Bytes."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class SysInfo(FunctionBlock):
    """Start and version of the system."""

    _plc_type = _DECLARED["SysInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    init_reason: int
    """INIT_REASON_."""

    init_count: int

    tick_count: int

    version: int


class RTInfo(FunctionBlock):
    """The task class that runs, and why the controller started."""

    _plc_type = _DECLARED["RTInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    cycle_time: int
    """Microseconds."""

    init_reason: int
    """INIT_REASON_."""

    task_class: int
    """Number of the task class."""


class TARGETInfo(FunctionBlock):
    """Version and byte order of the system."""

    _plc_type = _DECLARED["TARGETInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pOSVersion: int
    """Address of 10 bytes at least."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    DataFormat: int


class HWInfo(FunctionBlock):
    """Modules of the hardware."""

    _plc_type = _DECLARED["HWInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    first: bool

    pName: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    family: int

    usetype: int

    module_typ: int

    master_no: int

    slave_no: int

    module_adr: int

    slot_no: int

    next_vw_p: int

    last_modul_p: int

    next_entry_p: int

    next_entry_ix: int

    next_slot_ix: int

    last_rio_master: int


class SysconfInfo(FunctionBlock):
    """Reads an entry of the system configuration."""

    _plc_type = _DECLARED["SysconfInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pEntry: int

    pValue: int

    value_len: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class SysconfSet(FunctionBlock):
    """Writes an entry of the system configuration."""

    _plc_type = _DECLARED["SysconfSet"]

    enable: bool
    """Run the block; FALSE resets it."""

    pEntry: int

    pNewValue: int

    option: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class BatteryInfo(FunctionBlock):
    """State of a battery."""

    _plc_type = _DECLARED["BatteryInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    state: int


class EXCInfo(FunctionBlock):
    """Where an exception came from."""

    _plc_type = _DECLARED["EXCInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    task_class: int
    """Number of the task class."""

    task_ident: int


class ZYKVLenable(FunctionBlock):
    """Switches the check of cycle time violations."""

    _plc_type = _DECLARED["ZYKVLenable"]

    enable: bool
    """Run the block; FALSE resets it."""

    mode: bool

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class PMemGet(FunctionBlock):
    """Reads permanent memory."""

    _plc_type = _DECLARED["PMemGet"]

    enable: bool
    """Run the block; FALSE resets it."""

    offset: int

    len: int

    adress: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class PMemPut(FunctionBlock):
    """Writes permanent memory."""

    _plc_type = _DECLARED["PMemPut"]

    enable: bool
    """Run the block; FALSE resets it."""

    offset: int

    len: int

    adress: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""


class PMemSize(FunctionBlock):
    """Size of permanent memory."""

    _plc_type = _DECLARED["PMemSize"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    size: int


class ARwinWindowsInfo(FunctionBlock):
    """State of a Windows beside the controller."""

    _plc_type = _DECLARED["ARwinWindowsInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    windowsStatus: int


class ARwinEthWinInfo(FunctionBlock):
    """Network of a Windows beside the controller."""

    _plc_type = _DECLARED["ARwinEthWinInfo"]

    enable: bool
    """Run the block; FALSE resets it."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    IPAddr: str

    SubnetMask: str

    MacAddr: Array[int]
