"""Library sys_lib as Python sees it.

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
    "ERR_BUR_AVT_FREE",
    "ERR_BUR_BURNING",
    "ERR_BUR_DUPOBJ",
    "ERR_BUR_EXISTS",
    "ERR_BUR_ILLBPTR",
    "ERR_BUR_ILLDATE",
    "ERR_BUR_ILLEXT",
    "ERR_BUR_ILLIDENT",
    "ERR_BUR_ILLLEN",
    "ERR_BUR_ILLOBJ",
    "ERR_BUR_ILLOBJTYP",
    "ERR_BUR_ILLPAR",
    "ERR_BUR_ILLPTR",
    "ERR_BUR_ILLSTATE",
    "ERR_BUR_ILLTICKS",
    "ERR_BUR_ILLTIME",
    "ERR_BUR_ILLTKNR",
    "ERR_BUR_ILLTYP",
    "ERR_BUR_ILLVER",
    "ERR_BUR_INSTALL",
    "ERR_BUR_INVALIDMBX",
    "ERR_BUR_LCOUNT",
    "ERR_BUR_MAX_LCOUNT",
    "ERR_BUR_MEMVWBUSY",
    "ERR_BUR_MEM_ALLOC",
    "ERR_BUR_MEM_FREE",
    "ERR_BUR_MO_NOTFOUND",
    "ERR_BUR_NOENTRY",
    "ERR_BUR_NOMEM",
    "ERR_BUR_NOMSG",
    "ERR_BUR_NORTC",
    "ERR_BUR_NOSM",
    "ERR_BUR_NOSMBUF",
    "ERR_BUR_NOTIME",
    "ERR_BUR_OBJDEL",
    "ERR_BUR_SMDEL",
    "ERR_BUR_TIMEOUT",
    "ERR_BUR_TMP_ALLOC",
    "ERR_BUR_TMP_FREE",
    "ERR_BUR_TOOLONG_PVNAME",
    "ERR_BUR_WRCOL",
    "ERR_BUR_WROFFSET",
    "ERR_BUR_WRONG_MODTYP",
    "ERR_BUR_WRROW",
    "ERR_BUR_WR_CHAR",
    "FIX_RAM",
    "PB_DT_ARRAY",
    "PB_DT_BIT",
    "PB_DT_BOOL",
    "PB_DT_BYTE",
    "PB_DT_DATE",
    "PB_DT_DIFF",
    "PB_DT_FLOAT",
    "PB_DT_INT8",
    "PB_DT_INT16",
    "PB_DT_INT32",
    "PB_DT_LONG",
    "PB_DT_OCTET",
    "PB_DT_STRUCT",
    "PB_DT_TIME",
    "PB_DT_VIS",
    "PB_DT_WORD",
    "SYSLIB_COLDSTART",
    "SYSLIB_COLDSTART_NO_REBOOT",
    "SYSLIB_DIAGNOSTICS",
    "SYSLIB_IEC_TYPE_BOOL",
    "SYSLIB_IEC_TYPE_BYTE",
    "SYSLIB_IEC_TYPE_DATE",
    "SYSLIB_IEC_TYPE_DATE_AND_TIME",
    "SYSLIB_IEC_TYPE_DINT",
    "SYSLIB_IEC_TYPE_DWORD",
    "SYSLIB_IEC_TYPE_INT",
    "SYSLIB_IEC_TYPE_LREAL",
    "SYSLIB_IEC_TYPE_REAL",
    "SYSLIB_IEC_TYPE_SINT",
    "SYSLIB_IEC_TYPE_STRING",
    "SYSLIB_IEC_TYPE_TIME",
    "SYSLIB_IEC_TYPE_TIME_OF_DAY",
    "SYSLIB_IEC_TYPE_UDINT",
    "SYSLIB_IEC_TYPE_UINT",
    "SYSLIB_IEC_TYPE_USER_DEFINED",
    "SYSLIB_IEC_TYPE_USER_DEFINED_2",
    "SYSLIB_IEC_TYPE_USINT",
    "SYSLIB_IEC_TYPE_WORD",
    "SYSLIB_IEC_TYPE_WSTRING",
    "SYSLIB_SERVICE",
    "SYSLIB_WARMSTART",
    "SYSLIB_WARMSTART_NO_REBOOT",
    "SYS_RAM",
    "USER_ROM1",
    "ERR_typ",
    "ERR_xtyp",
    "MO_List_typ",
    "MoVerStruc_typ",
    "PV_List_typ",
    "PV_xList_typ",
    "RTCtime_typ",
    "SYSxinfo_typ",
    "Z_ST_IOdeinstalled",
    "Z_ST_IOinstalled",
    "Z_ST_PVdeinstalled",
    "Z_ST_PVinstalled",
    "Z_ST_blocked",
    "Z_ST_created",
    "Z_ST_delete",
    "Z_ST_exist",
    "Z_ST_installed",
    "Z_ST_running",
    "Z_ST_stdebug",
    "Z_ST_tmp_suspended",
]

_DECLARED = declared_beside(__name__)

ERR_BUR_WRROW: Final = 2061

ERR_BUR_WRCOL: Final = 2062

ERR_BUR_WR_CHAR: Final = 2063

ERR_BUR_NORTC: Final = 2073

ERR_BUR_MO_NOTFOUND: Final = 3019

ERR_BUR_NOMEM: Final = 3030

ERR_BUR_MEMVWBUSY: Final = 3035

ERR_BUR_ILLPTR: Final = 3104

ERR_BUR_ILLTKNR: Final = 3300

ERR_BUR_WROFFSET: Final = 3301

ERR_BUR_ILLSTATE: Final = 3302

ERR_BUR_NOMSG: Final = 3303

ERR_BUR_DUPOBJ: Final = 3305

ERR_BUR_TIMEOUT: Final = 3304

ERR_BUR_EXISTS: Final = 3306

ERR_BUR_LCOUNT: Final = 3307

ERR_BUR_BURNING: Final = 3308

ERR_BUR_INVALIDMBX: Final = 3309

ERR_BUR_ILLBPTR: Final = 3310

ERR_BUR_ILLTYP: Final = 3311

ERR_BUR_ILLEXT: Final = 3312

ERR_BUR_ILLVER: Final = 3313

ERR_BUR_ILLLEN: Final = 3314

ERR_BUR_MAX_LCOUNT: Final = 3315

ERR_BUR_AVT_FREE: Final = 3316

ERR_BUR_ILLPAR: Final = 3317

ERR_BUR_INSTALL: Final = 3318

ERR_BUR_WRONG_MODTYP: Final = 3319

ERR_BUR_OBJDEL: Final = 3320

ERR_BUR_ILLOBJ: Final = 3324

ERR_BUR_ILLOBJTYP: Final = 3328

ERR_BUR_NOENTRY: Final = 3332

ERR_BUR_TOOLONG_PVNAME: Final = 3333

ERR_BUR_ILLIDENT: Final = 3336

ERR_BUR_NOSMBUF: Final = 3560

ERR_BUR_NOSM: Final = 3564

ERR_BUR_SMDEL: Final = 3568

ERR_BUR_NOTIME: Final = 3584

ERR_BUR_ILLDATE: Final = 3588

ERR_BUR_ILLTIME: Final = 3592

ERR_BUR_ILLTICKS: Final = 3596

ERR_BUR_MEM_ALLOC: Final = 3600

ERR_BUR_TMP_ALLOC: Final = 3601

ERR_BUR_MEM_FREE: Final = 3700

ERR_BUR_TMP_FREE: Final = 3701

Z_ST_created: Final = 1

Z_ST_running: Final = 2

Z_ST_blocked: Final = 3

Z_ST_exist: Final = 0

Z_ST_installed: Final = 130

Z_ST_PVinstalled: Final = 131

Z_ST_IOinstalled: Final = 132

Z_ST_IOdeinstalled: Final = 133

Z_ST_PVdeinstalled: Final = 134

Z_ST_delete: Final = 135

Z_ST_stdebug: Final = 136

Z_ST_tmp_suspended: Final = 144

PB_DT_STRUCT: Final = 0

PB_DT_BOOL: Final = 1

PB_DT_INT8: Final = 2

PB_DT_INT16: Final = 3

PB_DT_INT32: Final = 4

PB_DT_BYTE: Final = 5

PB_DT_WORD: Final = 6

PB_DT_LONG: Final = 7

PB_DT_FLOAT: Final = 8

PB_DT_VIS: Final = 9

PB_DT_OCTET: Final = 10

PB_DT_DATE: Final = 11

PB_DT_TIME: Final = 12

PB_DT_DIFF: Final = 13

PB_DT_BIT: Final = 14

PB_DT_ARRAY: Final = 15

SYSLIB_IEC_TYPE_USER_DEFINED: Final = 0

SYSLIB_IEC_TYPE_USER_DEFINED_2: Final = 15

SYSLIB_IEC_TYPE_BOOL: Final = 1

SYSLIB_IEC_TYPE_SINT: Final = 2

SYSLIB_IEC_TYPE_INT: Final = 3

SYSLIB_IEC_TYPE_DINT: Final = 4

SYSLIB_IEC_TYPE_USINT: Final = 5

SYSLIB_IEC_TYPE_UINT: Final = 6

SYSLIB_IEC_TYPE_UDINT: Final = 7

SYSLIB_IEC_TYPE_REAL: Final = 8

SYSLIB_IEC_TYPE_STRING: Final = 9

SYSLIB_IEC_TYPE_DATE_AND_TIME: Final = 11

SYSLIB_IEC_TYPE_TIME: Final = 12

SYSLIB_IEC_TYPE_DATE: Final = 13

SYSLIB_IEC_TYPE_LREAL: Final = 14

SYSLIB_IEC_TYPE_TIME_OF_DAY: Final = 16

SYSLIB_IEC_TYPE_BYTE: Final = 17

SYSLIB_IEC_TYPE_WORD: Final = 18

SYSLIB_IEC_TYPE_DWORD: Final = 19

SYSLIB_IEC_TYPE_WSTRING: Final = 21

SYS_RAM: Final = 1

USER_ROM1: Final = 2

FIX_RAM: Final = 5

SYSLIB_WARMSTART: Final = 1

SYSLIB_COLDSTART: Final = 2

SYSLIB_WARMSTART_NO_REBOOT: Final = 17

SYSLIB_COLDSTART_NO_REBOOT: Final = 18

SYSLIB_DIAGNOSTICS: Final = 32

SYSLIB_SERVICE: Final = 64


class MoVerStruc_typ(Struct):
    """MoVerStruc_typ."""

    _plc_type = _DECLARED["MoVerStruc_typ"]

    version: Array[int]

    year: int

    month: int

    day: int

    reserve: int

    hour: int

    minute: int

    second: int


class ERR_xtyp(Struct):
    """ERR_xtyp."""

    _plc_type = _DECLARED["ERR_xtyp"]

    err_nr: int

    err_info: int

    t_name: Array[int]

    err_type: int

    err_year: int

    err_month: int

    err_day: int

    err_reserve: int

    err_hour: int

    err_minute: int

    err_second: int

    err_millisec: int

    err_microsec: int

    err_string: Array[int]


class ERR_typ(Struct):
    """ERR_typ."""

    _plc_type = _DECLARED["ERR_typ"]

    err_nr: int

    err_info: int

    t_name: Array[int]

    err_type: int

    err_year: int

    err_month: int

    err_day: int

    err_reserve: int

    err_hour: int

    err_minute: int

    err_second: int

    err_millisec: int

    err_microsec: int


class PV_xList_typ(Struct):
    """PV_xList_typ."""

    _plc_type = _DECLARED["PV_xList_typ"]

    name: Array[int]

    data_typ: int

    data_len: int
    """Address for the length."""

    dimension: int

    adress: int


class PV_List_typ(Struct):
    """PV_List_typ."""

    _plc_type = _DECLARED["PV_List_typ"]

    name: Array[int]

    tcnr: int

    grp: int

    ident: int

    adress: int


class MO_List_typ(Struct):
    """MO_List_typ."""

    _plc_type = _DECLARED["MO_List_typ"]

    name: Array[int]

    grp: int

    type: int

    state: int

    reserve: int

    adress: int

    memtype: int


class SYSxinfo_typ(Struct):
    """SYSxinfo_typ."""

    _plc_type = _DECLARED["SYSxinfo_typ"]

    aws_name: Array[int]

    aws_type: Array[int]

    cpu_info: int

    ma_globl_len: int

    md_globl_len: int

    os_len: int

    user_len: int

    tmp_len: int

    eprom_len: int

    fix_ram_len: int


class RTCtime_typ(Struct):
    """RTCtime_typ."""

    _plc_type = _DECLARED["RTCtime_typ"]

    year: int

    month: int

    day: int

    reserve: int

    hour: int

    minute: int

    second: int

    millisec: int

    microsec: int


class Byte2Bit(FunctionBlock):
    """Byte2Bit."""

    _plc_type = _DECLARED["Byte2Bit"]

    byteadr: int

    length: int

    bitadr: int

    bmem000: bool

    static_val: Array[int]


class Bit2Byte(FunctionBlock):
    """Bit2Byte."""

    _plc_type = _DECLARED["Bit2Byte"]

    bitadr: int

    length: int

    byteadr: int

    byte_00: int

    byte_01: int

    byte_02: int

    byte_03: int

    byte_04: int

    byte_05: int

    byte_06: int

    byte_07: int

    byte_08: int

    byte_09: int

    byte_10: int

    byte_11: int

    byte_12: int

    byte_13: int

    byte_14: int

    byte_15: int

    bmem000: bool

    static_val: Array[int]


class MO_info(FunctionBlock):
    """MO_info."""

    _plc_type = _DECLARED["MO_info"]

    enable: bool
    """Run the block; FALSE resets it."""

    pName: int

    grp: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    type: int

    state: int

    memType: int

    address: int

    size: int

    version: Array[int]

    date: RTCtime_typ


class slMoList(FunctionBlock):
    """SlMoList."""

    _plc_type = _DECLARED["slMoList"]

    enable: bool
    """Run the block; FALSE resets it."""

    first: bool

    filter: bool

    pMoName: int

    sizeMoName: int

    pAppMoName: int

    sizeAppMoName: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    moSize: int

    moType: int

    memType: int

    i_hMo: int
