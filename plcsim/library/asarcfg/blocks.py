"""Blocks that read and set the configuration."""

from __future__ import annotations

from typing import Final

from plcsim.library.asarcfg import interface
from plcsim.library.asarcfg.configuration import MAC, ArConfiguration, Text
from plcsim.library.asarcfg.interface import (
    cfgCONFIGMODE_DHCPCLIENT,
    cfgERR_DEVICE_INVALID,
    cfgERR_OPTION_INVALID,
    cfgERR_SET_NOT_POSSIBLE,
    cfgERR_VALUE_INVALID,
    cfgOPTION_NON_VOLATILE,
)
from plcsim.library.block import AsynchronousBlock, SynchronousBlock
from plcsim.library.runtime import ERR_OK
from plcsim.network.protocol import is_ipv4

LONGEST_NAME: Final = 63
"""Characters of the name of an interface or a host."""


class _Block(AsynchronousBlock):
    """Base of the blocks. Statuses: ERR_OK, cfgERR_DEVICE_INVALID, cfgERR_VALUE_INVALID (a null
    pointer, too little room, no address), cfgERR_OPTION_INVALID, cfgERR_SET_NOT_POSSIBLE.
    """  # noqa: D205  # the statuses do not fit one line

    __slots__ = ()

    @property
    def configuration(self) -> ArConfiguration:
        """That of the controller."""
        return self.context.library(ArConfiguration)

    def name_at(self, address: int) -> str:
        """Return the name at an address, "" where there is none or it is too long."""
        name = self.context.memory.string(address, LONGEST_NAME + 1) if address else b""
        return name.decode("latin-1") if len(name) <= LONGEST_NAME else ""

    def stored(self, text: str, address: int, size: int) -> int:
        """Store a text; return the status."""
        data = text.encode("latin-1") + b"\0"
        if not address or len(data) > size:
            return cfgERR_VALUE_INVALID
        self.context.memory.write(address, data)
        return ERR_OK

    def text_stored(self, kind: Text, p_device: int, address: int, size: int) -> int:
        """Store a text of an interface; return the status."""
        name = self.name_at(p_device)
        if not name:
            return cfgERR_DEVICE_INVALID
        return self.stored(self.configuration.text(name, kind), address, size)

    def text_set(self, kind: Text, p_device: int, address: int, option: int) -> int:
        """Set a text of an interface; return the status."""
        name, text = self.name_at(p_device), self.name_at(address)
        if not name:
            return cfgERR_DEVICE_INVALID
        if option > cfgOPTION_NON_VOLATILE:
            return cfgERR_OPTION_INVALID
        if not is_ipv4(text):
            return cfgERR_VALUE_INVALID
        done = self.configuration.set_text(name, kind, text)
        return ERR_OK if done else cfgERR_SET_NOT_POSSIBLE


class CfgGetIPAddr(interface.CfgGetIPAddr, _Block):
    """The IP address of an interface. Inputs: enable, pDevice, pIPAddr, Len."""

    def step(self) -> int:
        """Store it."""
        return self.text_stored(Text.IP, self.pDevice, self.pIPAddr, self.Len)


class CfgSetIPAddr(interface.CfgSetIPAddr, _Block):
    """Set the IP address of an interface. Inputs: enable, pDevice, pIPAddr, Option."""

    def step(self) -> int:
        """Set it."""
        return self.text_set(Text.IP, self.pDevice, self.pIPAddr, self.Option)


class CfgGetSubnetMask(interface.CfgGetSubnetMask, _Block):
    """The subnet mask of an interface. Inputs: enable, pDevice, pSubnetMask, Len."""

    def step(self) -> int:
        """Store it."""
        return self.text_stored(Text.MASK, self.pDevice, self.pSubnetMask, self.Len)


class CfgSetSubnetMask(interface.CfgSetSubnetMask, _Block):
    """Set the subnet mask of an interface. Inputs: enable, pDevice, pSubnetMask, Option."""

    def step(self) -> int:
        """Set it."""
        return self.text_set(Text.MASK, self.pDevice, self.pSubnetMask, self.Option)


