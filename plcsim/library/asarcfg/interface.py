"""Library AsARCfg as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = [
    "cfgCONFIGMODE_DHCPCLIENT",
    "cfgCONFIGMODE_MANUALLY",
    "cfgERR_DEVICE_INVALID",
    "cfgERR_DEVICE_NOT_EXIST",
    "cfgERR_OPTION_INVALID",
    "cfgERR_SET_NOT_POSSIBLE",
    "cfgERR_VALUE_INVALID",
    "cfgOPTION_NON_VOLATILE",
    "cfgOPTION_VOLATILE",
]

_DECLARED = declared_beside(__name__)

cfgERR_DEVICE_NOT_EXIST: Final = 29000

cfgERR_DEVICE_INVALID: Final = 29001

cfgERR_OPTION_INVALID: Final = 29002

cfgERR_VALUE_INVALID: Final = 29003

cfgERR_SET_NOT_POSSIBLE: Final = 29004

cfgOPTION_NON_VOLATILE: Final = 1

cfgOPTION_VOLATILE: Final = 0

cfgCONFIGMODE_MANUALLY: Final = 0

cfgCONFIGMODE_DHCPCLIENT: Final = 1


class CfgGetIPAddr(FunctionBlock):
    """Reads the IP address of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgGetIPAddr"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pIPAddr: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetIPAddr(FunctionBlock):
    """Sets the IP address of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgSetIPAddr"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pIPAddr: int

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetSubnetMask(FunctionBlock):
    """Reads the subnet mask of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgGetSubnetMask"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pSubnetMask: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetSubnetMask(FunctionBlock):
    """Sets the subnet mask of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgSetSubnetMask"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pSubnetMask: int

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetDefaultGateway(FunctionBlock):
    """Reads the default gateway of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgGetDefaultGateway"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pGateway: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetDefaultGateway(FunctionBlock):
    """Sets the default gateway of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgSetDefaultGateway"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pGateway: int

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetBroadcastAddr(FunctionBlock):
    """Reads the broadcast address of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgGetBroadcastAddr"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pBroadcastAddr: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetBroadcastAddr(FunctionBlock):
    """Sets the broadcast address of an interface; asynchronous."""

    _plc_type = _DECLARED["CfgSetBroadcastAddr"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pBroadcastAddr: int

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetEthConfigMode(FunctionBlock):
    """Reads where an interface has its address from; asynchronous."""

    _plc_type = _DECLARED["CfgGetEthConfigMode"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    ConfigMode: int
    """CfgCONFIGMODE_MANUALLY or cfgCONFIGMODE_DHCPCLIENT."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetEthConfigMode(FunctionBlock):
    """Sets where an interface has its address from; asynchronous."""

    _plc_type = _DECLARED["CfgSetEthConfigMode"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    ConfigMode: int
    """CfgCONFIGMODE_MANUALLY or cfgCONFIGMODE_DHCPCLIENT."""

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetHostName(FunctionBlock):
    """Reads the host name; asynchronous."""

    _plc_type = _DECLARED["CfgGetHostName"]

    enable: bool
    """Run the block; FALSE resets it."""

    pHostName: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetHostName(FunctionBlock):
    """Sets the host name; asynchronous."""

    _plc_type = _DECLARED["CfgSetHostName"]

    enable: bool
    """Run the block; FALSE resets it."""

    pHostName: int

    Option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetMacAddr(FunctionBlock):
    """Reads the MAC address of an interface."""

    _plc_type = _DECLARED["CfgGetMacAddr"]

    enable: bool
    """Run the block; FALSE resets it."""

    pDevice: int
    """Address of the interface's name, such as SL0.SS0.IF3."""

    pMacAddr: int

    Len: int
    """Bytes there."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgGetTimeZone(FunctionBlock):
    """Reads the time zone; asynchronous."""

    _plc_type = _DECLARED["CfgGetTimeZone"]

    enable: bool
    """Run the block; FALSE resets it."""

    timezoneID: int

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""


class CfgSetTimeZone(FunctionBlock):
    """Sets the time zone; asynchronous."""

    _plc_type = _DECLARED["CfgSetTimeZone"]

    enable: bool
    """Run the block; FALSE resets it."""

    timezoneID: int

    option: int
    """CfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE."""

    status: int
    """0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error."""

    i_state: int
    """0 idle, 1 busy."""

    i_result: int
    """Last status."""

    i_tmp: int
    """Not used."""