class CfgGetDefaultGateway(interface.CfgGetDefaultGateway, _Block):
    """The default gateway of an interface. Inputs: enable, pDevice, pGateway, Len."""

    def step(self) -> int:
        """Store it."""
        return self.text_stored(Text.GATEWAY, self.pDevice, self.pGateway, self.Len)


class CfgSetDefaultGateway(interface.CfgSetDefaultGateway, _Block):
    """Set the default gateway. Inputs: enable, pDevice, pGateway, Option."""

    def step(self) -> int:
        """Set it."""
        return self.text_set(Text.GATEWAY, self.pDevice, self.pGateway, self.Option)


class CfgGetBroadcastAddr(interface.CfgGetBroadcastAddr, _Block):
    """The broadcast address. Inputs: enable, pDevice, pBroadcastAddr, Len."""

    def step(self) -> int:
        """Store it."""
        return self.text_stored(Text.BROADCAST, self.pDevice, self.pBroadcastAddr, self.Len)


class CfgSetBroadcastAddr(interface.CfgSetBroadcastAddr, _Block):
    """Set the broadcast address. Inputs: enable, pDevice, pBroadcastAddr, Option."""

    def step(self) -> int:
        """Set it."""
        return self.text_set(Text.BROADCAST, self.pDevice, self.pBroadcastAddr, self.Option)


class CfgGetEthConfigMode(interface.CfgGetEthConfigMode, _Block):
    """Where an interface has its address from. Inputs: enable, pDevice. Output: ConfigMode."""

    def step(self) -> int:
        """Look for it."""
        name = self.name_at(self.pDevice)
        if not name:
            return cfgERR_DEVICE_INVALID
        self.ConfigMode = self.configuration.mode(name)
        return ERR_OK


class CfgSetEthConfigMode(interface.CfgSetEthConfigMode, _Block):
    """Set it. Inputs: enable, pDevice, ConfigMode, Option."""

    def step(self) -> int:
        """Set it."""
        name = self.name_at(self.pDevice)
        if not name:
            return cfgERR_DEVICE_INVALID
        if self.Option > cfgOPTION_NON_VOLATILE:
            return cfgERR_OPTION_INVALID
        if self.ConfigMode > cfgCONFIGMODE_DHCPCLIENT:
            return cfgERR_VALUE_INVALID
        done = self.configuration.set_mode(name, self.ConfigMode)
        return ERR_OK if done else cfgERR_SET_NOT_POSSIBLE


class CfgGetHostName(interface.CfgGetHostName, _Block):
    """The name of the controller, at pHostName. Inputs: enable, pHostName, Len."""

    def step(self) -> int:
        """Store it."""
        return self.stored(self.configuration.host_name, self.pHostName, self.Len)


class CfgSetHostName(interface.CfgSetHostName, _Block):
    """Set it. Inputs: enable, pHostName, Option."""

    def step(self) -> int:
        """Set it."""
        name = self.name_at(self.pHostName)
        if self.Option > cfgOPTION_NON_VOLATILE:
            return cfgERR_OPTION_INVALID
        if not name:
            return cfgERR_VALUE_INVALID
        self.configuration.host_name = name
        return ERR_OK


class CfgGetTimeZone(interface.CfgGetTimeZone, _Block):
    """The number of the time zone. Input: enable. Output: timezoneID."""

    def step(self) -> int:
        """Look for it."""
        self.timezoneID = self.configuration.time_zone
        return ERR_OK


class CfgSetTimeZone(interface.CfgSetTimeZone, _Block):
    """Set it; local time stays as it is. Inputs: enable, timezoneID, option."""

    def step(self) -> int:
        """Set it."""
        if self.option > cfgOPTION_NON_VOLATILE:
            return cfgERR_OPTION_INVALID
        self.configuration.time_zone = self.timezoneID
        return ERR_OK


class CfgGetMacAddr(interface.CfgGetMacAddr, SynchronousBlock):
    """The MAC address of an interface, six bytes at pMacAddr: 02-00-00-00-00-01."""

    def step(self) -> int:
        """Store it."""
        if not self.pDevice:
            return cfgERR_DEVICE_INVALID
        if not self.pMacAddr or self.Len < len(MAC):
            return cfgERR_VALUE_INVALID
        self.context.memory.write(self.pMacAddr, MAC)
        return ERR_OK
